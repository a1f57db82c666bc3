# Cases of run: tutorials of OpenFOAM itself, which know nothing of nearwall.
#
# Each is copied from the user's OpenFOAM, coarsened and shortened until its parcels hit walls within seconds, and run with
# localInteraction and with nearWallInteraction of the same constants: in serial, from the middle again, and on two ranks.
# A row is a function case_stock-NAME: the tutorial, what is changed, its mesh, clouds, walls and steps, then stock_runs.
# shellcheck shell=bash disable=SC2154,SC2034

# The constants are sums of powers of two, so that 1 - 0.25 and 1 + 0.75 have no rounding
stock_rebound="type rebound; e 0.75; mu 0.25;"

# The folder of OpenFOAM's tutorials: of the sourced OpenFOAM, or of the source that prepareDebian unpacks
stock_folder() {
    local version
    if [ -n "${FOAM_TUTORIALS:-}" ]; then echo "$FOAM_TUTORIALS"; return; fi
    version="$(dpkg-query -W -f='${source:Version}' openfoam 2>/dev/null)"
    echo "${NEARWALL_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/nearwall}/openfoam-$version/tutorials"
}

# name path: the tutorial in a new folder, with what all rows start from
stock_case() {
    local from
    name="${kind:-stock}-$1"; dir="$work/$name" from="$(stock_folder)/lagrangian/$2"
    clouds="" walls="" others="" steady="" own=""
    [ -d "$from" ] || { bad "$name" "no tutorial $from; run openfoam/prepareDebian or set FOAM_TUTORIALS"; return 1; }
    rm -rf "$dir"; mkdir -p "$work"; cp -rL "$from" "$dir"; cd "$dir" || return
    [ ! -d 0.orig ] || { rm -rf 0; cp -r 0.orig 0; }
    solver="$(foamDictionary -entry application -value system/controlDict)"
    cp "$here/base/constant/nearWall.toml" constant/nearWall.toml
    sed -i 's/^e_n = .*/e_n = 0.75/; s/^e_t = .*/e_t = 0.75/' constant/nearWall.toml
    [ -e system/decomposeParDict ] || header dictionary decomposeParDict > system/decomposeParDict
    ranks_along x
}

# file sed-edit...: change a file of the tutorial; an edit that changes nothing is a fault of the row
edited() {
    local file="$1" edit; shift
    for edit; do
        cp "$file" before
        sed -i -E "$edit" "$file"
        ! cmp -s "$file" before || bad "$name/edit" "'$edit' changes nothing in $file"
    done
    rm -f before
}

# file n: every n-th parcel of a list of positions
thinned() {
    awk -v n="$2" '!/^ *\(-?[0-9]/ || ++k % n == 0' "$1" > thinner && mv thinner "$1"
}

# file text: entries that replace those of the tutorial or are merged with them
merged_in() { printf '%s\n' "$2" >> "$1"; }

# How two ranks share the mesh
ranks_along() {
    local n
    case "$1" in x) n="(2 1 1)" ;; y) n="(1 2 1)" ;; z) n="(1 1 2)" ;; esac
    merged_in system/decomposeParDict "numberOfSubdomains 2; method simple; coeffs { n $n; } simpleCoeffs { n $n; delta 0.001; }"
}

