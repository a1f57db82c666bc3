# Cases of run: walls that remember what stays on them, and the film that runs
# down.
# shellcheck shell=bash disable=SC2154

# Parcels of 400 K stick to walls of 300 K and freeze to powder, which damps later rebounds
freezing_powder() {
    cat >> constant/nearWall.toml <<'END'
[[effects]]
kind = "melting-transition"
temperature = 350
width = 1
[[effects]]
kind = "powder-layer"
thickness = 0.128e-3
residual = 0.25
END
    sed -i '1i particleTemperature 400; memory {}' constant/interaction
    sed -i 's/type interact;/type interact; wallTemperature 300;/' constant/interaction
}

# Four parcels of 2.5e-5 kg freeze on one face of 6.25e-4 m2, in four steps. By hand:
# 0.16 kg/m2 of spheres of 1000 kg/m3 and 1e-4 m, so a layer of 3.2e-4 m with half
# voids and a projected area of 2.4. A fifth, solid one comes after a restart and
# rebounds from it with e_n = 0.5 (0.25 + 0.75 exp(-3.2e-4/1.28e-4))
case_memory() {
    local f t want
    build kinematic "$work/memory" || return
    {
        header vectorField parcels
        echo "((0.033 0.037 0.009) (0.028 0.037 0.019) (0.023 0.037 0.029) (0.018 0.037 0.039))"
    } > constant/parcels
    { header vectorField late; echo "((0.033 0.037 0.009))"; } > constant/late
    cat >> constant/kinematicCloudProperties <<'END'
subModels { injectionModels {
    model1 { massTotal 1e-4; }
    model2
    {
        type manualInjection; massTotal 1e-6; parcelBasisType mass; SOI 0.042; positionsFile "late"; U0 (1 0 -2);
        sizeDistribution { type fixedValue; fixedValueDistribution { value 1e-4; } }
    }
} }
END
    freezing_powder
    settings 0.04 0.04
    solve memory first "$solver" || return
    f="$(folder kinematicCloud)/floor.wall.dat"
    t="$(awk 'NR > 1 && $15 != before { before = $15; printf "%.9g ", $15 }' "$f")"
    expect_numbers memory/each-step "$t" "0.04 0.08 0.12 0.16"
    t="$(last "$f" powder_max_kg_m2) $(last "$f" layer_thickness_max_m) $(last "$f" coverage_max) $(last "$f" molten_kg)"
    t+=" $(last "$f" arrived_kg) $(last "$f" powder_kg) $(last "$f" wall_temperature_max_K)"
    expect_numbers memory/by-hand "$t" "0.16 3.2e-4 $(awk 'BEGIN { printf "%.15g", 1 - exp(-2.4) }') 0 1e-4 1e-4 300"

    settings 0.08 0.04 latestTime
    sed -i 's/particleTemperature 400/particleTemperature 293.15/' constant/interaction
    solve memory second "$solver" || return
    want="$(awk 'BEGIN { printf "%.15g", 0.5*(0.25 + 0.75*exp(-3.2e-4/1.28e-4)) }')"
    f="$(folder kinematicCloud 0.04)"
    expect_numbers memory/e_n "$(last "$f/floor.dat" rebounds) $(last "$f/floor.dat" e_n_sum)" "1 $want"
    expect_numbers memory/restart "$(last "$f/floor.wall.dat" initial_kg) $(last "$f/floor.wall.dat" arrived_kg) \
$(last "$f/floor.wall.dat" powder_max_kg_m2)" "0 1e-4 0.16"
    check_memory_balance memory/balance "$f/floor.wall.dat"

    # Where nothing stays, a wall that remembers changes no bit
    build kinematic "$work/memory-idle" || return
    sed -i 's/^\[walls.floor\]/&\ncoverage = 0.4/' constant/nearWall.toml
    solve memory without "$solver" || return
    mv postProcessing without; rm -rf 0.1 0.2
    sed -i '1i memory {}' constant/interaction
    solve memory with "$solver" || return
    expect_numbers memory/starts-with-the-file "$(last "$(folder kinematicCloud)/floor.wall.dat" coverage_mean)" 0.4
    rm "$(folder kinematicCloud)"/*.wall.dat
    if diff -rq without/nearWallInteraction postProcessing/nearWallInteraction > /dev/null
    then ok memory/idle; else bad memory/idle "the tables differ from those without memory"; fi
}

# Two lists of numbers, to 1e-9
expect_numbers() { # name found wanted
    if awk -v a="$2" -v b="$3" 'BEGIN {
        n = split(a, x); if (n != split(b, y)) exit 1
        for (i = 1; i <= n; i++) {
            d = x[i] - y[i]; if (d < 0) d = -d
            m = y[i] < 0 ? -y[i] : y[i]; if (d > 1e-9*m + 1e-15) exit 1
        } }'
    then ok "$1 ($2)"; else bad "$1" "found $2, by hand $3"; fi
}

# What arrived has drained or lies there, to 1e-12, in every row of every table
check_memory_balance() { # name table...
    local name="$1" most
    shift
    most="$(awk '
        $1 == "#" { for (i = 2; i <= NF; i++) at[$i] = i - 1; next }
        { r = $at["residual"]; if (r < 0) r = -r; if (r > m) m = r; rows++ }
        END { printf "%.3g", rows ? m : 9e9 }' "$@")"
    if awk -v m="$most" 'BEGIN { exit !(m <= 1e-12) }'
    then ok "$name (largest residual $most)"; else bad "$name" "largest residual $most"; fi
}

memory_fields="moltenMass frozenMass enclosedShare powderMass layerThickness coverArea coverage depositConversion wallTemperature"

# Every value on the walls of the fields of a time, field by field
memory_values() { # time
    local f
    for f in $memory_fields; do
        awk -v field="$f" '
            /^    [a-z]+$/ { patch = $1 }
            patch ~ /^(floor|lid|sides)$/ && $1 == "value" && $2 == "uniform" { sub(";", ""); print field "-" patch, $3 }
            patch ~ /^(floor|lid|sides)$/ && NF == 1 && $1 ~ /^[-0-9.e+]+$/ { print field "-" patch, $1 }' \
            "$1/kinematicCloud:$f"
    done
}

# Two such listings, number by number; a tolerance of the largest value of each field
same_values() { # first second tolerance
    awk -v tol="$3" '
        { n = split($1, part, "-"); m = $2 < 0 ? -$2 : $2; if (m > most[part[1]]) most[part[1]] = m }
        NR == FNR { a[FNR] = $2; name[FNR] = $1; rows = FNR; next }
        { b[FNR] = $2; if ($1 != name[FNR]) { print "line " FNR " is " $1; bad = 1 } }
        END {
            if (FNR != rows) { print rows " and " FNR " values"; exit 1 }
            for (i = 1; i <= rows; i++) {
                split(name[i], part, "-"); d = a[i] - b[i]; if (d < 0) d = -d
                if (d > tol*most[part[1]]) { print name[i] ": " a[i] " and " b[i]; bad = 1; break }
            }
            exit bad }' "$1" "$2"
}

# 400 parcels, of which some stick, melt on the floor and freeze elsewhere; the melt
# runs along the floor to the outlet
melting_box() { # folder
    build kinematic "$1" || return
    {
        header vectorField parcels
        echo "("
        awk 'BEGIN { srand(7); for (i = 0; i < 400; i++)
            printf "(%.6f %.6f %.6f)\n", 0.005 + 0.04*rand(), 0.055 + 0.04*rand(), 0.01 + 0.08*rand() }'
        echo ")"
    } > constant/parcels
    sed -i 's/(0 0 0)/(981 -300 0)/' constant/g
    printf 'subModels { injectionModels { model1 { massTotal 0.01; } } }\n' >> constant/kinematicCloudProperties
    sed -i 's/"montan-wax"/"fly-ash"/; s/e_t = .*/e_t = 0.2/; s/e_n = .*/e_n = 0.8/' constant/nearWall.toml
    cat >> constant/nearWall.toml <<'END'
[capture]
model = "viscosity"
law = "kalmanovitch-frank"
reference_viscosity = 1e3
[[effects]]
kind = "powder-layer"
thickness = 0.128e-3
residual = 0.25
END
    cat > constant/interaction <<'END'
model "<constant>/nearWall.toml";
particleTemperature 1400;
memory { voidage 0.4; film yes; }
patches
{
    floor   { type interact; wallTemperature 2100; }
    "(lid|sides)" { type interact; wallTemperature 1100; }
}
END
    settings 0.2 0.1 startTime ascii
}

