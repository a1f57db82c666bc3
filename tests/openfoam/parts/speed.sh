# What the model costs beside OpenFOAM's localInteraction. Run by hand, not with "all": figures for openfoam/README.md.
#
#     tests/openfoam/run ratio     the slagging gasifier, runs of both models in turn (some 5 minutes)
#     tests/openfoam/run growth    time and memory over a hundredfold of faces and of parcels
#     tests/openfoam/run beside    a small cloud, three runs of both models in turn (a minute; part of benches/run)

# file command...: writes "user-seconds largest-resident-MB" of the command into the file
measured() {
    local to="$1"; shift
    python3 - "$to" "$@" > log.measured 2>&1 <<'PY'
import resource, subprocess, sys
code = subprocess.call(sys.argv[2:], stdin=subprocess.DEVNULL)
use = resource.getrusage(resource.RUSAGE_CHILDREN)
open(sys.argv[1], "w").write(f"{use.ru_utime:.3f} {use.ru_maxrss/1024:.1f}\n")
sys.exit(code)
PY
}

# The gasifier from 0.4 to 0.5 s, from one state, REPEATS times (5) in turn, with all MODELS; "together": memory, film, heat, and what
# falls from the walls comes back
case_ratio() {
    local base="$here/../../tutorials/slaggingGasifier" state="$work/ratio-state" how i case
    local models="${MODELS:-localInteraction dispersion nearWallNoMemory nearWall everything cooled together}"
    command -v python3 >/dev/null || { bad ratio "python3 is missing"; return; }
    mkdir -p "$state"; cp -r "$base/constant" "$base/system" "$state"; cp -r "$base/0.orig" "$state/0"
    # Parcels that rested would be in the deposit of `together` twice
    sed 's/^    stuck .*/    stuck remove;/' "$base/wallModels/nearWall" > "$state/constant/wallInteraction"
    cd "$state" || return
    sed -i 's/^endTime .*/endTime 0.4;/; s/^writeInterval .*/writeInterval 0.4;/' system/controlDict
    quiet blockMesh blockMesh
    solve ratio/state state coalChemistryFoam || return
    sed -i 's/^endTime .*/endTime 0.5;/; s/^writeInterval .*/writeInterval 0.1;/; s/^startFrom .*/startFrom latestTime;/' system/controlDict
    for i in $(seq "${REPEATS:-5}"); do
        for how in $models; do
            case="$work/ratio-$how"; rm -rf "$case"; cp -r "$state" "$case"; cd "$case" || return
            ratio_model "$how"
            measured spent coalChemistryFoam || { bad "ratio/$how" "the solver failed, see $case"; return; }
            cut -d' ' -f1 spent >> "$work/ratio-$how.times"
            [ "$how" != together ] || check_balance "ratio/together-$i" coalCloud1 0.4
            rm -rf "$case"
        done
    done
    cd "$work" || return
    for how in $models; do
        ok "ratio/$how ($(paste -d ' ' "ratio-$how.times" ratio-localInteraction.times \
            | awk '{ print $1/$2, $1, $2 }' | sort -g | awk '
                { ratio[NR] = $1; if (NR == 1 || $2 < own) own = $2; if (NR == 1 || $3 < other) other = $3 }
                END { printf "user time over localInteraction: median %.3f, from %.3f to %.3f; shortest %.1f s over %.1f s",
                      ratio[int((NR + 1)/2)], ratio[1], ratio[NR], own, other }'))"
    done
}

# The wall model of one of the runs, in its case
ratio_model() {
    local file=constant/wallInteraction from=nearWall
    case "$1" in localInteraction|nearWallNoMemory) from="$1" ;; dispersion) from=localInteraction ;; esac
    cp "$here/../../tutorials/slaggingGasifier/wallModels/$from" "$file"
    case "$1" in
        dispersion) sed -i 's/stochasticDispersionRAS/nearWallDispersion/' constant/coalCloud1Properties ;;
        everything) sed -i 's/^    stuck .*/    stuck react; record { maxRows 100000; }/' "$file" ;;
        cooled)     sed -i 's/film  *yes;/film yes; acceleration 5000;/' "$file" ;;
        together)   sed -i 's/film  *yes;/film yes; shed { parcels yes; }/; s/^    stuck .*/    stuck remove;/' "$file"
                    printf '\n[walls.%s.shedding]\ntensile_strength = 1e-3\nshear_strength = 1e-3\nspread = 1.5\n' \
                        slagWall default quenchWall >> constant/nearWall.toml ;;
    esac
    # Brick behind the slag: nearly the temperatures of the others
    case "$1" in cooled|together)
        quiet set foamDictionary -entry boundaryField.slagWall -set "{ type nearWallDepositTemperature; Ta 320; h 20;
            thicknessLayers (0.2); kappaLayers (2.5); qr qr; value uniform 1600; }" 0.4/T ;;
    esac
}