# time-step steps [start]: written in the middle and at the end
stock_time() {
    deltaT="$1" steps="$2"
    half="$(awk -v t="$1" -v n="$2" 'BEGIN { printf "%.10g", t*n/2 }')"
    end="$(awk -v t="$1" -v n="$2" 'BEGIN { printf "%.10g", t*n }')"
    merged_in system/controlDict "#remove functions
startFrom latestTime; startTime 0; stopAt endTime; endTime $end; deltaT $1; adjustTimeStep no;
writeControl timeStep; writeInterval $(($2/2)); purgeWrite 0; writeFormat ascii; writePrecision 17; writeCompression off;
timeFormat general; timePrecision 12; runTimeModifiable no; libs (\"libnearWallInteraction.so\");"
}

# command...: one step of meshing
meshed() { quiet "mesh.$1" "$@" || { bad "$name/mesh" "$* failed, see $dir/log.mesh.$1"; return 1; }; }

# The patch interaction of all clouds, and a stock cloud function that records all impacts:
#   local    localInteraction with the constants
#   near     the same from the nearwall model
#   own      the tutorial's own list of localInteraction, as it is
#   own-near the same list, read by nearWallInteraction
interaction_is() {
    local cloud file rules coeffs all="${walls// /|}"
    case "$1" in
        local) rules="\"($all)\" { $stock_rebound } $others" ;;
        near)  rules="\"($all)\" { type interact; wall default; } $others" ;;
    esac
    for cloud in $clouds; do
        file="constant/${cloud}Properties"
        [ -e "$file.stock" ] || cp "$file" "$file.stock"
        cp "$file.stock" "$file"
        case "$1" in
            local)    coeffs="patchInteractionModel localInteraction; localInteractionCoeffs { patches ( $rules ); }" ;;
            near)     coeffs="patchInteractionModel nearWallInteraction;
                        nearWallInteractionCoeffs { model \"<constant>/nearWall.toml\"; patches ( $rules ); }" ;;
            own-near) coeffs="patchInteractionModel nearWallInteraction;
                        nearWallInteractionCoeffs { model \"<constant>/nearWall.toml\"; patches \$:subModels.localInteractionCoeffs.patches; }" ;;
            own)      coeffs="" ;;
        esac
        merged_in "$file" "subModels { $coeffs }
cloudFunctions { hits { type \$NEARWALL_ARRIVALS; maxStoredParcels 10000000; patches ( $walls ); } }"
    done
}