# The same on one, two and four ranks and over a restart
case_memory-ranks() {
    local n f
    melting_box "$work/memory-ranks" || return
    solve memory-ranks serial "$solver" || return
    f="$(folder kinematicCloud)"
    if awk -v a="$(last "$f/floor.wall.dat" drained_kg)" -v b="$(last "$f/lid.wall.dat" powder_kg)" \
        -v c="$(last "$f/floor.wall.dat" molten_kg)" 'BEGIN { exit !(a > 0 && b > 0 && c > 0) }'
    then ok "memory-ranks/all-states (drained $(last "$f/floor.wall.dat" drained_kg) kg)"
    else bad memory-ranks/all-states "nothing drained, melted or froze"; fi
    check_memory_balance memory-ranks/balance "$f"/*.wall.dat
    if grep -lE -- '(^| )-0( |$)' "$f"/*.dat > minus; then bad memory-ranks/minus-zero "in $(head -n 1 minus)"; else ok memory-ranks/minus-zero; fi
    totals_but_residual 0 > totals.serial
    memory_values 0.2 > values.serial

    rm -rf "$work/memory-again"; cp -r "$work/memory-ranks" "$work/memory-again" && cd "$work/memory-again" || return
    rm -rf 0.2 postProcessing; settings 0.2 0.1 latestTime ascii
    solve memory-ranks again "$solver" || return
    memory_compare memory-ranks/restart 0.1

    # Taken apart in the middle, and put together in the end
    rm -rf 0.2 postProcessing
    decompose_into 2 "(2 1 1)"
    solve memory-ranks apart mpirun --oversubscribe -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    memory_compare memory-ranks/decomposed-restart 0.1

    for n in 2 4; do
        rm -rf "$work/memory-$n"; cp -r "$work/memory-ranks" "$work/memory-$n" && cd "$work/memory-$n" || return
        rm -rf 0.1 0.2 postProcessing
        decompose_into "$n" "(2 $((n/2)) 1)"
        solve memory-ranks "ranks$n" mpirun --oversubscribe -np "$n" "$solver" -parallel || return
        quiet reconstruct reconstructPar -latestTime
        memory_compare "memory-ranks/$n-ranks" 0
    done
}

# What melts where it stuck leaves the clouds and drains with the film, what freezes
# lies in the deposit cloud; no mass is lost or counted twice, over a restart neither
case_slide() {
    local f difference
    melting_box "$work/slide" || return
    sed -i '1i stuck slide;' constant/interaction
    solve slide serial "$solver" || return
    grep -q "molten ones join the film" log.serial && ok slide/log || bad slide/log "the log does not say what slide means"
    slide_sums slide 0
    totals_but_residual 0 > totals.whole

    rm -rf "$work/slide-again"; cp -r "$work/slide" "$work/slide-again" && cd "$work/slide-again" || return
    rm -rf 0.2 postProcessing; settings 0.2 0.1 latestTime ascii
    solve slide again "$solver" || return
    slide_sums slide/restart 0.1
    totals_but_residual 0.1 > totals.again
    if difference="$(same_totals totals.whole totals.again 1e-10)"
    then ok slide/restart/tables; else bad slide/restart/tables "$(head -n 1 <<< "$difference")"; fi
}

# From the files of the last time: what lies in the deposit cloud, and as slag on the
# faces of 0.025 x 0.025 m; from the tables: what is under way, left and drained
slide_sums() {  # name start
    local f w column said
    f="$(folder kinematicCloud "$2")"
    {
        for column in injected airborne escaped stuck_removed; do echo "$column $(last "$f/balance.dat" ${column}_kg)"; done
        for w in "$f"/*.wall.dat; do
            for column in arrived powder drained; do echo "$column $(last "$w" ${column}_kg)"; done
        done
        echo "deposit $(sum_of 0.2/lagrangian/kinematicCloudDeposit/mass)"
        # What flows onto a colder wall freezes there
        cat <(face_values 0.2/kinematicCloud:moltenMass) <(face_values 0.2/kinematicCloud:frozenMass) \
            | awk '{ s += $2 } END { printf "film %.17g\n", s*6.25e-4 }'
    } > sums
    if said="$(awk '
        function same(a, b, what) { if ((a - b)^2 > (1e-9*m["injected"])^2) { print what ": " a " and " b; bad = 1 } }
        { m[$1] += $2 }
        END {
            same(m["injected"], m["airborne"] + m["escaped"] + m["deposit"] + m["film"] + m["drained"], "in and where it is")
            same(m["film"] + m["drained"], m["stuck_removed"], "film and what slid")
            same(m["deposit"], m["powder"], "deposit cloud and powder on the faces")
            same(m["arrived"], m["stuck_removed"] + m["powder"], "arrived and what became of it")
            for (k in m) if (k != "airborne" && k != "escaped" && !(m[k] > 0)) { print k " is " m[k]; bad = 1 }
            if (!bad) printf "of %.4g kg %.4g lie, %.4g slid, of which %.4g drained", m["injected"], m["deposit"], m["stuck_removed"], m["drained"]
            exit bad }' sums)"
    then ok "$1 ($said)"; else bad "$1" "$(head -n 1 <<< "$said")"; fi
    check_balance "$1/balance" kinematicCloud "$2"
    check_memory_balance "$1/walls" "$f"/*.wall.dat
}

totals_but_residual() { totals kinematicCloud "$1" | awk '$1 ~ /wall$/ { $9 = 0; if ($5*$5 < 1e-30) $5 = 0 } { print }'; }

# The tables of the run that started at a time, and the fields at its end, against the serial ones
memory_compare() { # name start [end]
    local difference
    totals_but_residual "$2" > totals.here
    if difference="$(same_totals "$work/memory-ranks/totals.serial" totals.here 1e-10)"
    then ok "$1/tables"; else bad "$1/tables" "$(head -n 1 <<< "$difference")"; fi
    memory_values "${3:-0.2}" > values.here
    if difference="$(same_values "$work/memory-ranks/values.serial" values.here 1e-10)"
    then ok "$1/fields ($(wc -l < values.here) values)"; else bad "$1/fields" "$(head -n 1 <<< "$difference")"; fi
}

# A melt of 1000 kg/m3 and 0.1 Pa s arrives at 10 kg/m2/s all over a vertical wall of
# 0.1 m and runs down it; below, the floor remembers nothing. In the end a face lets out
# all that arrives above its lower edge, so its film is Nusselt's at that height,
# (3 mu m x/(rho^2 g))^(1/3): to 1e-5 of 1.2e-3 m on the thinnest face. Against the film at
# its middle a face is off by about h/(6 x).
case_film() {
    local n said coarse=""
    offers postProcess || return    # it writes the places of the faces
    for n in 4 8 16; do
        film_case "$n" "$work/film-$n" || return
        solve film serial "$solver" || return
        film_profile > profile
        said="$(awk -v n="$n" '
            { x = 0.1 - $1; top = (3*0.1*10/(1e6*9.81))^(1/3); low = top*(x + 0.05/n)^(1/3)
              a = $2 - low; if (a < 0) a = -a; if (a > edge) edge = a
              b = $2/(top*x^(1/3)) - 1; if (b < 0) b = -b; mean += b/(4*n) }
            END { printf "%.3g %.4g %d", edge, mean, NR }' profile)"
        # shellcheck disable=SC2086
        set -- $said
        if [ "$3" = $((4*n)) ] && awk -v a="$1" 'BEGIN { exit !(a <= 1.2e-8) }'
        then ok "film/$n-rows (at most $1 m from Nusselt's film at the lower edges)"
        else bad "film/$n-rows" "$1 m from Nusselt's film at the lower edges of $3 faces"; fi
        if [ -n "$coarse" ]; then
            if awk -v a="$2" -v b="$coarse" 'BEGIN { exit !(a < 0.65*b) }'
            then ok "film/mesh-$n (mean error at the middles $coarse, now $2)"
            else bad "film/mesh-$n" "the mean error at the middles fell from $coarse to $2 only"; fi
        fi
        coarse="$2"
        check_memory_balance "film/balance-$n" "$(folder kinematicCloud)"/*.wall.dat
    done
    # All that arrives in the last tenth of a second drains: 0.1 kg/s
    said="$(awk '$1 == "#" { for (i = 2; i <= NF; i++) at[$i] = i - 1; next }
        $1 >= 0.8999 && !first { first = $1; before = $at["drained_kg"] }
        { rate = first && $1 > first ? ($at["drained_kg"] - before)/($1 - first) : 0 }
        END { printf "%.9g", rate }' "$(folder kinematicCloud)/sides.wall.dat")"
    if near "$said" 0.1 1e-3; then ok "film/drains ($said kg/s)"; else bad film/drains "$said kg/s, arriving 0.1"; fi

    for n in 2 4; do
        film_case 16 "$work/film-ranks-$n" || return
        decompose_into "$n" "(1 $((n/2)) 2)"
        solve film "ranks$n" mpirun --oversubscribe -np "$n" "$solver" -parallel || return
        quiet reconstruct reconstructPar -latestTime
        film_profile > profile
        if said="$(paste profile "$work/film-16/profile" | awk '
            { d = $2/$4 - 1; if (d < 0) d = -d; if (d > m) m = d; if ($1 != $3) m = 9e9 }
            END { printf "%.3g", m; exit !(NR == 64 && m <= 1e-10) }')"
        then ok "film/$n-ranks (largest difference $said)"; else bad "film/$n-ranks" "the thickness differs by $said"; fi
        check_memory_balance "film/balance-$n-ranks" "$(folder kinematicCloud)"/*.wall.dat
    done
}

film_case() { # rows folder
    build kinematic "$2" || return
    sed -i "s/(4 4 4)/(4 4 $1)/" system/blockMeshDict
    quiet blockMesh blockMesh
    sed -i 's/(0 0 0)/(0 0 -9.81)/' constant/g
    sed -i 's/deltaT .*/deltaT 0.0002;/' system/controlDict
    printf 'application %s;\nendTime 1;\nwriteInterval 5000;\nstartFrom startTime;\nwriteFormat ascii;\n' "$solver" > system/settings
    {
        header "GlobalIOList<kinematicParcelInjectionData>" table
        awk -v n="$1" 'BEGIN {
            print "("
            for (j = 0; j < 4; j++) for (k = 0; k < n; k++)
                printf "(0.0031 %.8f %.8f) (-50 0 0) 1e-4 1000 %.12g\n", (j + 0.51)*0.025, (k + 0.51)*0.1/n, 0.1/(4*n)
            print ")" }'
    } > constant/table
    cat >> constant/kinematicCloudProperties <<'END'
