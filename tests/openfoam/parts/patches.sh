# Cases of run: which patches have a rule, and from where.
# shellcheck shell=bash disable=SC2154

# A list as localInteraction reads it: the first entry that fits counts
case_list() {
    local difference
    build kinematic "$work/list" || return
    solve list dictionary "$solver" || return
    totals kinematicCloud 0 > totals.dictionary
    rm -rf 0.1 0.2 postProcessing
    cat > constant/interaction <<'END'
model "<constant>/nearWall.toml";
patches
(
    floor       { type interact; }
    horizontal  { type stick; }
    "si.*"      { type rebound; e 0.9; mu 0.1; }
    "(out.*|sides)" { type escape; }
);
END
    solve list serial "$solver" || return
    totals kinematicCloud 0 > totals.list
    if difference="$(same_totals totals.dictionary totals.list 0)"
    then ok "list (as the dictionary, to the bit)"; else bad list "$difference"; fi
    cp constant/interaction constant/interaction.good
    refuse list-word  's/^patches.*/patches floor;/; /^(/,/^);/d' "must be a dictionary or a list"
    refuse list-patch 's/floor /flor /' "'flor' matches no patch and no patch group"
}

# A cyclic pair with a rule holds the parcels back, as in localInteraction
case_filter() {
    local wall
    build kinematic "$work/filter" || return
    cyclic_sides
    settings 0.06 0.06 startTime ascii
    sed -i 's/writePrecision .*/writePrecision 17;/' system/controlDict
    quiet blockMesh blockMesh
    for wall in nearWallInteraction localInteraction; do
        rm -rf 0.06 postProcessing
        if [ $wall = localInteraction ]; then
            echo 'patches ( "(sides|floor|lid|front|back)" { type rebound; e 1; mu 0; } outlet { type escape; } );' > constant/interaction
            echo 'subModels { patchInteractionModel localInteraction; localInteractionCoeffs { #include "interaction" } }' >> constant/kinematicCloudProperties
        else
            printf 'model "<constant>/nearWall.toml";\npatches { "(sides|floor|lid|front|back)" { type rebound; } outlet { type escape; } }\n' > constant/interaction
        fi
        solve "filter/$wall" "$wall" "$solver" || return
        parcel_columns 0.06/lagrangian/kinematicCloud coordinates U > "parcels.$wall"
    done
    if [ "$(wc -l < parcels.localInteraction)" = 12 ] && cmp -s parcels.localInteraction parcels.nearWallInteraction
    then ok "filter/rebound (12 parcels where localInteraction has them, to the last digit)"
    else bad filter/rebound "$(diff parcels.localInteraction parcels.nearWallInteraction | head -n 4 | tr '\n' ' ')"; fi
    if grep -q "front: rebound" log.nearWallInteraction && ! grep -q "outlet.*not named" log.nearWallInteraction
    then ok filter/log; else bad filter/log "the rule of the cyclic patch is not listed"; fi

    # A pair on two ranks: OpenFOAM asks no model there
    printf 'model "<constant>/nearWall.toml";\npatches { front { type rebound; } }\n' > constant/interaction
    sed -i '/localInteraction/d' constant/kinematicCloudProperties
    sed -i 's/n (2 1 1)/n (1 2 1)/' system/decomposeParDict
    rm -rf 0.06 postProcessing; quiet decompose decomposePar
    if quiet split mpirun -np 2 "$solver" -parallel; then bad filter/split "the run went through"
    elif grep -q preservePatches log.split; then ok filter/split
    else bad filter/split "no remedy in $PWD/log.split"; fi
}

# A wall that has left the tables of its material stops no run that goes on
case_soft_restart() {
    local f n
    build multiphase "$work/soft_restart" || return
    tabled_material 290 800
    sed -i 's/"pyrex"/"tabled"/' constant/nearWall.toml
    settings 0.02 0.02
    solve soft_restart serial "$solver" || return
    LC_ALL=C sed -i 's/uniform 700;/uniform 900;/' 0.02/T
    settings 0.06 0.02 latestTime
    solve soft_restart restart "$solver" || return
    f="$(folder reactingCloud1 0.02)"; n="$(last "$f/floor.dat" unusable)"
    if [ "${n:-0}" -gt 0 ] && grep -q "patch floor, 16 of 16 faces: the wall temperature is 900 to 900 K" log.restart \
        && grep -q "could not be decided (the first: tabled: youngs_modulus is given for 290 to 800 K, asked for 900 K)" log.restart
    then ok "soft_restart ($n impacts counted)"; else bad soft_restart "$n counted, or the log does not say why"; fi
    check_balance soft_restart/balance reactingCloud1 0.02
}
