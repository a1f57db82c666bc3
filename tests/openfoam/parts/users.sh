# Cases of run: OpenFOAM's own tutorials as a user changes them: a model of real materials, a memory, a cooled wall.
#
# Each runs in binary: in serial, from the middle again, on two ranks, and from their middle, put together, on four. All balances
# close to 1e-9, and the mass in the cloud is that which OpenFOAM prints. The tables are those of the serial run, where OpenFOAM
# itself draws no random numbers (its injectors, dispersion and stress models draw others after a restart and on other ranks).
# A row is a function case_user-NAME: the tutorial, what is changed (as in stock.sh), user_cloud for each cloud, then user_runs.
# shellcheck shell=bash disable=SC2154,SC2034

user_case() { # name path
    kind=user
    stock_case "$@" || return
    four="(2 2 1)" two="(2 1 1)" tolerance=1e-6 draws="" react="" returns=""
}

# cloud coefficients: the lines that a user puts in
user_cloud() {
    clouds+=" $1"
    merged_in "constant/$1Properties" "subModels { patchInteractionModel nearWallInteraction; nearWallInteractionCoeffs { $2 } }"
}

# time-step steps
user_time() {
    stock_time "$@"
    merged_in system/controlDict "writeFormat binary;"
}

# what command...: for the gas, and for the surface film where there is one
user_regions() {
    local what="$1" region; shift
    for region in "" wallFilmRegion; do
        [ -d "system/$region" ] || continue
        quiet "$what$region" "$@" ${region:+-region "$region"} || bad "$name/$what" "$* failed, see $PWD/log.$what$region"
    done
}

user_decompose() { # ranks split
    merged_in system/decomposeParDict "numberOfSubdomains $1; method simple; coeffs { n $2; } simpleCoeffs { n $2; delta 0.001; }"
    [ ! -d system/wallFilmRegion ] || cp system/decomposeParDict system/wallFilmRegion
    user_regions decompose decomposePar
}

# The mass in the cloud is that of OpenFOAM's log, which has six digits, and does not yet have what comes back in the step
as_openfoam() { # name log cloud folder
    local ours said
    [ -z "$returns" ] || return 0
    ours="$(awk -v a="$(last "$4/balance.dat" airborne_kg)" -v b="$(last "$4/balance.dat" stuck_in_cloud_kg)" -v react="$react" \
        'BEGIN { printf "%.9g", a + (react ? b : 0) }')"
    said="$(awk -v cloud="$3" -F= '$1 ~ /^Cloud: / { at = $1 == "Cloud: " cloud }
        at && /Current mass in system/ { m = $2 } END { print m + 0 }' "log.$2")"
    if near "$ours" "$said" 2e-5; then ok "$1 ($said kg)"; else bad "$1" "$ours kg, OpenFOAM says $said"; fi
}

