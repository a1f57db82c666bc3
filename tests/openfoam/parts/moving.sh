# Cases of run: walls that move with the mesh, meshes that are refined, and
# walls beside a cyclic pair.
# shellcheck shell=bash disable=SC2154

# The whole mesh moves as one body; versions want the coefficients in a dictionary or without
solid_body() {  # motion coefficients
    solver=uncoupledKinematicParcelDyMFoam
    cat > constant/dynamicMeshDict <<END
FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh       dynamicMotionSolverFvMesh;
motionSolverLibs    (fvMotionSolvers);
motionSolver        solidBody;
solidBodyMotionFunction $1;
${1}Coeffs { $2 }
$2
END
}

# The whole mesh travels with (0.4 0 0.5) m/s
travelling() {  # folder
    build kinematic "$1" || return
    solid_body linearMotion "velocity (0.4 0 0.5);"
    sed -i 's/^    outlet/    floor { type movingWallVelocity; value uniform (0 0 0); }\n    outlet/' 0/U
    # At a restart OpenFOAM looks for the places of injection in the mesh again
    echo 'subModels { injectionModels { model1 { ignoreOutOfBounds true; } } }' >> constant/kinematicCloudProperties
    settings 0.2 0.1 startTime ascii
}

# origId x y z of a deposit, sorted for join
lying() {   # time
    local d="$1/lagrangian/kinematicCloudDeposit"
    paste -d' ' <(values "$d/origId" | sed 's/^/parcel-/') <(values "$d/positions" | cut -d' ' -f1-3) | sort
}

# OpenFOAM v2412 tells no model that the wall moves towards a parcel: both miss the 0.75 m/s
as_stock_travelling() {
    local ours
    ours="$(velocity 0.04)"
    echo 'subModels { patchInteractionModel localInteraction; localInteractionCoeffs { patches
        ( floor { type rebound; e 0.5; mu 0.25; } ".*" { type rebound; e 1; mu 0; } ); } }' >> constant/kinematicCloudProperties
    rm -rf 0.04
    solve travelling stock "$solver" || return
    if [ "$(velocity 0.04)" = "$ours" ]; then ok "travelling/rebound (as localInteraction, without the wall's normal speed)"
    else bad travelling/rebound "($ours), localInteraction ($(velocity 0.04))"; fi
}

# Towards the wall with 2 + 0.5, away with half of it: 0.5 + 1.25 = 1.75; along
# it 0.4 + 0.75 (1 - 0.4) = 0.85. What stays on the floor goes along with it.
case_travelling() {
    local difference
    travelling "$work/travelling" || return
    one_parcel; settings 0.04 0.04 startTime ascii
    solve travelling single "$solver" || return
    if [ "$(velocity 0.04 | awk '{ print ($3 - 1)^2 < 1e-20 }')" = 1 ] && [ "$NEARWALL_OPENFOAM" = full ]; then
        as_stock_travelling
    else
        expect_velocity travelling/rebound 0.04 0.85 0 1.75
    fi

    travelling "$work/travelling-deposit" || return
    sed -i 's/floor .*/floor { type stick; }/' constant/interaction
    solve travelling deposit "$solver" || return
    lying 0.1 > lying.before; lying 0.2 > lying.after
    if [ "$(wc -l < lying.before)" = 12 ] && join lying.before lying.after 2>/dev/null | awk '
            function far(a, b) { return (a - b)^2 > 1e-20 }
            far($4, 0.05) || far($7, 0.1) || far($5, $2 + 0.04) || far($6, $3) { bad = 1 } END { exit bad || NR != 12 }'
    then ok "travelling/deposit (12 parcels, on the floor wherever it is)"
    else bad travelling/deposit "$(join lying.before lying.after | head -n 2 | tr '\n' ';')"
    fi
    check_balance travelling/balance kinematicCloud 0

    cp lying.after lying.whole; rm -rf 0.2
    settings 0.2 0.1 latestTime ascii
    solve travelling restart "$solver" || return
    lying 0.2 > lying.again
    if difference="$(same_totals lying.whole lying.again 1e-12)" && [ -s lying.again ]
    then ok travelling/restart; else bad travelling/restart "$(head -n 1 <<< "$difference")"; fi
}

