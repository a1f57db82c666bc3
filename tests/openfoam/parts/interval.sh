# Cases of run: deposits that advance at an interval of their own.
#     tests/openfoam/run powder-cost   by hand: what resting powder costs a step of a coal case
# shellcheck shell=bash disable=SC2154

# folder keys-of-memory: melt that runs down, powder that sheds in pieces by the rank of its place
shedding_box() {
    melting_box "$1" || return
    sed -i 's/^\[walls.*\]/&\nshedding = { tensile_strength = 20, shear_strength = 12, spread = 1.5 }/' constant/nearWall.toml
    sed -i "s/film yes;/film yes; $2/" constant/interaction
}

# folder keys-of-memory: melt arrives all over a vertical wall, lies there from the beginning and runs down
running_wall() {
    film_case 4 "$1" || return
    sed -i 's/deltaT .*/deltaT 0.002;/' system/controlDict
    settings 0.2 0.2 startTime ascii
    sed -i "s/film yes;/film yes; $2/" constant/interaction
    field kinematicCloud:moltenMass volScalarField "1 -2 0 0 0 0 0" 0 "type calculated; value uniform 1;" "type calculated; value uniform 0;"
}

# folder steps: 20 g/m2 of grains that cover the floor three times
blown_layers() {
    windy_box "$1" || return
    loose_powder
    sed -i 's/uniform 1e-3;/uniform 2e-2;/; s/uniform 2e-6;/uniform 4e-5;/; s/uniform 0.15;/uniform 3;/' 0/kinematicCloud:*
    printf '[walls.%s.resuspension]\nwork_of_adhesion = 0.56\n' floor default >> constant/nearWall.toml
    sed -i "s/acceleration 100;/acceleration 100; intervalSteps $2;/" constant/interaction
    settings 0.1 0.1 startTime ascii
}

# The film at the end, against that of each step: the mean difference over the mean
film_distance() {
    film_profile 0.2 | paste - "$work/interval.each" | awk '
        { d = $2 - $4; s += d < 0 ? -d : d; all += $4 } END { printf "%.6g", NR == 16 ? s/all : 9e9 }'
}

