# Cases of run: what goes round between gas, parcels and walls: the heat of what lands, and the mass that leaves again.
# shellcheck shell=bash disable=SC2154

# Every row of these tables closes to 1e-9
closes() { # name table...
    local name="$1" said
    shift
    if said="$(awk '
        $1 == "#" { for (i = 2; i <= NF; i++) at[$i] = i - 1; next }
        { r = $at["residual"]; if (r < 0) r = -r; if (r > m) m = r; rows++ }
        END { printf "%d rows, largest residual %.2g", rows, m; exit !(rows && m <= 1e-9) }' "$@")"
    then ok "$name ($said)"; else bad "$name" "$said"; fi
}

# 400 parcels of 62.5 ug, 1000 J/kg/K and this temperature [K] rain onto the floor for 50 ms: 0.05 kg/m2/s. The steam side holds
# the wall at 500 K
rain() { # folder parcel-temperature
    growing_box "$1" || return
    {
        header vectorField parcels
        echo "("
        awk 'BEGIN { srand(11); for (i = 0; i < 400; i++)
            printf "(%.6f %.6f %.6f)\n", 0.005 + 0.04*rand(), 0.01 + 0.08*rand(), 0.003 + 0.094*rand() }'
        echo ")"
    } > constant/parcels
    sed -i 's/massTotal 0.003; /massTotal 2.5e-5; /' constant/limestoneCloud1Properties
    sed -i "s/T0 1100; Cp0 33;/T0 $2;/" constant/limestoneCloud1Properties
    sed -i 's/memory { acceleration 2; }/memory { } record { maxRows 1000; }/' constant/interaction
    sed -i '/^\[walls.floor.shedding\]/,$ d' constant/nearWall.toml
    sed -i 's/h 900;/h 1e7;/; s/uniform 700/uniform 500/; s/emissivity.*1300;//' 0/T
    settings 0.05 0.01 startTime ascii
}

# What the captured parcels of impacts.csv bring by hand [J]: 1000 (T_p - T) and so much heat of fusion [J/kg]. They give it while
# the deposit makes the surface warmer by some kelvin: at least with the highest T of the floor, at most with that of each impact
as_by_hand() { # name folder fusion
    local found most least
    found="$(brought "$2")"
    most="$(brought_by_hand "$2" "$3" 0)"
    least="$(brought_by_hand "$2" "$3" "$(last "$2/floor.wall.dat" wall_temperature_max_K)")"
    if awk -v q="$found" -v a="$least" -v b="$most" 'BEGIN { exit !(a > 0.98*b && q >= a && q <= b) }'
    then ok "$1 ($found J, by hand $least to $most)"; else bad "$1" "$found J, by hand $least to $most"; fi
}

