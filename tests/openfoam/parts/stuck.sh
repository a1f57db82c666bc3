# Cases of run: what becomes of a parcel that stays on a wall.
# shellcheck shell=bash disable=SC2154

# Both clouds of the coal case, in hot gas, all captured on the floor. `how` is
# keep, react or remove. Numbers are written so that they read back to the bit.
hot_case() {    # how folder
    build coal "$2" || return
    settings 0.2 0.1 startTime ascii
    sed -i 's/writePrecision .*/writePrecision 17;/' system/controlDict
    sed -i "s/floor .*/floor { type stick; }/; 1i stuck $1;" constant/interaction
    local f
    for f in constant/*CloudProperties constant/*Cloud1Properties; do
        [ -e "$f" ] || continue
        echo 'cloudFunctions { hits { type $NEARWALL_ARRIVALS; maxStoredParcels 1000; patches (floor); } }' >> "$f"
    done
    solve "deposit/$1" "$1" "$solver"
}

# Columns of what a stock cloud function recorded at the wall, before the wall
# model acts: origProc origId and the named ones
recorded() {    # file column...
    local file="$1"; shift
    awk -v names="origProc origId $*" '
        NR == 1 {
            gsub(/[()#"]/, " "); m = split($0, word, " "); n = split(names, name, " ")
            for (i = 1; i <= n; i++) for (j = 1; j <= m; j++) if (word[j] == name[i]) at[i] = j
            next
        }
        { gsub(/[()]/, " "); $0 = $0; for (i = 1; i <= n; i++) printf "%s%s", $at[i], i < n ? " " : "\n" }' "$file" | sort
}

# Columns of a cloud's folder, one line a parcel: origProcId origId and the named
parcel_columns() {  # folder column...
    local folder="$1" f files=()
    shift
    for f in origProcId origId "$@"; do values "$folder/$f" > "column.$f"; files+=("column.$f"); done
    paste -d' ' "${files[@]}" | sort
}

sum_of() { values "$1" | awk '{ s += $1 } END { printf "%.17g\n", s }'; }

# keep: out of the solver's cloud, in the deposit as at the wall, and as it was
# later; react: OpenFOAM goes on integrating them
case_deposit() {
    local cloud d hits stuck
    hot_case keep "$work/deposit-keep" || return
    for cloud in $clouds; do
        d="lagrangian/${cloud}Deposit"
        hits="$(ls postProcessing/lagrangian/"$cloud"/hits/*/floor.{post,dat} 2>/dev/null | head -n 1)"
        recorded "$hits" T d > at-the-wall
        parcel_columns "0.1/$d" T d > kept.before
        parcel_columns "0.2/$d" T d mass conversion captureTime coordinates > kept.after
        parcel_columns "0.1/$d" T d mass conversion captureTime coordinates > kept.earlier
        if [ "$(wc -l < at-the-wall)" = 12 ] && [ -z "$(comm -3 at-the-wall kept.before)" ]
        then ok "deposit/keep/$cloud/as-at-the-wall (12 parcels, T and d to the bit)"
        else bad "deposit/keep/$cloud/as-at-the-wall" "$(comm -3 at-the-wall kept.before | head -n 2 | tr '\n' ' ')"; fi
        if [ -z "$(comm -3 kept.earlier kept.after)" ]
        then ok "deposit/keep/$cloud/unchanged (50 steps later, to the bit)"
        else bad "deposit/keep/$cloud/unchanged" "$(comm -3 kept.earlier kept.after | head -n 2)"
        fi
        stuck="$(last "$(folder "$cloud")/floor.dat" stick_mass_kg)"
        if near "$(sum_of "0.2/$d/mass")" "$stuck" 1e-12 \
            && near "$(last "$(folder "$cloud")/balance.dat" stuck_in_cloud_kg)" "$stuck" 1e-12
        then ok "deposit/keep/$cloud/mass ($stuck kg in files, table and balance)"
        else bad "deposit/keep/$cloud/mass" "$(sum_of "0.2/$d/mass") and $stuck"
        fi
        if [ "$(awk -v c="Cloud: $cloud" 'index($0, c) { here = 1 } here && /Current number of parcels/ { n = $NF; here = 0 } END { print n }' log.keep)" = 0 ]
        then ok "deposit/keep/$cloud/none-left-to-integrate"
        else bad "deposit/keep/$cloud/none-left-to-integrate" "the solver still has parcels"
        fi
        check_balance "deposit/keep/$cloud/balance" "$cloud" 0
    done
    deposit_files
    deposit_restart
    deposit_ranks

    hot_case react "$work/deposit-react" || return
    for cloud in $clouds; do
        d="lagrangian/$cloud"
        parcel_columns "0.1/$d" active coordinates > still.earlier
        parcel_columns "0.2/$d" active coordinates > still.after
        if [ "$(awk '$3 == 0' still.after | wc -l)" = 12 ] && [ -z "$(comm -3 still.earlier still.after)" ] \
            && ! values "0.2/$d/U" | grep -v '^0 0 0$' > /dev/null
        then ok "deposit/react/$cloud/still (12 parcels, no velocity)"
        else bad "deposit/react/$cloud/still" "one moved or has a velocity"
        fi
        parcel_columns "0.1/$d" T > changed.earlier; parcel_columns "0.2/$d" T > changed.after
        if [ "$(comm -13 changed.earlier changed.after | wc -l)" = 12 ]
        then ok "deposit/react/$cloud/heated ($(head -n1 changed.earlier | cut -d' ' -f3) K, then $(head -n1 changed.after | cut -d' ' -f3) K)"
        else bad "deposit/react/$cloud/heated" "OpenFOAM did not integrate them"; fi
        [ ! -e "0.2/lagrangian/${cloud}Deposit" ] && ok "deposit/react/$cloud/no-files" || bad "deposit/react/$cloud/no-files" "an empty deposit was written"
        check_balance "deposit/react/$cloud/balance" "$cloud" 0
    done
    if awk -v now="$(last "$(folder coalCloud1)/balance.dat" stuck_in_cloud_kg)" -v \
        then="$(last "$(folder coalCloud1)/floor.dat" stick_mass_kg)" \
        'BEGIN { exit !(now < 0.999*then) }'
    then ok "deposit/react/coal-burns ($(last "$(folder coalCloud1)/floor.dat" stick_mass_kg) kg captured, $(last "$(folder coalCloud1)/balance.dat" stuck_in_cloud_kg) kg left)"
    else bad deposit/react/coal-burns "its mass is that at capture"; fi

    hot_case remove "$work/deposit-remove" || return
    for cloud in $clouds; do
        stuck="$(last "$(folder "$cloud")/floor.dat" stick_mass_kg)"
        if near "$(last "$(folder "$cloud")/balance.dat" stuck_removed_kg)" "$stuck" 1e-12 \
            && [ ! -e "0.2/lagrangian/$cloud" ] \
            && near "$(face_mass "$cloud")" "$stuck" 1e-9
        then ok "deposit/remove/$cloud ($stuck kg booked at the faces)"
        else bad "deposit/remove/$cloud" "booked $(last "$(folder "$cloud")/balance.dat" stuck_removed_kg), on faces $(face_mass "$cloud"), stuck $stuck"
        fi
        check_balance "deposit/remove/$cloud/balance" "$cloud" 0
    done
}

