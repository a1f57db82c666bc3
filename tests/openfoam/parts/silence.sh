# Cases of run: what would change a result is said, or stops the run.
# shellcheck shell=bash disable=SC2154

# A run in binary files goes on, and OpenFOAM's tools read its files
case_binary() {
    local tool t
    cooled_box "$work/binary" 2.5 || return
    wall_condition "type nearWallDepositTemperature; cloud coalCloud1; h 900; Ta 500; thicknessLayers (0.004); kappaLayers (16);"
    settings 0.008 0.004
    solve binary whole "$solver" || return
    t="$(last "$(folder coalCloud1)/floor.wall.dat" wall_temperature_mean_K)"
    rm -rf 0.008 postProcessing; settings 0.008 0.004 latestTime
    solve binary restart "$solver" || return
    if near "$(last "$(folder coalCloud1 0.004)/floor.wall.dat" wall_temperature_mean_K)" "$t" 1e-7
    then ok "binary/restart ($t K)"; else bad binary/restart "$t K and $(last "$(folder coalCloud1 0.004)/floor.wall.dat" wall_temperature_mean_K) K"; fi
    # What the faces radiated at, as a run with a radiation model writes it, goes through ranks and back
    settings 0.008 0.004 latestTime ascii
    for tool in foamFormatConvert decomposePar reconstructPar; do
        if [ $tool = reconstructPar ]; then rm -rf 0.008; fi
        if quiet $tool $tool -latestTime; then ok "binary/$tool"; else bad "binary/$tool" "$(grep -A4 -m1 FATAL log.$tool | tr -s '\n ' ' ')"; fi
        if [ $tool = foamFormatConvert ]; then sed -i 's/^\( *\)Ta .*/&\n\1radiating uniform 650.5;/' 0.008/T; fi
    done
    t="$(grep -c 'radiating.*650.5' 0.008/T)"
    if [ "$t" = 3 ]; then ok binary/radiating; else bad binary/radiating "$t of 3 patches keep it"; fi
}

# Each fault of the condition of a cooled wall stops the run with patch, key and remedy
case_cooled-keys() {
    local own="type nearWallDepositTemperature; h 900; Ta 500;"
    cooled_box "$work/cooled-keys" 0 || return
    settings 0.01 0.01 startTime ascii
    cp 0/T T.good
    refuse_wall emisivity "$own cloud coalCloud1; emisivity 0.8; surroundingsTemperature 1200;" "unknown key 'emisivity'" "Patch 'floor' of T"
    refuse_wall both "$own cloud coalCloud1; qr qr; emissivity 0.8; surroundingsTemperature 1200;" "'qr' and 'emissivity' are both given" "Patch 'floor' of T"
    refuse_wall vapour "$own cloud coalCloud1; vapour KCl; bulkTemperature 1200;" "'vapour' and 'bulkTemperature' are both given" "Patch 'floor' of T"
    refuse_wall no-field "$own cloud coalCloud1; qr Qr;" "Patch 'floor' of T, key 'qr': there is no field 'Qr'" "call theirs qr"
    refuse_wall no-cloud "$own cloud coalCloud7;" "key 'cloud': 'coalCloud7' leaves no deposit there" "(coalCloud1 limestoneCloud1)"
}

refuse_wall() { # name condition message...
    local name="cooled-keys/$1" text
    cp T.good 0/T; wall_condition "$2"
    shift 2
    rm -rf 0.01 postProcessing
    if quiet bad "$solver"; then bad "$name" "the run went through"; return; fi
    tr -s ' \n' ' ' < log.bad | sed 's/ *( */(/g; s/ )/)/g' > log.flat
    for text in "FOAM FATAL" "$@"; do
        grep -qF -- "$text" log.flat || { bad "$name" "no \"$text\" in: $(grep -A6 'FATAL' log.bad | tr -s '\n ' ' ')"; return; }
    done
    ok "$name"
}

# Four parcels freeze on one face of the floor: 0.1 g of powder
powder_box() { # folder
    build kinematic "$1" || return
    { header vectorField parcels; echo "((0.033 0.037 0.009) (0.028 0.037 0.019) (0.023 0.037 0.029) (0.018 0.037 0.039))"; } > constant/parcels
    echo 'subModels { injectionModels { model1 { massTotal 1e-4; } } }' >> constant/kinematicCloudProperties
    printf '[[effects]]\nkind = "melting-transition"\ntemperature = 350\nwidth = 1\n' >> constant/nearWall.toml
    sed -i '1i particleTemperature 400; memory {}' constant/interaction
    sed -i 's/type interact;/type interact; wallTemperature 300;/' constant/interaction
    settings 0.03 0.03 startTime ascii
}