# faces-a-side parcels model: user time and memory of one run
grown() {
    local side="$1" parcels="$2" how="$3"
    build kinematic "$work/growth-$side-$parcels-$how" || return
    sed -i "s/(4 4 4)/($side $side 4)/" system/blockMeshDict
    quiet blockMesh blockMesh
    { header vectorField parcels; echo "("
      awk -v n="$parcels" 'BEGIN { srand(3); for (i = 0; i < n; i++) printf "(%.6f %.6f %.6f)\n", 0.002 + 0.09*rand(), 0.002 + 0.096*rand(), 0.0005 + 0.05*rand() }'
      echo ")"; } > constant/parcels
    # OpenFOAM drops parcels of less than one particle; these stay between floor and lid
    echo "subModels { injectionModels { model1 { massTotal $(awk -v n="$parcels" 'BEGIN { print 6e-10*n }'); U0 (0 0 -2); } } }" >> constant/kinematicCloudProperties
    [ "$how" != everything ] || sed -i '1i memory { }\nrecord { maxRows 100000; }' constant/interaction
    settings 1 1
    measured spent "$solver" || { bad "growth/$how" "the solver failed: $(tail -n 3 log.measured | tr '\n' ' ')"; return 1; }
}

case_growth() {
    local side parcels how row
    echo "# faces of the floor, parcels, model: user s, largest MB"
    for row in "4 1000" "40 1000" "4 10000" "4 100000" "40 100000"; do
        read -r side parcels <<< "$row"
        for how in plain everything; do
            grown "$side" "$parcels" "$how" || return
            ok "growth ($((side*side)) faces, $parcels parcels, $how: $(cat spent))"
        done
    done
}

# Whole runs of a kinematic cloud that bounces, once with localInteraction and once with nearWallInteraction, each reflecting with the same
# two constants; user times in turn, REPEATS of them (3). benches/run reads the lines "run".
case_beside() {
    local how i hits times
    for how in localInteraction nearWallInteraction; do
        bouncing_box "$work/beside-$how" 10000 || return
        sed -i '/^cloudFunctions/d' constant/kinematicCloudProperties
        sed -i '/^\[\[effects/,$d' constant/nearWall.toml
        printf 'model "<constant>/nearWall.toml";\npatches { ".*" { type interact; wall default; } }\n' > constant/interaction
        # mu 0.03 takes 3 % of the speed along the wall, as e_t 0.97
        [ "$how" != localInteraction ] || echo 'subModels { patchInteractionModel localInteraction; localInteractionCoeffs { patches
            ( floor { type rebound; e 0.93; mu 0.03; } lid { type rebound; e 0.93; mu 0.03; }
              sides { type rebound; e 0.93; mu 0.03; } outlet { type rebound; e 0.93; mu 0.03; } ); } }' >> constant/kinematicCloudProperties
        settings 1 1
    done
    for i in $(seq "${REPEATS:-3}"); do
        times=""
        for how in localInteraction nearWallInteraction; do
            cd "$work/beside-$how" || return
            rm -rf 1 postProcessing
            measured spent "$solver" || { bad "beside/$how" "the solver failed: $(tail -n 3 log.measured | tr '\n' ' ')"; return; }
            times="$times $(cut -d' ' -f1 spent)"
        done
        echo "run$times"
    done
    hits="$(last "$(folder kinematicCloud)/floor.dat" hits)"
    if [ "${hits:-0}" -gt 10000 ] 2>/dev/null
    then ok "beside ($hits impacts on the floor)"
    else bad beside "only ${hits:-no} impacts on the floor"
    fi
}