# Shorter intervals come nearer to steps, an interval of a step is that, to the bit; restarts and ranks
case_interval() {
    local n keys far="" said each
    offers postProcess || return    # it writes the places of the faces
    running_wall "$work/interval" "" || return
    solve interval each "$solver" || return
    film_profile 0.2 > "$work/interval.each"
    for keys in "intervalSteps 1;" "interval 0.002;"; do
        running_wall "$work/interval-one" "$keys" || return
        solve interval one "$solver" || return
        if diff -r "$work/interval/postProcessing" postProcessing > differs \
            && diff "$work/interval/0.2/kinematicCloud:moltenMass" 0.2/kinematicCloud:moltenMass >> differs
        then ok "interval/default ($keys)"; else bad interval/default "$keys $(head -n 1 differs)"; fi
    done
    for n in 20 10 5 2; do
        running_wall "$work/interval-$n" "intervalSteps $n;" || return
        solve interval "$n" "$solver" || return
        check_memory_balance "interval/balance-$n" "$(folder kinematicCloud)"/*.wall.dat
        said="$(film_distance)"
        if awk -v a="$said" -v b="${far:-1}" 'BEGIN { exit !(a > 0 && a < 0.65*b) }'
        then ok "interval/$n-steps (the film differs by $said from that of each step)"
        else bad "interval/$n-steps" "the film differs by $said, with the longer interval by ${far:-1}"; fi
        far="$said"
    done

    # Three layers of powder in the wind, of which a third leaves
    far=""
    for n in 1 25 10 5; do
        blown_layers "$work/interval-blown" "$n" || return
        solve interval blown "$solver" || return
        said="$(last "$(folder kinematicCloud)/floor.wall.dat" resuspended_kg)"
        [ -n "$far" ] || { each="$said"; far=1e9; continue; }
        said="$(awk -v a="$said" -v b="$each" 'BEGIN { d = a/b - 1; print d < 0 ? -d : d }')"
        if awk -v a="$said" -v b="$far" 'BEGIN { exit !(a > 0 && a < 2e-3 && a < 0.65*b) }'
        then ok "interval/resuspended-$n-steps (differs by $said from each step)"
        else bad "interval/resuspended-$n-steps" "differs by $said from each step, with the longer interval by $far"; fi
        far="$said"
    done

    # 50 steps are no multiple of 7: the restart is in the middle of an interval
    rm -rf "$work/memory-ranks"; shedding_box "$work/memory-ranks" "interval 0.014;" || return
    solve interval seven "$solver" || return
    grep -q "deposits advance every 0.014 s" log.seven && ok interval/log || bad interval/log "the log does not say the interval"
    totals_but_residual 0 > totals.serial
    memory_values 0.2 > values.serial
    rm -rf "$work/interval-again"; cp -r "$work/memory-ranks" "$work/interval-again" && cd "$work/interval-again" || return
    rm -rf 0.2 postProcessing; settings 0.2 0.1 latestTime ascii
    solve interval again "$solver" || return
    memory_compare interval/restart 0.1
    rm -rf "$work/interval-2"; cp -r "$work/memory-ranks" "$work/interval-2" && cd "$work/interval-2" || return
    rm -rf 0.1 0.2 postProcessing
    decompose_into 2 "(2 1 1)"
    solve interval ranks2 mpirun --oversubscribe -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    memory_compare interval/2-ranks 0

    sed -i 's/interval 0.014;/interval 0.014; intervalSteps 7;/' constant/interaction
    quiet both "$solver"
    grep -q "'interval' \[s\] and 'intervalSteps' are both given" log.both && ok interval/both || bad interval/both "not refused"
}

# How much longer is a step with powder in the wind on all faces of a wide duct of a coal cloud, 2 mm and 2 cells high? Without
# memory, with deposits at an interval of 10 steps and at each step: CPU time of the last ten of 12 steps, largest memory
case_powder-cost() {
    local side="${SIDE:-224}" how time bare=""
    for how in none interval each; do
        build coal "$work/powder-cost-$how" || return
        sed -i "s/(4 4 4)/($side $side 2)/" system/blockMeshDict
        sed -i 's/(0 0 1) (1 0 1) (1 1 1) (0 1 1)/(0 0 0.02) (1 0 0.02) (1 1 0.02) (0 1 0.02)/' system/blockMeshDict
        sed -i 's/uniform (0 0 0);/uniform (20 0 0);/' 0/U
        sed -i 's/deltaT .*/deltaT 2e-5;/' system/controlDict
        sed -i 's/ 0\.\(0[0-9]*\))$/ 0.00\1)/' constant/parcels
        quiet blockMesh blockMesh || return
        powder_walls "$how"
        settings 0.00024 1
        measured spent "$solver" || { bad "powder-cost/$how" "the solver failed, see $PWD/log.measured"; return; }
        time="$(awk '/^ExecutionTime/ { t[++n] = $3 } END { print (t[n] - t[n - 10])/10 }' log.measured)"
        [ "$how" != none ] || bare="$time $(cut -d' ' -f2 spent)"
        ok "powder-cost/$how ($((2*side*side)) faces: $time s a step, $(echo "$time $(cut -d' ' -f2 spent) $bare" | awk -v n="$((2*side*side))" \
            '{ printf "%.1f %% and %.2f kB a face", 100*($1/$3 - 1), 1000*($2 - $4)/n }') more than without memory)"
    done
}

# how: powder of 1 kg/m2 that the gas may carry away, on floor and lid
powder_walls() {
    local cloud=coalCloud1 f value
    sed -i 's/^\[walls.default\]/&\nresuspension = { work_of_adhesion = 0.56 }\nshedding = { tensile_strength = 1e4, shear_strength = 1e4 }/; s/^\[walls.floor\]/&\nresuspension = { work_of_adhesion = 0.56 }\nshedding = { tensile_strength = 1e4, shear_strength = 1e4 }/' constant/nearWall.toml
    sed -i 's/lid .*/lid { type interact; wall floor; }/' constant/interaction
    case "$1" in
        none) return ;;
        interval) sed -i '1i memory { intervalSteps 10; }' constant/interaction ;;
        each) sed -i '1i memory { }' constant/interaction ;;
    esac
    for f in "powderMass 1 [1 -2 0 0 0 0 0]" "layerThickness 0.002 [0 1 0 0 0 0 0]" "coverArea 30 [0 0 0 0 0 0 0]"; do
        # shellcheck disable=SC2086
        set -- $f; value="$2"
        { header volScalarField "$cloud:$1"
          echo "dimensions ${f#* * }; internalField uniform 0;"
          echo "boundaryField { \"(floor|lid)\" { type calculated; value uniform $value; } \".*\" { type calculated; value uniform 0; } }"
        } > "0/$cloud:$1"
    done
}