says() { # name log text...
    local name="$1" log="$2" text
    shift 2
    tr -s ' \n' ' ' < "log.$log" > log.flat
    for text in "$@"; do
        grep -qF -- "$text" log.flat || { bad "$name" "the log does not say \"$text\" (see $PWD/log.$log)"; return; }
    done
    ok "$name"
}

# What a restart takes over, what changed since, and what is missing
case_taken-over() {
    local f
    powder_box "$work/taken-over" || return
    solve taken-over first "$solver" || return
    if grep -q "changed since\|in the beginning" log.first; then bad taken-over/new "a case that begins has changed"; else ok taken-over/new; fi
    settings 0.034 0.03 latestTime ascii
    solve taken-over same "$solver" || return
    # 0.16 kg/m2 on one of 16 faces, 0.32 mm thick there
    says taken-over/deposit same "deposit on patch floor in the beginning: 0.0001 kg on 1 of 16 faces, mean thickness"
    expect_numbers taken-over/thickness "$(sed -n 's/.*floor in the beginning.*thickness \(.*\) mm/\1/p' log.same)" 0.02
    if grep -q "changed since" log.same; then bad taken-over/same "$(grep -m1 'changed since' log.same)"; else ok taken-over/same; fi
    rm -rf 0.034

    cp constant/interaction constant/interaction.good; cp constant/nearWall.toml nearWall.good
    sed -i 's/memory {}/memory { voidage 0.4; acceleration 2; }/; s/wallTemperature 300/wallTemperature 310/' constant/interaction
    sed -i 's/"montan-wax"/"paraffin"/; s/material = "montan-wax"/material = "pyrex"/' constant/nearWall.toml
    sed -i 's/"paraffin"/"fly-ash"/' constant/nearWall.toml
    solve taken-over changed "$solver" || return
    says taken-over/changed changed "changed since the earlier run: memory was 'defaults', is 'voidage 0.4, acceleration 2'" \
        "patch:floor was 'interact, wall 'floor', temperature 300 K', is 'interact, wall 'floor', temperature 310 K'" \
        'the model now has the line material = "fly-ash"'
    cp constant/interaction.good constant/interaction; cp nearWall.good constant/nearWall.toml; rm -rf 0.034

    sed -i 's/memory {}//' constant/interaction
    solve taken-over forgets "$solver" || return
    says taken-over/forgets forgets "memory was 'defaults', is 'none'" "the key 'memory' is gone: impacts meet bare walls"
    rm -rf 0.034
    for f in powderMass enclosedShare; do
        mv "0.03/kinematicCloud:$f" kept
        late="" refuse "no-$f" '' "Field kinematicCloud:$f of time 0.03 is missing" "Restore the file"
        mv kept "0.03/kinematicCloud:$f"
    done
}

# A layer of 1 mm given as 1 (m) in a box of 0.1 m: once, at the start
case_thick() {
    powder_box "$work/thick" || return
    sed -i 's/^\[walls.floor\]/&\nlayer_thickness = 1/' constant/nearWall.toml
    solve thick serial "$solver" || return
    says thick serial "deposit on patch floor is up to 1000 mm thick, 40" "layer_thickness"
    if [ "$(grep -c "mm thick, " log.serial)" = 1 ]; then ok thick/once; else bad thick/once "$(grep -c "mm thick, " log.serial) times"; fi
    cp constant/interaction constant/interaction.good
    refuse memory-stick 's/memory {}/memory { film yes; }/; s/type interact;.*/type stick; }/' "no patch has the type interact"
    refuse list-end 's/^patches$/patches (/; s/^{$//; s/^}$/)\nseed 1;/' "Key 'patches'" "';'"
    sed 's/wallTemperature 300/wallTemperature 27/' constant/interaction.good > constant/interaction
    quiet celsius "$solver"
    says thick/celsius celsius "wallTemperature of patch 'floor' is 27 K. If that is in degrees Celsius, write 300.15"
}

# No row of a table is lost without a word when it cannot be written, as on a full disk: here files may have 2 kB
case_full-disk() {
    build kinematic "$work/full-disk" || return
    # shellcheck disable=SC2016
    if bash -c 'trap "" XFSZ; ulimit -f 2; exec "$0"' "$solver" 2>&1 | cat > log.full
    then bad full-disk "the run went through"; return; fi
    says full-disk full "nearWallInteraction cannot write" "File too large" "go on from the last written time"
}