# All balances of a run, and parcels hit something: they rebounded, or were held by a wall or a film
user_balances() { # run start
    local cloud f table held
    for cloud in $clouds; do
        f="$(folder "$cloud" "$2")"
        check_balance "$name/$1/$cloud/mass" "$cloud" "$2"
        as_openfoam "$name/$1/$cloud/in-cloud" "$1" "$cloud" "$f"
        for table in wall heat returned; do
            if compgen -G "$f/*.$table.dat" > /dev/null; then closes "$name/$1/$cloud/$table" "$f"/*."$table".dat; fi
        done
        held="$(awk '$1 == "#" { n = split($0, names); next }
            { for (i = 2; i <= n; i++) if (names[i] ~ /^(rebounds|sticks|to_film_kg|stuck_.*_kg)$/) sum[names[i]] += $(i - 1) }
            END { for (what in sum) if (sum[what] > 0) printf "%s ", what }' "$f"/*.dat)"
        if [ -n "$held" ]; then ok "$name/$1/$cloud/hit ($held)"; else bad "$name/$1/$cloud/hit" "nothing hit a wall"; fi
        totals "$cloud" "$2" > "totals.$cloud"
    done
}

user_run() { # name start command...
    local run="$1" start="$2" cloud difference; shift 2
    solve "$name/$run" "$run" "$@" || return
    user_balances "$run" "$start"
    [ "$run" != serial ] && [ -z "$draws" ] || return 0
    for cloud in $clouds; do
        if difference="$(same_totals "$dir-serial/totals.$cloud" "totals.$cloud" "$tolerance")"
        then ok "$name/$run/$cloud/totals"
        else bad "$name/$run/$cloud/totals" "$(wc -l <<< "$difference") differ: $(head -n 1 <<< "$difference")"; fi
    done
}

user_copy() { rm -rf "$dir-$1"; cp -r "$dir" "$dir-$1"; cd "$dir-$1" || return; }

user_runs() {
    user_copy serial && user_run serial 0 "$solver" || return
    user_copy restart && cp -r "$dir-serial/$half" . && user_run restart "$half" "$solver" || return
    user_copy ranks-2 && user_decompose 2 "$two" && user_run ranks-2 0 mpirun -np 2 "$solver" -parallel || return
    user_regions together reconstructPar -time "$half"
    user_copy ranks-4 && cp -r "$dir-ranks-2/$half" . && user_decompose 4 "$four" \
        && user_run ranks-4 "$half" mpirun -np 4 "$solver" -parallel
}

#--- the tutorials ------------------------------------------------------------

glass_on_steel='
[particle]
material = "pyrex"
[walls.default]
material = "stainless-steel"
[normal]
model = "thornton-ning"
yield_ratio = 1.6
[tangential]
model = "sliding-rolling"
friction = 0.2'

# It sticks where some of it is molten: half of it at 300 K
sticky='
[[effects]]
kind = "melting-transition"
temperature = 300
width = 5'

sand_on_steel="${glass_on_steel/pyrex/silica-sand}"

ash_on_steel='
[particle]
material = "fly-ash"
[walls.default]
material = "fly-ash"
[normal]
model = "thornton-ning"
yield_ratio = 1.6
[tangential]
model = "sliding-rolling"
friction = 0.3
[capture]
model = "viscosity"
law = "kalmanovitch-frank"
reference_viscosity = 1e4'

# Without the viscosity of its melt
dry_ash="${ash_on_steel%\[capture\]*}"

# All falls off that gravity can pull
falls='
[walls.default.shedding]
tensile_strength = 1e-6
shear_strength = 1e-6
spread = 1.5'

# The bed of glass beads: steel walls that remember
case_user-bed() {
    user_case bed MPPICFoam/Goldschmidt || return
    thinned constant/kinematicCloudPositions 10
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { U0 (0 2 -2); } } }'
    user_cloud kinematicCloud "model #{ $glass_on_steel $sticky #}; memory { } record { maxRows 1000; }
        patches { \"(top|bottom)\" { type interact; } }"
    two="(1 2 1)" four="(1 2 2)" draws=yes
    user_time 1e-3 20
    meshed blockMesh && user_runs
}

# A column whose top and bottom are steel
case_user-column() {
    user_case column MPPICFoam/column || return
    thinned constant/kinematicCloudPositions 4
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { U0 (0 0 -2); } } }'
    user_cloud kinematicCloud "model #{ $glass_on_steel #}; stuck remove; memory { interval 0.002; }"
    two="(1 1 2)" four="(1 1 4)" draws=yes
    user_time 5e-4 40
    meshed blockMesh && user_runs
}

# Sand in a cyclone, whose wind takes along what lies loosely
case_user-cyclone() {
    offers snappyHexMesh || return
    user_case cyclone MPPICFoam/cyclone || return
    blown_at_a_cyclone
    user_cloud kinematicCloud "model #{ $sand_on_steel
        [walls.default.resuspension]
        work_of_adhesion = 0.01 #}; stuck remove; memory { acceleration 10; shed { parcels yes; } } patches { inlet { type rebound; } }"
    draws=yes returns=yes
    user_time 4e-4 40
    meshed blockMesh && meshed snappyHexMesh -overwrite && user_runs
}

# Spheres that leave a hopper; their wall is decided by the model
case_user-hopper() {
    user_case hopper icoUncoupledKinematicParcelFoam/hopper/hopperEmptying || return
    cp "$(stock_folder)/lagrangian/icoUncoupledKinematicParcelFoam/hopper/hopperInitialState/constant/kinematicCloudPositions" constant
    edited constant/kinematicCloudPositions '/^\(0\.[0-9]+ 0\.([2-9]|1[2-9])/d'
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { type manualInjection; massTotal 0;
        parcelBasisType fixed; nParticle 1; SOI 0; positionsFile "kinematicCloudPositions"; U0 (0 -3 0);
        sizeDistribution { type fixedValue; fixedValueDistribution { value 0.006; } } } }
        pairCollisionCoeffs { wallModel nearWall; nearWallCoeffs { } } }'
    user_cloud kinematicCloud "model #{ $glass_on_steel #}; memory { }"
    two="(1 2 1)" four="(2 2 1)"
    user_time 1e-4 60
    meshed blockMesh && user_runs
}

# A mixer: the deposit on the rotor turns with it
case_user-mixer() {
    user_case mixer icoUncoupledKinematicParcelDyMFoam/mixerVesselAMI2D || return
    edited system/blockMeshDict.m4 's/define\((Nr|NR|Na), 12\)/define(\1, 5)/'
    thinned constant/kinematicCloudPositions 6
    edited constant/dynamicMeshDict 's/omega +(-?)6\.2832/omega \162.832/'
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { U0 (3 1.5 0); } } collisionModel none; }'
    merged_in system/decomposeParDict 'constraints { interface { type singleProcessorFaceSets; sets ((interface 0)); } }'
    { header dictionary topoSetDict; echo 'actions ( { name interface; type faceSet; action new; source patchToFace; patch "AMI.*"; } );'; } > system/topoSetDict
    user_cloud kinematicCloud "model #{ $dry_ash $sticky #}; particleTemperature 300; memory { acceleration 100; }
        patches { \"AMI.*\" { type none; } }"
    tolerance=1e-3      # OpenFOAM restarts the sliding interface to some 5e-4 of the velocity of parcels that cross it
    user_time 1e-4 40
    m4 system/blockMeshDict.m4 > system/blockMeshDict
    meshed blockMesh && meshed topoSet && user_runs
}

# Coal and limestone onto a cooled wall, whose deposit heats up and falls
case_user-coal() {
    user_case coal coalChemistryFoam/simplifiedSiwek || return
    edited constant/coalCloud1Positions 's/ 0\.[0-9]+ 0\.05\)/ 0.004 0.05)/'
    edited constant/limestonePositions 's/^\((\S+) \S+ /(\1 0.004 /'
    merged_in constant/limestoneCloud1Properties 'subModels { injectionModels { model1 { U0 (0 -10 0); } } }'
    merged_in 0/T 'boundaryField { bottom { type nearWallDepositTemperature; cloud limestoneCloud1; Ta 400; h 2000;
        thicknessLayers (0.005 0.002); kappaLayers (22 1.5); emissivity 0.8; surroundingsTemperature 1200; value uniform 450; } }'
    draws=yes returns=yes
    user_cloud coalCloud1 "model #{ $ash_on_steel $falls #}; stuck remove; memory { shed { parcels yes; } }
        patches { symmetry { type rebound; } }"
    user_cloud limestoneCloud1 "model #{ $dry_ash $sticky $falls #}; stuck remove; memory { acceleration 1000; shed { parcels yes; } }
        patches { symmetry { type rebound; } }"
    user_time 1e-4 20
    meshed blockMesh && meshed topoSet && user_runs
}

# Fuel that hits the wall of the bomb, stays and evaporates there
case_user-spray() {
    user_case spray sprayFoam/aachenBomb || return
    sprayed_on_the_bottom
    draws=yes react=yes
    user_cloud sprayCloud "model #{ $ash_on_steel #}; stuck react; patches { walls { type stick; } }"
    user_time 5e-6 40
    meshed blockMesh && user_runs
}

# Copper oxide that stays on the floor and goes on oxidising
case_user-oxide() {
    user_case oxide reactingHeterogenousParcelFoam/rectangularDuct || return
    edited system/blockMeshDict 's/\(100 40 10\)/(20 6 4)/'
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { U0 (3 -30 0); parcelsPerSecond 500; } } }'
    draws=yes react=yes
    user_cloud reactingCloud1 "model #{ $dry_ash $sticky #}; stuck react; memory { }"
    user_time 0.01 30
    meshed blockMesh && user_runs
}

# Drops onto a panel with a film of water that splash from it
case_user-panel() {
    user_case panel reactingParcelFoam/splashPanel || return
    edited constant/parcelInjectionProperties 's/0\.09\) \(0 0 -5\)/0.01) (0 0 -5)/'
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { SOI 0; parcelsPerSecond 5000; } } }
cloudFunctions { #remove particleCollector1
}'
    draws=yes
    user_cloud reactingCloud1 "model #{ $ash_on_steel #}; patches { sides { type escape; } }"
    user_time 1e-4 60
    meshed blockMesh && quiet regions topoSet -dict system/wallFilmRegion.topoSet && meshed extrudeToRegionMesh -overwrite \
        && quiet film topoSet -region wallFilmRegion -dict system/createWallFilmRegionPatches.topoSet \
        && meshed createPatch -region wallFilmRegion -overwrite && user_runs
}

# Drops onto a cylinder with a film, between dry walls
case_user-cylinder() {
    user_case cylinder reactingParcelFoam/cylinder || return
    edited system/blockMeshDict 's/\(([0-9]+) ([0-9]+) 11\)/(5 5 5)/'
    edited constant/parcelInjectionProperties 's/\(0 1\.95 +(\S+)\) \(0 -5 0\)/(0 0.55 \1) (0 -5 0)/'
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { parcelsPerSecond 5000; } } }'
    draws=yes
    user_cloud reactingCloud1 "model #{ $ash_on_steel #}; memory { }"
    user_time 1e-3 40
    meshed blockMesh && meshed topoSet && meshed extrudeToRegionMesh -overwrite && user_runs
}

# Four boxes that water cools, in a rain of drops that bounce from them and warm them while they touch
case_user-boxes() {
    offers subsetMesh || return
    user_case boxes reactingParcelFoam/hotBoxes || return
    edited system/blockMeshDict 's/\(80 80 120\)/(20 20 30)/'
    edited constant/surfaceFilmProperties 's/^surfaceFilmModel.*/surfaceFilmModel none;/'
    edited 0/alphat 's/alphatFilmWallFunction/compressible::alphatWallFunction/'
    rm -f 0/htcConv
    merged_in constant/reactingCloud1Properties 'constantProperties { T0 350; }
subModels { injectionModels { model1 { flowRateProfile constant 1; parcelsPerInjector 40000; Umag constant 20;
        positionAxis ( ((0.45 0.2 0.75) (0 0 -1)) ((0.55 0.5 0.75) (0 0 -1)) ); } }
    surfaceFilmModel none; heatTransferModel RanzMarshall; RanzMarshallCoeffs { BirdCorrection false; } }'
    user_cloud reactingCloud1 "model #{ $dry_ash
        [walls.wallFilm]
        material = \"fly-ash\"
        contact_heat = true #}; memory { }"
    two="(1 2 1)" draws=yes
    user_time 5e-4 40
    meshed blockMesh && meshed topoSet && meshed subsetMesh c0 -patch wallFilm -overwrite || return
    merged_in 0/T 'boundaryField { wallFilm { type nearWallDepositTemperature; Ta 300; h 2000; thicknessLayers (0.003); kappaLayers (22);
        value uniform 300; } }'
    user_runs
}

# Drops between the walls and cyclic baffles of a filter
case_user-filter() {
    offers createBaffles || return
    user_case filter reactingParcelFoam/filter || return
    edited constant/parcelInjectionProperties 's/\(0\.1 +(0\.[0-9]+) 0\.0\) \(0\.5 +(-?)0\.[0-9]+ 0\.0\)/(1.4 \1 0.05) (20 \210 0)/'
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { SOI 0; parcelsPerSecond 2500; } } }'
    merged_in system/fvSolution 'PIMPLE { solvePrimaryRegion no; }'
    user_cloud reactingCloud1 "model #{ $ash_on_steel #}; memory { }
        patches { \"cyc.*\" { type interact; } \"(inlet|outlet)\" { type escape; } }"
    two="(1 2 1)" draws=yes
    merged_in system/decomposeParDict 'constraints { baffles { type preservePatches; patches ("cyc.*"); } }'
    user_time 5e-4 40
    meshed blockMesh && meshed topoSet && meshed createBaffles -overwrite && user_runs
}