brought_by_hand() { # folder fusion temperature-of-the-surface
    awk -F, -v L="$2" -v T="$3" '
        /^#/ { next }
        !("mass" in at) { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["outcome"] == "stuck" || $at["outcome"] == "stick" { sum += $at["mass"]*(1000*($at["T_p"] - (T > 0 ? T : $at["T_w"])) + L) }
        END { printf "%.12g", sum }' "$1/impacts.csv"
}

# What they gave, and have still to give
brought() { # folder
    awk -v a="$(last "$1/floor.heat.dat" particles_J)" -v b="$(last "$1/floor.heat.dat" waiting_J)" 'BEGIN { printf "%.12g", a + b }'
}

heat_of() { # start-folder
    local f patch column
    for patch in floor lid sides; do
        f="$(folder limestoneCloud1 "$1")/$patch.heat.dat"
        for column in gas_J radiation_J particles_J condensation_J coolant_J melting_J landed lagging_J waiting_J; do
            echo "$patch-$column $(last "$f" "$column")"
        done
    done
}

# The lag is a small difference, and the gas is restarted to 5e-6 only
same_heat() { # name start-folder tolerance
    local difference
    heat_of "$2" | grep -v lagging_J > heat
    if difference="$(same_totals "$work/landed/heat" heat "$3")"
    then ok "$1/heat"; else bad "$1/heat" "$(head -n 1 <<< "$difference")"; fi
    closes "$1/balance" "$(folder limestoneCloud1 "$2")"/*.heat.dat
}

case_landed() {
    local dir="$work/landed" f said
    rain "$dir" 1100 || return
    solve landed serial "$solver" || return
    heat_of 0 | grep -v lagging_J > heat
    f="$(folder limestoneCloud1)"
    closes landed/balance "$f"/*.heat.dat
    as_by_hand landed/sensible "$f" 0
    said="$(awk -v q="$(brought "$f")" 'BEGIN { printf "%.1f", q/(1e3*0.01*0.05) }')"
    if awk -v q="$said" 'BEGIN { exit !(q > 10 && q < 65) }'
    then ok "landed/order ($said kW/m2 of 0.05 kg/m2/s)"; else bad landed/order "$said kW/m2"; fi
    expect_numbers landed/count "$(last "$f/floor.heat.dat" landed)" "$(last "$f/floor.dat" sticks)"

    rm -rf "$dir-restart"; mkdir "$dir-restart"; cp -r 0 0.04 constant system "$dir-restart"; cd "$dir-restart" || return
    settings 0.05 0.02 latestTime ascii
    solve landed restart "$solver" && same_heat landed/restart 0.04 1e-4
    rm -rf "$dir-2"; mkdir "$dir-2"; cp -r "$dir"/{0,constant,system} "$dir-2"; cd "$dir-2" || return
    ranks_are 2
    quiet decompose decomposePar
    solve landed ranks mpirun -np 2 "$solver" -parallel || return
    same_heat landed/ranks 0 1e-6

    # Drops of 1500 K that freeze on the wall bring their heat of fusion, too
    rain "$work/landed-drops" 1500 || return
    molten_model
    solve landed drops "$solver" || return
    f="$(folder limestoneCloud1)"
    as_by_hand landed/fusion "$f" 2e5
    closes landed/fusion-balance "$f"/*.heat.dat
    melted_layer
    landed_interval
}

# Deposits that advance in every fifth step take the same heat, and what waits in between is in the balance
landed_interval() {
    local f said
    rain "$work/landed-interval" 1100 || return
    sed -i 's/memory { }/memory { intervalSteps 5; }/' constant/interaction
    settings 0.056 0.014 startTime ascii
    solve landed interval "$solver" || return
    f="$(folder limestoneCloud1)"
    said="$(brought "$f")"
    as_by_hand landed/interval "$f" 0
    closes landed/interval-balance "$f"/*.heat.dat
    rm -rf "$work/landed-interval-restart"; mkdir "$work/landed-interval-restart"
    cp -r 0 0.028 constant system "$work/landed-interval-restart"; cd "$work/landed-interval-restart" || return
    settings 0.056 0.014 latestTime ascii
    solve landed interval-restart "$solver" || return
    closes landed/interval-restart "$(folder limestoneCloud1 0.028)"/*.heat.dat
    if near "$(brought "$(folder limestoneCloud1 0.028)")" "$said" 1e-5
    then ok landed/interval-same; else bad landed/interval-same "$(brought "$(folder limestoneCloud1 0.028)") J, $said J"; fi
}

# 400 hot parcels bounce in the box and cool by what they give to its cooled walls while they touch them: what they lost, by their
# temperatures at the end, is what the tables say, and waits for the surface or is in its balance
bounced_heat() { # name start-folder temperatures tolerance
    local f lost said patch
    f="$(folder limestoneCloud1 "$2")"
    closes "$1/balance" "$f"/*.heat.dat
    lost="$(values "$3" | awk '{ sum += 2.5e-5/400*1000*(1100 - $1); n++ } END { printf "%.15g", sum; exit n != 400 }')" \
        || bad "$1/parcels" "not 400 in $3"
    said="$(for patch in floor lid sides; do last "$f/$patch.dat" contact_heat_J; done | awk '{ sum += $1 } END { printf "%.15g", sum }')"
    if awk -v q="$lost" 'BEGIN { exit !(q > 0) }' && near "$lost" "$said" "$4"
    then ok "$1/lost ($said J)"; else bad "$1/lost" "$said J, the parcels lost $lost J"; fi
    for patch in floor lid sides; do
        lost="$(last "$f/$patch.dat" contact_heat_J)"
        said="$(awk -v a="$(last "$f/$patch.heat.dat" particles_J)" -v b="$(last "$f/$patch.heat.dat" waiting_J)" 'BEGIN { printf "%.15g", a + b }')"
        if near "${lost:-0}" "$said" 1e-9; then ok "$1/$patch ($said J)"; else bad "$1/$patch" "$said J, contact heat $lost J"; fi
    done
}

case_bounced() {
    local dir="$work/bounced"
    rain "$dir" 1100 || return
    sed -i '/^\[\[effects\]\]/,$ d' constant/nearWall.toml
    sed -i 's/"pyrex"/"ash"\ncontact_heat = true/; s/^thermal_conductivity/heat_capacity = 1000\n&/' constant/nearWall.toml
    sed -i 's/T0 1100;/& Cp0 1000;/' constant/limestoneCloud1Properties
    settings 0.06 0.02 startTime ascii
    solve bounced serial "$solver" || return
    bounced_heat bounced/serial 0 0.06/lagrangian/limestoneCloud1/T 1e-9
    expect_numbers bounced/count "$(last "$(folder limestoneCloud1)/floor.heat.dat" landed)" "$(last "$(folder limestoneCloud1)/floor.dat" rebounds)"
    heat_of 0 | grep -v lagging_J > heat

    rm -rf "$dir-restart"; mkdir "$dir-restart"; cp -r 0 0.04 constant system "$dir-restart"; cd "$dir-restart" || return
    settings 0.06 0.02 latestTime ascii
    solve bounced restart "$solver" && bounced_heat bounced/restart 0.04 0.06/lagrangian/limestoneCloud1/T 1e-9
    rm -rf "$dir-2"; mkdir "$dir-2"; cp -r "$dir"/{0,constant,system} "$dir-2"; cd "$dir-2" || return
    ranks_are 2
    quiet decompose decomposePar
    solve bounced ranks mpirun -np 2 "$solver" -parallel || return
    quiet together reconstructPar -latestTime
    bounced_heat bounced/ranks 0 0.06/lagrangian/limestoneCloud1/T 1e-9
}

# Ash that is solid below 1400 K, with a heat of fusion
molten_model() {
    sed -i 's/^viscosity = .*/critical_viscosity_temperature = 1400\nviscosity = 100\nheat_of_fusion = 2e5/' constant/nearWall.toml
    sed -i '/^\[\[effects\]\]/,$ d' constant/nearWall.toml
    printf '[capture]\nmodel = "viscosity"\nlaw = "kalmanovitch-frank"\nreference_viscosity = 1e4\n' >> constant/nearWall.toml
}

# 2 mm of powder under surroundings of 1900 K for 50 ms, a thousand seconds of the deposit: what is molten took its heat of fusion,
# and the gas, whose cells see the same walls, gave what the table says
melted_layer() {
    local f patch said
    rain "$work/landed-melt" 1500 || return
    molten_model
    sed -i 's/"pyrex"/"pyrex"\nlayer_thickness = 2e-3/' constant/nearWall.toml
    sed -i 's/massTotal 2.5e-5; /massTotal 0; /' constant/limestoneCloud1Properties
    sed -i 's/memory { }/memory { acceleration 2e4; }/' constant/interaction
    sed -i 's/h 1e7;/h 1e7; emissivity 0.9; surroundingsTemperature 1900;/' 0/T
    solve landed melt "$solver" || return
    f="$(folder limestoneCloud1)"
    closes landed/melt-balance "$f"/*.heat.dat
    for patch in floor lid sides; do
        # The first step is not in the table of heat
        said="$(awk -v patch="$patch" '
            FNR == 1 { for (i = 2; i <= NF; i++) at[FILENAME, $i] = i - 1; next }
            FILENAME ~ /wall.dat/ { m = $at[FILENAME, "molten_kg"]; if (FNR == 2) first = m; next }
            { q = $at[FILENAME, "melting_J"]; held = $at[FILENAME, "lagging_J"]/$at[FILENAME, "radiation_J"] }
            END { d = q/(2e5*(m - first)) - 1; printf "%.6g kg of slag took %.6g J, lag %.1e of the radiation", m - first, q, held
                exit !((m - first)^2 > 1e-6 && d*d < 1e-14 && held*held < 1e-4) }' "$f/$patch.wall.dat" "$f/$patch.heat.dat")" \
            && ok "landed/melt-$patch ($said)" || bad "landed/melt-$patch" "$said"
    done
}

# Potassium chloride condenses from still gas of 1200 K on walls of 700 K, where nearly none of its vapour is left. The boundary layer
# is within the box: by film theory the salt is 0.074551 kg/mol 3.8903e-5/(1200 0.029 2^(2/3) 500 K) of the heat, on any mesh
case_condensed() {
    local cells said
    for cells in 4 16; do
        cooled_box "$work/condensed-$cells" 0 || return
        sed -i "s/(4 4 4)/(4 4 $cells)/" system/blockMeshDict
        quiet blockMesh blockMesh
        printf '[walls.default.condensation]\nvapour = "KCl"\nmass_fraction = 1e-4\n' >> constant/nearWall.toml
        wall_condition "type nearWallDepositTemperature; cloud coalCloud1; h 1e7; Ta 700; bulkTemperature 1200;"
        solve condensed "$cells" "$solver" || return
        closes "condensed/balance-$cells" "$(folder coalCloud1)"/lid.heat.dat
        # The first step is not in the table of heat
        said="$(awk '
            FNR == 1 { for (i = 2; i <= NF; i++) at[FILENAME, $i] = i - 1; next }
            FILENAME ~ /wall.dat/ { m = $at[FILENAME, "condensed_kg"]; if (FNR == 11) m0 = m; next }
            { q = $at[FILENAME, "gas_J"]; if (FNR == 11) q0 = q }
            END { hand = 0.074551*3.8903e-5/(1200*0.029*2^(2/3)*500)*(q - q0); d = (m - m0)/hand - 1; printf "%.5g kg, %.1e from that by hand", m - m0, d
                exit !(hand > 0 && d*d < 1e-6) }' "$(folder coalCloud1)"/lid.{wall,heat}.dat)" \
            && ok "condensed/by-hand-$cells ($said)" || bad "condensed/by-hand-$cells" "$said"
    done
}

# Parcels that stick to every wall; the floor holds some 80 ug/m2 against gravity, which points up, and so does the lid downwards
returning_box() { # folder
    build kinematic "$1" || return
    {
        header vectorField parcels
        echo "("
        awk 'BEGIN { srand(5); for (i = 0; i < 400; i++)
            printf "(%.6f %.6f %.6f)\n", 0.005 + 0.04*rand(), 0.01 + 0.08*rand(), 0.003 + 0.02*rand() }'
        echo ")"
    } > constant/parcels
    printf '%s\n' 'model "<constant>/nearWall.toml"; stuck remove; particleTemperature 350;' \
        'memory { shed { parcels yes; } } patches { outlet { type rebound; } }' > constant/interaction
    echo 'subModels { particleForces { gravity; } }' >> constant/kinematicCloudProperties
    cat >> constant/nearWall.toml <<'END'
[[effects]]
kind = "melting-transition"
temperature = 300
width = 5
[walls.floor.shedding]
tensile_strength = 8e-4
shear_strength = 1
spread = 1.5
[walls.default.shedding]
tensile_strength = 8e-4
shear_strength = 1
spread = 1.5
END
    gravity_is 9.81
    sed -i 's/writePrecision .*/writePrecision 17;/' system/controlDict
}

gravity_is() { sed -i "s/^value .*/value (0 0 $1);/" constant/g; }

# injected = airborne + removed, and what was removed lies on the walls or waits there, to 1e-9
goes_round() { # name start-folder
    local f patch on=0 removed returned
    check_balance "$1/balance" "$clouds" "$2"
    f="$(folder "$clouds" "$2")"
    closes "$1/left" "$f"/*.returned.dat
    for patch in floor lid sides; do
        on="$(awk -v a="$on" -v b="$(last "$f/$patch.wall.dat" powder_kg)" -v c="$(last "$f/$patch.wall.dat" molten_kg)" \
            -v d="$(last "$f/$patch.wall.dat" frozen_kg)" -v e="$(last "$f/$patch.returned.dat" waiting_kg)" \
            'BEGIN { printf "%.17g", a + b + c + d + e }')"
    done
    removed="$(last "$f/balance.dat" stuck_removed_kg)"
    returned="$(last "$f/floor.returned.dat" returned_kg) $(last "$f/lid.returned.dat" returned_kg)"
    if near "$on" "$removed" 1e-9; then ok "$1/on-walls ($removed kg; came back $returned kg)"
    else bad "$1/on-walls" "on the walls $on kg, removed from the cloud $removed kg"; fi
}

# Where the mass of the first turn is
round_of() {
    local f patch
    f="$(folder kinematicCloud)"
    echo "airborne $(last "$f/balance.dat" airborne_kg)"
    for patch in floor lid; do
        echo "$patch $(last "$f/$patch.returned.dat" returned_kg) $(last "$f/$patch.returned.dat" returned_parcels) $(last "$f/$patch.wall.dat" arrived_kg)"
    done
}

case_returned() {
    local dir="$work/returned" turn gravity t=0 difference
    returning_box "$dir" || return
    for turn in 1 2 3 4; do
        # Each turn goes on from the last, with gravity the other way round
        gravity="$([ $((turn % 2)) = 1 ] && echo 9.81 || echo -9.81)"
        gravity_is "$gravity"
        settings "$(awk -v n="$turn" 'BEGIN { print 0.2*n }')" 0.2 latestTime ascii
        solve returned "turn$turn" "$solver" || return
        goes_round "returned/turn$turn" "$t"
        t="$(awk -v n="$turn" 'BEGIN { print 0.2*n }')"
    done
    if awk -v a="$(last "$(folder kinematicCloud 0.6)/floor.returned.dat" returned_parcels)" \
        -v b="$(last "$(folder kinematicCloud 0.6)/lid.returned.dat" returned_parcels)" 'BEGIN { exit !(a > 10 && b > 10) }'
    then ok returned/both-ways; else bad returned/both-ways "too few parcels came back"; fi

    round_of > round
    returning_box "$dir-2" || return
    settings 0.2 0.2 startTime ascii
    ranks_are 2
    quiet decompose decomposePar
    solve returned ranks mpirun -np 2 "$solver" -parallel || return
    goes_round returned/ranks 0
    round_of > round
    if difference="$(same_totals "$dir/round" round 1e-9)"
    then ok returned/ranks; else bad returned/ranks "$(head -n 1 <<< "$difference")"; fi
    returned_sizes
    returned_heat
    returned_composition
    returned_oxide
    refused_return
}

# Given sizes: the masses of the parcels have their shares, by volume 0.3 at 0.2 mm and 0.7 at 1 mm
returned_sizes() {
    returning_box "$work/returned-sizes" || return
    sed -i 's/parcels yes;/parcels yes; sizes ((2e-4 0.3) (1e-3 0.7));/' constant/interaction
    settings 0.06 0.06 startTime ascii
    solve returned sizes "$solver" || return
    goes_round returned/sizes 0
    local said
    said="$(paste <(values 0.06/lagrangian/kinematicCloud/d) <(values 0.06/lagrangian/kinematicCloud/nParticle) \
        | awk '$1 > 1.5e-4 { m[$1 > 5e-4] += $2*$1^3 } END { printf "%.9g", m[0]/(m[0] + m[1]) }')"
    expect_numbers returned/shares "$said" 0.3
}

# A thermo cloud: what comes back has the temperature of its face
returned_heat() {
    local said
    growing_box "$work/returned-thermo" || return
    sed -i 's/memory { acceleration 2; }/stuck remove; memory { acceleration 2; shed { parcels yes; } }/' constant/interaction
    sed -i 's/memory/#includeIfPresent "coalMemory"\nmemory/' constant/interaction
    echo 'subModels { particleForces { gravity; } nearWallInteractionCoeffs { memory { shed { parcels no; } } } }' >> constant/coalCloud1Properties
    echo 'subModels { particleForces { gravity; } }' >> constant/limestoneCloud1Properties
    solve returned thermo "$solver" || return
    check_balance returned/thermo-balance limestoneCloud1 0
    closes returned/thermo-left "$(folder limestoneCloud1)"/*.returned.dat
    said="$(values 0.1/lagrangian/limestoneCloud1/T | awk '$1 < 1099 && $1 > 500 { n++ } END { print n + 0 }')"
    if [ "$said" -gt 0 ]; then ok "returned/thermo ($said parcels colder than injected)"
    else bad returned/thermo "no parcel came back"; fi
}

# The box that gives back, with another cloud
returning_cloud() { # kind folder
    returning_box "$2" || return
    cp constant/{parcels,interaction,nearWall.toml,g} ..
    build "$1" "$2" || return
    mv ../{parcels,interaction,nearWall.toml,g} constant
    sed -i 's/writePrecision .*/writePrecision 17;/' system/controlDict
    echo 'solution { coupled false; } subModels { particleForces { gravity; } }' >> "constant/${clouds}Properties"
}

# Two kinds of char that lie on the floor before gravity pulls them off: all that comes back has the mean of both, turn by turn
returned_composition() {
    local turn gravity start=0 end
    returning_cloud multiphase "$work/returned-composition" || return
    { header "GlobalIOList<reactingMultiphaseParcelInjectionData>" parcels
      echo "("
      awk 'BEGIN { srand(5); for (i = 0; i < 400; i++)
          printf "(%.6f %.6f %.6f) (1 0 -2) 1e-4 1000 1e-6 400 1000 %s (0.6 0.1 0.3) (1) %s\n", 0.005 + 0.04*rand(), 0.01 + 0.08*rand(), 0.003 + 0.02*rand(),
              i % 2 ? "(0.1 0.1 0.8)" : "(0.3 0 0.7)", i % 2 ? "(0.25 0.75)" : "(0.5 0.5)" }'
      echo ")"; } > constant/parcels
    echo 'constantProperties { T0 400; constantVolume false; } subModels { heatTransferModel none; phaseChangeModel none; devolatilisationModel none; injectionModels { model1
        { type reactingMultiphaseLookupTableInjection; inputFile "parcels"; massTotal 1e-6; duration 0.002; parcelsPerSecond 500.0001; randomise false; } } }' \
        >> constant/reactingCloud1Properties
    for turn in 0 1 2 3; do
        case "$turn" in 0) gravity=0 end=0.04 ;; 1) gravity=9.81 end=0.24 ;; 2) gravity=-9.81 end=0.44 ;; 3) gravity=9.81 end=0.64 ;; esac
        gravity_is "$gravity"
        settings "$end" 0.04 latestTime ascii
        if [ "$turn" != 2 ]; then solve returned "turn$turn" "$solver" || return
        else
            ranks_are 2
            quiet decompose decomposePar -latestTime
            solve returned "turn$turn" mpirun -np 2 "$solver" -parallel || return
            quiet together reconstructPar -newTimes
        fi
        goes_round "returned/composition$turn" "$start"
        [ "$turn" = 0 ] || of_both "returned/composition$turn" "$(awk -v t="$start" 'BEGIN { print t + 0.04 }')"
        start="$end"
    done
}