# The impacts on the walls that OpenFOAM recorded, sorted; without the columns of the run
stock_impacts() { cat postProcessing/lagrangian/"$1"/hits/*/*.{post,dat} 2>/dev/null | grep -v '^#' | sort; }

# Hits in the tables of nearwall, over all walls
stock_hits() {
    local patch n sum=0
    for patch in $walls; do
        n="$(last "$(folder "$1" "$2")/$patch.dat" hits)"
        sum=$((sum + ${n:-0}))
    done
    echo "$sum"
}

# what first second time...: every file that the first run wrote at these times is the same in the second, byte by byte
same_files() {
    local what="$1" first="$2" second="$3" file n=0 t; shift 3
    for t; do
        while read -r file; do
            n=$((n + 1))
            cmp -s "$first/$t/$file" "$second/$t/$file" \
                || { bad "$name/$what" "$t/$file differs from that with localInteraction$(farthest "$first/$t/$file" "$second/$t/$file")"; return; }
        done < <(cd "$first/$t" && find . -type f ! -path './uniform/*' | sort)
    done
    if [ "$n" -gt 3 ]
    then ok "$name/$what ($n files to the last digit)"
    else bad "$name/$what" "only $n files to compare"
    fi
}

# Two files of numbers: the largest relative difference
farthest() {
    paste -d' ' <(tr -s '() ' '\n' < "$1") <(tr -s '() ' '\n' < "$2") 2>/dev/null | awk '
        NF == 2 && $1 + 0 == $1 && $2 + 0 == $2 {
            d = $1 - $2; if (d < 0) d = -d; m = $1 < 0 ? -$1 : $1; if (m > 0 && d/m > far) far = d/m }
        END { printf " (by up to %.2g)", far }'
}

# run [command]: the solver with localInteraction and with nearwall, each in a copy of the folder
stock_pair() {
    local run="$1" how; shift
    for how in local near; do
        rm -rf "$dir-$how-$run"; cp -r "$dir-start" "$dir-$how-$run"; cd "$dir-$how-$run" || return
        [ "$run" != restart ] || cp -r "$dir-$how-serial/$half" .
        interaction_is "$how"
        [ "$run" != ranks ] || quiet decompose decomposePar || { bad "$name/$run" "decomposePar failed, see $PWD/log.decompose"; return 1; }
        solve "$name/$run" "$how" "$@" || return
    done
}

# run start: hits as OpenFOAM counts them, and the mass; leaves the folder of nearwall's run
stock_hits_and_mass() {
    local run="$1" start="$2" cloud n seen
    cd "$dir-near-$run" || return
    for cloud in $clouds; do
        n="$(stock_hits "$cloud" "$start")"
        stock_impacts "$cloud" > impacts.near
        (cd "$dir-local-$run" && stock_impacts "$cloud") > impacts.local
        # A restart may come after the last impact
        if { [ -s impacts.local ] || [ "$run" = restart ]; } && cmp -s impacts.local impacts.near
        then ok "$name/$run/$cloud/impacts ($(wc -l < impacts.local) in place, time and velocity as with localInteraction)"
        else bad "$name/$run/$cloud/impacts" "$(wc -l < impacts.local) with localInteraction, $(wc -l < impacts.near) with nearwall, or others"; fi
        seen="$(wc -l < impacts.near)"
        if [ -n "$steady" ]; then       # a steady cloud counts its latest solve
            seen="$(awk -v t="$end" '$1 == t' impacts.near | wc -l)"
        elif [ "$run" = restart ]; then # and those before the restart
            seen=$((seen + $(awk -v t="$half" '$1 <= t*(1 + 1e-9)' "$dir-near-serial/impacts.$cloud" | wc -l)))
        fi
        cp impacts.near "impacts.$cloud"
        if [ "$n" -gt 0 ] && [ "$n" = "$seen" ]
        then ok "$name/$run/$cloud/hits ($n, as OpenFOAM counts)"
        else bad "$name/$run/$cloud/hits" "$n in the tables, OpenFOAM counts $seen"
        fi
        [ -n "$steady" ] || check_balance "$name/$run/$cloud/mass" "$cloud" "$start"
    done
}

# All runs of a row
stock_runs() {
    rm -rf "$dir-start"; cp -r "$dir" "$dir-start"
    stock_pair serial "$solver" || return
    same_files serial/results "$dir-local-serial" "$dir-near-serial" "$half" "$end"
    stock_hits_and_mass serial 0

    stock_pair restart "$solver" || return
    same_files restart/results "$dir-local-restart" "$dir-near-restart" "$end"
    stock_hits_and_mass restart "$half"

    stock_pair ranks mpirun -np 2 "$solver" -parallel || return
    same_files ranks/results "$dir-local-ranks" "$dir-near-ranks" "processor0/$end" "processor1/$end"
    stock_hits_and_mass ranks 0
}

# The tutorial's own list of patches: read by nearwall it gives what it gives with localInteraction
stock_own() {
    local how
    for how in own own-near; do
        rm -rf "$dir-$how"; cp -r "$dir-start" "$dir-$how"; cd "$dir-$how" || return
        interaction_is "$how"
        merged_in system/controlDict "endTime $half;"
        solve "$name/own-list" "$how" "$solver" || return
    done
    same_files own-list "$dir-own" "$dir-own-near" "$half"
}

# nearwall with the collisions of the tutorial, whose walls then act by nearWall: serial, restart, two ranks
stock_collisions() {
    local run start n
    for run in serial restart ranks; do
        rm -rf "$dir-hard-$run"; cp -r "$dir-start" "$dir-hard-$run"; cd "$dir-hard-$run" || return
        start=0; interaction_is near
        sed -i -E 's/collisionModel none;//; s/wallModel +[a-zA-Z]+;/wallModel nearWall; nearWallCoeffs { }/' \
            constant/kinematicCloudProperties
        case "$run" in
            serial)  solve "$name/collisions" near "$solver" || return ;;
            restart) start="$half"; cp -r "$dir-hard-serial/$half" .
                     solve "$name/collisions" near "$solver" || return ;;
            ranks)   quiet decompose decomposePar
                     solve "$name/collisions" near mpirun -np 2 "$solver" -parallel || return ;;
        esac
        n="$(stock_hits kinematicCloud "$start")"
        echo "$n" > hits
        if [ "$n" -gt 0 ]; then ok "$name/collisions/$run ($n hits)"; else bad "$name/collisions/$run" "no hits"; fi
        check_balance "$name/collisions/$run/mass" kinematicCloud "$start"
    done
}

#--- the tutorials ------------------------------------------------------------

# Coal and limestone that fall onto the bottom
case_stock-coal() {
    stock_case coal coalChemistryFoam/simplifiedSiwek || return
    edited constant/coalCloud1Positions 's/ 0\.[0-9]+ 0\.05\)/ 0.004 0.05)/'
    edited constant/limestonePositions 's/^\((\S+) \S+ /(\1 0.004 /'
    merged_in constant/limestoneCloud1Properties 'subModels { injectionModels { model1 { U0 (0 -10 0); } } }'
    clouds="coalCloud1 limestoneCloud1" walls="top bottom walls" others="symmetry { type rebound; }"
    stock_time 1e-4 20
    meshed blockMesh && meshed topoSet && stock_runs
}

# A nozzle close to the bottom of a coarse bomb
sprayed_on_the_bottom() {
    edited system/blockMeshDict 's/\(41 41 100\)/(8 8 20)/'
    merged_in constant/sprayCloudProperties 'subModels { injectionModels { model1 { position (0 0.006 0); parcelsPerSecond 2e6; } } }'
}

# Drops of n-heptane from a nozzle close to the bottom of the bomb
case_stock-spray() {
    stock_case spray sprayFoam/aachenBomb || return
    sprayed_on_the_bottom
    clouds=sprayCloud walls=walls
    stock_time 5e-6 40
    meshed blockMesh && stock_runs
}

# A blast onto the wall of a coarse cyclone
blown_at_a_cyclone() {
    mkdir -p constant/triSurface
    gzip -dc "$(stock_folder)/resources/geometry/cyclone.stl.gz" > constant/triSurface/cyclone.stl
    edited system/blockMeshDict 's/\(33 33 63\)/(13 13 25)/'
    edited system/snappyHexMeshDict 's/^snap +true;/snap false;/'
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { SOI 0; massTotal 4; parcelsPerSecond 30000; U0 (-60 0 0); } } }'
}

# A blast onto the wall opposite the inlet. The coarse mesh is not fitted to the surface: the gas would diverge in its cells.
case_stock-cyclone() {
    offers snappyHexMesh || return
    stock_case cyclone MPPICFoam/cyclone || return
    blown_at_a_cyclone
    clouds=kinematicCloud walls="walls inlet" others="outlet { type escape; }"
    stock_time 4e-4 60
    meshed blockMesh && meshed snappyHexMesh -overwrite && stock_runs && stock_own
}

# Steady: water drops into hot gas, now also sideways. Drag turns some around on the wall itself: for nearwall they do not hit
# it, localInteraction takes a part mu of their velocity along it. Without mu both must give the same.
case_stock-steady() {
    stock_case steady simpleReactingParcelFoam/verticalChannel || return
    edited system/blockMeshDict 's/\(([0-9]+) ([0-9]+) ([0-9]+)\)$/(\1 4 4)/; s/\((67|[0-9]{2,3}) 4 4\)/(20 4 4)/'
    merged_in constant/reactingCloud1Properties 'solution { calcFrequency 5; } subModels { injectionModels { model1 { U0 (15 40 5); } } }'
    stock_rebound="type rebound; e 0.75;"
    edited constant/nearWall.toml 's/^e_t = .*/e_t = 1/'
    clouds=reactingCloud1 walls=walls steady=yes
    others='"(inlet.*|outlet)" { type escape; } "(front|back)" { type rebound; }'
    stock_time 1 10
    meshed blockMesh && meshed potentialFoam && stock_runs
}