# Cells are cut in eight twice while parcels lie on the floor: they stay there,
# in the new cells
case_refined() {
    local n
    build kinematic "$work/refined" || return
    solver=uncoupledKinematicParcelDyMFoam
    cat > constant/dynamicMeshDict <<'END'
FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh   dynamicRefineFvMesh;
refineInterval  10;
field           T;
lowerRefineLevel 100;
upperRefineLevel 2000;
unrefineLevel   10000;
nBufferLayers   1;
maxRefinement   2;
maxCells        200000;
correctFluxes   ((phi none));
dumpLevel       true;
END
    sed -i 's/floor .*/floor { type stick; }/' constant/interaction
    settings 0.1 0.01 startTime ascii
    solve refined serial "$solver" || return
    lying 0.02 > lying.before; lying 0.1 > lying.after
    n="$(grep -c 'Refined from' log.serial)"
    if [ "$n" -ge 2 ] && [ -s lying.before ] && join lying.before lying.after | awk -v n="$(wc -l < lying.before)" '
            { for (i = 2; i <= 4; i++) if (($i - $(i + 3))^2 > 1e-18) bad = 1 } END { exit bad || NR != n }' \
        && [ "$(wc -l < lying.after)" = 12 ]
    then ok "refined/deposit ($n refinements, $(wc -l < lying.before) parcels before the last, 12 after)"
    else bad refined/deposit "$n refinements: $(join lying.before lying.after | head -n 2 | tr '\n' ';')"; fi
    check_balance refined/balance kinematicCloud 0
    if near "$(sum_of 0.1/lagrangian/kinematicCloudDeposit/mass)" \
        "$(last "$(folder kinematicCloud)/floor.dat" stick_mass_kg)" 1e-12
    then ok refined/mass; else bad refined/mass "$(sum_of 0.1/lagrangian/kinematicCloudDeposit/mass)"; fi

    # Memory goes along with a mesh that moves, and refuses one whose cells change
    sed -i '1i memory {}' constant/interaction; sed -i 's/floor .*/floor { type interact; }/' constant/interaction
    rm -rf 0.*
    quiet memory "$solver"
    if grep -q "cells or faces of the mesh have changed at time 0.02" log.memory && grep -q "Take a mesh that only moves" log.memory
    then ok refined/memory-refused; else bad refined/memory-refused "$(grep -A3 -m1 FATAL log.memory | tr '\n' ' ')"; fi
}