# Mean of both, of the parcel's mass: solid 0.75, carbon 0.275 (the first of the solid's two), methane 0.6 of a fifth
of_both() { # name time
    local d="$2/lagrangian/reactingCloud1" said
    said="$(paste <(values "$d/Ysolid") <(values "$d/YC(s)") <(values "$d/YCH4(g)") <(values "$d/mass0") <(values "$d/d") <(values "$d/rho") | awk '
        { n++; e = ($1 - 0.75)^2 + ($2 - 0.275)^2 + ($3 - 0.12)^2 + ($4/($6*3.141592653589793*$5^3/6) - 1)^2; if (e > worst) worst = e }
        END { printf "%d parcels, off by %.1e", n, sqrt(worst); exit !(n >= 2 && worst < 1e-18) }')" \
        && ok "$1/of-both ($said)" || bad "$1/of-both" "$said"
}

# Copper oxide comes back with the progress of its oxidation
returned_oxide() {
    local said
    returning_cloud heterogeneous "$work/returned-oxide" || return
    sed -i 's/Aeff 0.7;/Aeff 0.02;/' constant/reactingCloud1Properties
    settings 0.2 0.04 startTime ascii
    solve returned oxide "$solver" || return
    goes_round returned/oxide 0
    said="$(paste <(values 0.04/lagrangian/reactingCloud1/YFe3O4) <(values 0.04/lagrangian/reactingCloud1/F0) \
        | awk '$1 > 0 && $1 < 0.99 && $2 > 0 { n++ } END { print n + 0 }')"
    if [ "$said" -gt 10 ]; then ok "returned/oxide ($said parcels)"; else bad returned/oxide "$said parcels"; fi
}