# Mass on the floor by the wall field; its 16 faces have 0.1^2/16 m2 each
face_mass() {
    awk '$1 == "floor" { on = 1 } on && NF == 1 && $1 ~ /^[-0-9.e+]+$/ { if (n++) s += $1 } on && $1 == "}" { on = 0 }
        END { printf "%.12g\n", s*0.01/16 }' "0.2/$1:depositedMass"
}

# What ParaView opens
deposit_files() {
    local f missing=""
    for f in positions coordinates origId d nParticle mass T conversion captureTime regime typeId; do
        [ -s "0.2/lagrangian/coalCloud1Deposit/$f" ] || missing+=" $f"
    done
    if [ -z "$missing" ]; then ok deposit/files; else bad deposit/files "not written:$missing"; fi
    if quiet toVTK foamToVTK -latestTime -ascii && grep -aqs 'captureTime' VTK/lagrangian/coalCloud1Deposit/*.vtp \
        && grep -aqs 'NumberOfPoints=.12' VTK/lagrangian/coalCloud1Deposit/*.vtp
    then ok deposit/foamToVTK
    else bad deposit/foamToVTK "no file with 12 points and captureTime (see $PWD/log.toVTK)"
    fi
}

# Go on with react: what lies in the deposit stays there and is counted
deposit_restart() {
    rm -rf "$work/deposit-restart"; cp -r "$PWD" "$work/deposit-restart" && cd "$work/deposit-restart" || return
    rm -rf 0.2 postProcessing VTK
    settings 0.2 0.1 latestTime ascii
    sed -i 's/stuck keep/stuck react/' constant/interaction
    solve deposit/restart restart "$solver" || return
    parcel_columns 0.2/lagrangian/coalCloud1Deposit T d mass conversion captureTime coordinates > kept.again
    parcel_columns "$work/deposit-keep/0.2/lagrangian/coalCloud1Deposit" T d mass conversion captureTime coordinates > kept.after
    if [ -s kept.again ] && [ -z "$(comm -3 kept.after kept.again)" ]
    then ok deposit/restart-as-react; else bad deposit/restart-as-react "the deposit changed"; fi
    check_balance deposit/restart-as-react/balance coalCloud1 0.1
    cd "$work/deposit-keep" || return
}

# Two ranks, put together again: the same deposit
deposit_ranks() {
    local what="T d mass coordinates"
    rm -rf "$work/deposit-ranks"; cp -r "$PWD" "$work/deposit-ranks" && cd "$work/deposit-ranks" || return
    rm -rf 0.1 0.2 postProcessing VTK
    quiet decompose decomposePar
    solve deposit/ranks ranks mpirun -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar
    values 0.2/lagrangian/limestoneCloud1Deposit/positions | awk '{ printf "%.9f %.9f %.9f\n", $1, $2, $3 }' | sort > places.ranks
    values "$work/deposit-keep/0.2/lagrangian/limestoneCloud1Deposit/positions" | awk '{ printf "%.9f %.9f %.9f\n", $1, $2, $3 }' | sort > places.serial
    if [ -s places.serial ] && cmp -s places.serial places.ranks
    then ok "deposit/reconstructPar ($(wc -l < places.ranks) parcels)"
    else bad deposit/reconstructPar "$(wc -l < places.ranks) parcels, serial $(wc -l < places.serial)"
    fi
    cd "$work/deposit-keep" || return
}

# Solver time of a step with 10^4 stuck parcels. Timing is no pass or fail.
case_cost() {
    local kind how t
    for kind in kinematic coal; do
        for how in remove keep react; do
            build "$kind" "$work/cost-$kind-$how" || return
            { header vectorField parcels; echo "("
              awk 'BEGIN { srand(3); for (i = 0; i < 10000; i++) printf "(%.6f %.6f %.6f)\n", 0.002 + 0.09*rand(), 0.002 + 0.096*rand(), 0.0005 + 0.002*rand() }'
              echo ")"; } > constant/parcels
            sed -i "s/floor .*/floor { type stick; }/; 1i stuck $how;" constant/interaction
            for t in constant/*Cloud1Properties constant/kinematicCloudProperties; do
                [ -e "$t" ] && echo 'subModels { injectionModels { model1 { massTotal 6e-6; } } particleForces { sphereDrag; } }' >> "$t"
            done
            if [ "$kind" = kinematic ]; then settings 1 1; else settings 0.2 0.2; fi
            solve "cost/$kind/$how" run "$solver" || return
            t="$(awk '/^ExecutionTime/ { if (++n == 10) a = $3; b = $3 } END { printf "%.3g", 1000*(b - a)/(n - 10) }' log.run)"
            eval "cost_$how=$t"
        done
        if [ "$(last "$(folder "${clouds%% *}")/floor.dat" sticks)" = 10000 ]
        then ok "cost/$kind (10000 stuck; ms a step: none $cost_remove, keep $cost_keep, react $cost_react; react/keep $(awk -v a="$cost_react" -v b="$cost_keep" 'BEGIN { printf "%.1f", a/b }'))"
        else bad "cost/$kind" "not all stuck"; fi
    done
}