# Two sides of the case in this folder become a cyclic pair; parcels have (0.3 3 -2) m/s
cyclic_sides() {
    sed -i 's/sides  {.*/sides { type wall; faces ((0 4 7 3)); }\n    front { type cyclic; neighbourPatch back; faces ((0 1 5 4)); }\n    back { type cyclic; neighbourPatch front; faces ((3 7 6 2)); }/' system/blockMeshDict
    sed -i 's/^    outlet/    front { type cyclic; }\n    back { type cyclic; }\n    outlet/' 0/*
    echo 'subModels { injectionModels { model1 { U0 (0.3 3 -2); } } }' >> constant/kinematicCloudProperties
}

# Two sides are a cyclic pair; parcels with (0.3 3 -2) m/s go through it up to
# twice before they hit the floor. Faces by hand: t = z/2, x + 0.3 t, (y + 3 t) mod L
case_cyclic() {
    local difference f
    build kinematic "$work/cyclic" || return
    cyclic_sides
    sed -i 's/n (2 1 1)/n (1 2 1)/' system/decomposeParDict
    settings 0.06 0.06 startTime ascii
    quiet blockMesh blockMesh && quiet centres postProcess -func writeCellCentres -time 0
    rm -rf "$work/cyclic-ranks"; cp -r . "$work/cyclic-ranks"
    solve cyclic serial "$solver" || return
    expected_faces > hits.expected; floor_hits > hits.serial
    if [ "$(awk '{ s += $2 } END { print s }' hits.expected)" = 12 ] && cmp -s hits.expected hits.serial
    then ok "cyclic/faces (12 hits on $(awk '$2 > 0' hits.serial | wc -l) faces, as by hand)"
    else bad cyclic/faces "$(paste hits.expected hits.serial | tr '\n' ';')"
    fi
    totals kinematicCloud 0 > totals.serial
    check_balance cyclic/balance kinematicCloud 0
    cp hits.expected totals.serial "$work/cyclic-ranks"; cd "$work/cyclic-ranks" || return
    quiet decompose decomposePar
    solve cyclic ranks mpirun -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    floor_hits > hits.ranks; totals kinematicCloud 0 > totals.ranks
    if cmp -s hits.expected hits.ranks && difference="$(same_totals totals.serial totals.ranks 1e-12)"
    then ok "cyclic/ranks (the pair on two ranks)"
    else bad cyclic/ranks "$difference $(paste hits.expected hits.ranks | tr '\n' ';')"
    fi
    check_balance cyclic/balance-ranks kinematicCloud 0
}

# Which quarter of x and y: expected hits by hand, and the wall field's, both as
# "column,row count"
expected_faces() {
    tr -d '()' < constant/parcels | awk '
        function mod(a) { return a - 0.1*int(a/0.1) }
        NF == 3 { t = $3/2; n[int((($1 + 0.3*t)/0.025)) "," int(mod($2 + 3*t)/0.025)]++ }
        END { for (i = 0; i < 4; i++) for (j = 0; j < 4; j++) print i "," j, n[i "," j] + 0 }'
}

floor_hits() {
    paste -d' ' <(sed -n '/^    floor/,/}/p' 0/C | tr -d '()' | awk 'NF == 3 && $1 + 0 == $1') \
        <(face_values 0.06/kinematicCloud:hitCount | awk '$1 == "floor" { print $2 }') | awk '
        { n[int($1/0.025) "," int($2/0.025)] += $4 }
        END { for (i = 0; i < 4; i++) for (j = 0; j < 4; j++) print i "," j, n[i "," j] + 0 }'
}

# The whole mesh turns about an axis along y through its middle with 20 rad/s, and gravity pulls downwards. The floor holds 2 kg/m2
# of powder whose shear strength is half of its weight, times a scatter
turning_box() { # folder spread
    build kinematic "$1" || return
    solid_body rotatingMotion "origin (0.05 0.05 0.05); axis (0 1 0); omega 20;"
    sed -i 's/(0 0 0)/(0 0 -9.81)/' constant/g
    sed -i "s/^\[walls.floor\]/&\nshedding = { tensile_strength = 1e9, shear_strength = 9.81, spread = $2 }/" constant/nearWall.toml
    echo 'subModels { injectionModels { model1 { massTotal 0; ignoreOutOfBounds true; } } }' >> constant/kinematicCloudProperties
    echo 'model "<constant>/nearWall.toml"; memory { } patches { "lid|sides|outlet" { type rebound; } }' > constant/interaction
    powder_on floor 2 1e-3 5
    settings 0.06 0.02 startTime ascii
}

# patch powder layer cover: fields of the start
powder_on() {
    local f
    for f in "powderMass $2 1 -2" "layerThickness $3 0 1" "coverArea $4 0 0"; do
        # shellcheck disable=SC2086
        set -- "$1" $f
        { header volScalarField "kinematicCloud:$2"
          echo "dimensions [$4 $5 0 0 0 0 0]; internalField uniform 0; boundaryField { \".*\" { type calculated; value uniform 0; }"
          echo "$1 { type calculated; value uniform $3; } }"
        } > "0/kinematicCloud:$2"
    done
}

# A slope of 30 degrees is reached after 0.02618 s: the step that ends at 0.028 s sheds 2 kg/m2 of 0.01 m2. Where the strength scatters
# each place keeps its own, over a restart from a mesh that has turned and on two ranks.
case_turning() {
    local f
    turning_box "$work/turning" 1 || return
    solve turning one "$solver" || return
    f="$(folder kinematicCloud)/floor.wall.dat"
    expect_numbers turning/sheds "$(awk '$1 == "#" { for (i = 2; i <= NF; i++) at[$i] = i - 1; next }
        $1 > 0.025 && $1 < 0.029 { printf "%s %s ", $at["shed_kg"], $at["powder_kg"] }' "$f")" "0 0.02 0.02 0"
    check_memory_balance turning/balance "$f"

    turning_box "$work/memory-ranks" 1.6 || return
    solve turning scattered "$solver" || return
    totals_but_residual 0 > totals.serial; memory_values 0.06 > values.serial
    if awk -v a="$(awk '/powderMass-floor/ && $2 > 0' values.serial | wc -l)" 'BEGIN { exit !(a > 2 && a < 14) }'
    then ok "turning/scatter (powder left on $(awk '/powderMass-floor/ && $2 > 0' values.serial | wc -l) of 16 faces)"
    else bad turning/scatter "left on $(awk '/powderMass-floor/ && $2 > 0' values.serial | wc -l) of 16 faces"; fi
    rm -rf "$work/turning-again"; cp -r . "$work/turning-again"; cd "$work/turning-again" || return
    rm -rf 0.04 0.06 postProcessing; settings 0.06 0.02 latestTime ascii
    solve turning again "$solver" || return
    memory_compare turning/restart 0.02 0.06
    rm -rf "$work/turning-2"; cp -r "$work/memory-ranks" "$work/turning-2"; cd "$work/turning-2" || return
    rm -rf 0.0? postProcessing
    decompose_into 2 "(2 1 1)"
    solve turning ranks2 mpirun --oversubscribe -np 2 "$solver" -parallel || return
    quiet reconstruct reconstructPar -latestTime
    memory_compare turning/2-ranks 0 0.06
}

# While the mesh travels, four parcels of 2.5e-5 kg freeze in four steps on one face of 6.25e-4 m2: a layer of 3.2e-4 m, as in the
# case memory. Then a restart, and a fifth, solid one rebounds from it with e_n = 0.5 (0.25 + 0.75 exp(-3.2e-4/1.28e-4)).
case_travelling-memory() {
    local f want
    travelling "$work/travelling-memory" || return
    { header vectorField parcels
      echo "((0.0357 0.037 0.0075) (0.0333 0.037 0.0175) (0.0309 0.037 0.0275) (0.0285 0.037 0.0375) (0.0165 0.037 0.0875))"
    } > constant/parcels
    echo 'subModels { injectionModels { model1 { massTotal 1.25e-4; } } }' >> constant/kinematicCloudProperties
    freezing_powder
    settings 0.02 0.02 startTime ascii
    solve travelling-memory first "$solver" || return
    f="$(folder kinematicCloud)/floor.wall.dat"
    expect_numbers travelling-memory/by-hand "$(last "$f" powder_max_kg_m2) $(last "$f" layer_thickness_max_m) $(last "$f" arrived_kg)" "0.16 3.2e-4 1e-4"
    settings 0.05 0.05 latestTime ascii
    sed -i 's/particleTemperature 400/particleTemperature 293.15/' constant/interaction
    solve travelling-memory second "$solver" || return
    want="$(awk 'BEGIN { printf "%.15g", 0.5*(0.25 + 0.75*exp(-3.2e-4/1.28e-4)) }')"
    f="$(folder kinematicCloud 0.02)"
    expect_numbers travelling-memory/e_n "$(last "$f/floor.dat" rebounds) $(last "$f/floor.dat" e_n_sum) $(last "$f/floor.wall.dat" powder_max_kg_m2)" "1 $want 0.16"
    check_memory_balance travelling-memory/balance "$f/floor.wall.dat"
}

# The lid rises from 0.1 to 0.15 m while powder lies on the sides: the same 0.03 kg on 1.5 times the area
case_stretched() {
    local f
    build kinematic "$work/stretched" || return
    solver=uncoupledKinematicParcelDyMFoam
    cat > constant/dynamicMeshDict <<'END'
FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh       dynamicMotionSolverFvMesh;
motionSolverLibs    (fvMotionSolvers);
motionSolver        velocityComponentLaplacian;
velocityComponentLaplacianCoeffs { component z; diffusivity uniform; }
component           z;
diffusivity         uniform;
END
    { header pointScalarField pointMotionUz
      echo 'dimensions [0 1 -1 0 0 0 0]; internalField uniform 0; boundaryField { ".*" { type zeroGradient; }'
      echo 'floor { type fixedValue; value uniform 0; } lid { type fixedValue; value uniform 0.5; } }'
    } > 0/pointMotionUz
    echo 'solvers { cellMotionUz { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; } }' >> system/fvSolution
    echo 'subModels { injectionModels { model1 { massTotal 0; } } }' >> constant/kinematicCloudProperties
    echo 'model "<constant>/nearWall.toml"; memory { } patches { "lid|floor|outlet" { type rebound; } }' > constant/interaction
    powder_on sides 1 1e-3 5
    settings 0.1 0.1 startTime ascii
    solve stretched one "$solver" || return
    f="$(folder kinematicCloud)/sides.wall.dat"
    expect_numbers stretched "$(last "$f" initial_kg) $(last "$f" powder_kg)" "0.03 0.03"
    if near "$(last "$f" powder_mean_kg_m2)" 0.66666666666666667 1e-7 && near "$(last "$f" layer_thickness_max_m)" 6.6666666666666667e-4 1e-7
    then ok "stretched/thickness ($(last "$f" layer_thickness_max_m) m of 1e-3)"
    else bad stretched/thickness "$(last "$f" powder_mean_kg_m2) kg/m2, $(last "$f" layer_thickness_max_m) m"; fi
    check_memory_balance stretched/balance "$f"
}