# What cannot be done is refused with place and remedy
refused_return() {
    local said
    returning_box "$work/returned-refused" || return
    sed -i 's/stuck remove;//' constant/interaction
    if quiet keep "$solver"; then bad returned/refused-keep "the run went through"
    elif tr -s ' \n' ' ' < log.keep | grep -q "Key 'parcels' of memory, shed.*Write stuck remove;"
    then ok returned/refused-keep; else bad returned/refused-keep "$(grep -A4 FATAL log.keep | tr '\n' ' ')"; fi
    returning_box "$work/returned-resting" || return
    sed -i 's/stuck remove;//; s/shed { parcels yes; }//' constant/interaction
    settings 0.1 0.1 startTime ascii
    solve returned resting "$solver" || return
    sed -i 's/memory { /&shed { parcels yes; }/; 1i stuck remove;' constant/interaction
    settings 0.2 0.1 latestTime ascii
    if quiet rested "$solver"; then bad returned/refused-resting "the run went through"
    elif tr -s ' \n' ' ' < log.rested | grep -q "kg, rest on the walls.*Write stuck remove;"
    then ok returned/refused-resting; else bad returned/refused-resting "$(grep -A4 FATAL log.rested | tr '\n' ' ')"; fi
    build spray "$work/returned-spray" || return
    echo 'model "<constant>/nearWall.toml"; stuck remove; memory { shed { parcels yes; } } patches { outlet { type rebound; } }' > constant/interaction
    if quiet run "$solver"; then bad returned/refused-spray "the run went through"
    elif tr -s ' \n' ' ' < log.run | grep -q "drops of this cloud"
    then ok returned/refused-spray; else bad returned/refused-spray "$(grep -A4 FATAL log.run | tr '\n' ' ')"; fi
}