subModels { injectionModels {
    #remove model1
    model1
    {
        type kinematicLookupTableInjection; inputFile "table"; massTotal 0.1; parcelBasisType mass;
        SOI 0; duration 1; parcelsPerSecond 5000.5; randomise no;
    }
} }
END
    cat > constant/nearWall.toml <<'END'
[particle]
material = "melt"
[walls.default]
material = "pyrex"
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.75
[capture]
model = "viscosity"
law = "urbain"
reference_viscosity = 10
[materials.melt]
density = 1000
youngs_modulus = 1e9
poisson_ratio = 0.4
yield_strength = 1e7
surface_energy = 0.03
viscosity = 0.1
END
    cat > constant/interaction <<'END'
model "<constant>/nearWall.toml";
stuck remove;
statisticsInterval 50;
memory { film yes; }
patches { "floor|lid" { type rebound; } }
END
}

# ranks pieces-in-x-y-z
decompose_into() {
    { header dictionary decomposeParDict
      echo "numberOfSubdomains $1; method simple; simpleCoeffs { n $2; delta 0.001; }"; } > system/decomposeParDict
    quiet decompose decomposePar
}

# Height and thickness [m] on each face of the wall x = 0 in the end, at the time 1 or another
film_profile() {
    local t="${1:-1}"
    quiet centres postProcess -func writeCellCentres -latestTime
    paste <(side_values "$t/Cx") <(side_values "$t/Cz") <(side_values "$t/kinematicCloud:moltenMass") \
        | awk '$1*$1 < 1e-20 { print $2, $3/1000 }'
}