# The mesh of the rotor turns; parcels fly through the sliding interface, which has to be on one rank. They are soft: OpenFOAM
# rebuilds its lists of neighbours in each of the steps that a collision needs.
case_stock-mixer() {
    stock_case mixer icoUncoupledKinematicParcelDyMFoam/mixerVesselAMI2D || return
    edited system/blockMeshDict.m4 's/define\((Nr|NR|Na), 12\)/define(\1, 5)/'
    thinned constant/kinematicCloudPositions 6
    edited constant/dynamicMeshDict 's/omega +(-?)6\.2832/omega \162.832/'
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { U0 (3 1.5 0); } } }
constantProperties { youngsModulus 1e5; }'
    without_collisions
    merged_in system/decomposeParDict 'constraints { interface { type singleProcessorFaceSets; sets ((interface 0)); } }'
    { header dictionary topoSetDict; echo 'actions ( { name interface; type faceSet; action new; source patchToFace; patch "AMI.*"; } );'; } > system/topoSetDict
    clouds=kinematicCloud walls="rotor stator" others='"AMI.*" { type none; }'
    stock_time 1e-4 40
    m4 system/blockMeshDict.m4 > system/blockMeshDict
    meshed blockMesh && meshed topoSet && stock_runs && stock_collisions
}

