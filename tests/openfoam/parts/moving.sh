# Cases of run: walls that move with the mesh, meshes that are refined, and
# walls beside a cyclic pair.
# shellcheck shell=bash disable=SC2154

# The whole mesh travels with (0.4 0 0.5) m/s
travelling() {  # folder
    build kinematic "$1" || return
    solver=uncoupledKinematicParcelDyMFoam
    cat > constant/dynamicMeshDict <<'END'
FoamFile { version 2.0; format ascii; class dictionary; object dynamicMeshDict; }
dynamicFvMesh       dynamicMotionSolverFvMesh;
motionSolverLibs    (fvMotionSolvers);
motionSolver        solidBody;
solidBodyMotionFunction linearMotion;
linearMotionCoeffs  { velocity (0.4 0 0.5); }
velocity            (0.4 0 0.5);
END
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