side_values() {
    awk '$1 == "sides" { on = 1 } $1 == "}" { on = 0 }
        on && /^\($/ { list = 1; next } /^\)/ { list = 0 } on && list' "$1"
}

# Melt that lies on a wall in the beginning, a field in 0: the hot wall is sticky, the
# cold one is dry. Parcels are char at 1200 K, which alone never stick. The record has
# the melt, 1 kg/m2 of 2300 kg/m3, and from it the command predicts the same.
case_hot-wall() {
    local T found recorded=""
    for T in 1800 1200; do
        build kinematic "$work/hot-wall-$T" || return
        sed -i 's/"montan-wax"/"fly-ash"/; s/"pyrex"/"refractory"/' constant/nearWall.toml
        printf '[capture]\nmodel = "viscosity"\nlaw = "kalmanovitch-frank"\nreference_viscosity = 1000\n' >> constant/nearWall.toml
        sed -i "s/type interact;/type interact; wallTemperature $T;/; 1i particleTemperature 1200; memory {} record {}" constant/interaction
        { header volScalarField kinematicCloud:moltenMass
          echo 'dimensions [1 -2 0 0 0 0 0]; internalField uniform 0;'
          echo 'boundaryField { floor { type calculated; value uniform 1; } ".*" { type calculated; value uniform 0; } }'
        } > 0/kinematicCloud:moltenMass
        solve hot-wall serial "$solver" || return
        found+="$(last "$(folder kinematicCloud)/floor.dat" sticks) $(last "$(folder kinematicCloud)/floor.wall.dat" initial_kg) "
        check_memory_balance "hot-wall/balance-$T" "$(folder kinematicCloud)"/*.wall.dat
        nearwall predict --model constant/nearWall.toml "$(folder kinematicCloud)/impacts.csv" -o predicted.csv > log.predict 2>&1 \
            || { bad hot-wall/predict "nearwall predict failed, see $PWD/log.predict"; return; }
        recorded+="$(awk -F, '
            /^#/ { next }
            $1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }
            { h = $at["melt_thickness"]; if (!n++ || h < least) least = h; p += $at["p_stick"] > 0.99 }
            END { printf "%d %.12g %d ", n, least, p }' predicted.csv)"
    done
    expect_numbers hot-wall "$found" "12 0.01 0 0.01"
    expect_numbers hot-wall/record "$recorded" "12 $(awk 'BEGIN { printf "%.15g 12 12 %.15g", 1/2300, 1/2300 }') 0"
}

# Each fault stops the run before its first step, with its place and remedy