# Colliding clouds: stock walls act by springs that nearwall refuses, so the comparison is without collisions, and stock_collisions
# runs nearwall with them
without_collisions() { merged_in constant/kinematicCloudProperties 'subModels { collisionModel none; }'; }

# A bed of spheres, some of which hit the bottom; its list of patches has a plane of symmetry
case_stock-bed() {
    stock_case bed DPMFoam/Goldschmidt || return
    edited system/blockMeshDict 's/^( *hex.*)\(2 30 90\)/\1(2 10 30)/'
    thinned constant/kinematicCloudPositions 20
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { U0 (1 2 -2); } } }'
    without_collisions
    clouds=kinematicCloud walls="top bottom walls frontAndBack"
    stock_time 1e-4 40
    ranks_along y
    meshed blockMesh && stock_runs && stock_own && stock_collisions
}

# Copper oxide that reacts with air, thrown downwards
case_stock-heterogeneous() {
    stock_case heterogeneous reactingHeterogenousParcelFoam/rectangularDuct || return
    edited system/blockMeshDict 's/\(100 40 10\)/(20 6 4)/'
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { U0 (3 -30 0); parcelsPerSecond 500; } } }'
    clouds=reactingCloud1 walls=walls others='"(inlet|outlet)" { type escape; }'
    stock_time 0.01 30
    meshed blockMesh && stock_runs
}

# Drops between the walls and the cyclic baffles of a filter, which its list makes walls for parcels. The gas rests: that of
# the unchanged tutorial diverges in its second step (Debian's v1912).
case_stock-filter() {
    offers createBaffles || return
    stock_case filter reactingParcelFoam/filter || return
    edited constant/parcelInjectionProperties 's/\(0\.1 +(0\.[0-9]+) 0\.0\) \(0\.5 +(-?)0\.[0-9]+ 0\.0\)/(1.4 \1 0.05) (20 \210 0)/'
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { SOI 0; parcelsPerSecond 2500; } } }'
    merged_in system/fvSolution 'PIMPLE { solvePrimaryRegion no; }'
    clouds=reactingCloud1 walls="walls cycLeft_half0 cycLeft_half1 cycRight_half0 cycRight_half1" others='"(inlet|outlet)" { type escape; }'
    stock_time 5e-4 40
    ranks_along y
    meshed blockMesh && meshed topoSet && meshed createBaffles -overwrite && stock_runs && stock_own
}

# Spheres in a narrow hopper between two walls
case_stock-hopper() {
    stock_case hopper icoUncoupledKinematicParcelFoam/hopper/hopperInitialState || return
    edited constant/kinematicCloudPositions '/^\(0\.[0-9]+ 0\.([2-9]|1[2-9])/d'
    merged_in constant/kinematicCloudProperties 'subModels { injectionModels { model1 { U0 (2 -6 2); } } }'
    without_collisions
    clouds=kinematicCloud walls="walls frontAndBack"
    stock_time 1e-4 60
    meshed blockMesh && stock_runs && stock_collisions
}

# Drops in a box between planes of symmetry
case_stock-box() {
    stock_case box reactingParcelFoam/parcelInBox || return
    merged_in constant/reactingCloud1Properties 'subModels { injectionModels { model1 { U0 (30 18 0); } } }'
    clouds=reactingCloud1 walls="inlet outlet walls" others='"(front|back)" { type rebound; }'
    stock_time 1e-3 40
    meshed blockMesh && stock_runs
}
