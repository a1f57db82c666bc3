# Cases of run: what carries parcels to walls.
# shellcheck shell=bash disable=SC2154

# A channel between planes 2 cm apart in which a pressure drop of 9 m/s2 gives a friction velocity of 0.3 m/s: y+ is 200 in the
# middle. Both other directions are one cell and cyclic. The steady flow of kOmegaSST, which the parcels do not change
channel() { # folder
    local f patch cyclic
    build kinematic "$1" || return
    for patch in inlet:outlet outlet:inlet left:right right:left; do
        cyclic+="${patch%:*} { type cyclic; neighbourPatch ${patch#*:}; faces ($(case "$patch" in
            inlet*) echo "(0 4 7 3)" ;; outlet*) echo "(1 2 6 5)" ;; left*) echo "(0 1 5 4)" ;; *) echo "(3 7 6 2)" ;; esac)); } "
    done
    { header dictionary blockMeshDict
      echo "scale 1; vertices ((0 0 -0.01) (0.01 0 -0.01) (0.01 0.01 -0.01) (0 0.01 -0.01) (0 0 0.01) (0.01 0 0.01) (0.01 0.01 0.01) (0 0.01 0.01));
        blocks (hex (0 1 2 3 4 5 6 7) (1 1 80) simpleGrading (1 1 ((1 1 25) (1 1 0.04))));
        boundary (floor { type wall; faces ((0 3 2 1)); } lid { type wall; faces ((4 5 6 7)); } $cyclic);"; } > system/blockMeshDict
    quiet blockMesh blockMesh
    sed -i 's/^simulationType .*/simulationType RAS; RAS { RASModel kOmegaSST; turbulence on; printCoeffs no; }/' constant/turbulenceProperties
    echo 'wallDist { method meshWave; }' >> system/fvSchemes
    echo 'SIMPLE { nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; residualControl { ".*" 1e-9; } }
        relaxationFactors { equations { ".*" 0.9; p 1; } fields { p 0.3; } }' >> system/fvSolution
    { header dictionary fvOptions
      echo 'drop { type vectorSemiImplicitSource; active yes; vectorSemiImplicitSourceCoeffs { selectionMode all;
        volumeMode specific; injectionRateSuSp { U ((9 0 0) 0); } } }'; } > constant/fvOptions
    rm -f 0/*
    # shellcheck disable=SC2016
    while read -r f class dimensions value wall; do
        { header "$class" "$f"
          echo "dimensions [$dimensions]; internalField uniform ${value//_/ }; boundaryField { \".*\" { type cyclic; } \"(floor|lid)\" { $wall } }"
        } > "0/$f"
    done <<'FIELDS'
U volVectorField 0_1_-1_0_0_0_0 (5_0_0) type noSlip;
p volScalarField 0_2_-2_0_0_0_0 0 type zeroGradient;
k volScalarField 0_2_-2_0_0_0_0 0.2 type fixedValue; value uniform 1e-10;
omega volScalarField 0_0_-1_0_0_0_0 500 type omegaWallFunction; value uniform 500;
nut volScalarField 0_2_-1_0_0_0_0 1e-5 type nutLowReWallFunction; value uniform 0;
FIELDS
    sed -i 's/\[\(.*\)\]/[\1]/; s/_/ /g' 0/*
    settings 2000 4 startTime ascii    # the interval is in steps
    sed -i 's/^deltaT .*/deltaT 1;/' system/controlDict
    quiet flow simpleFoam || { bad channel "simpleFoam failed: $(grep -m1 -A4 FATAL log.flow)"; return 1; }
    mv 2000/{U,k,omega,nut} 0
    rm -r 2000 constant/fvOptions
    # A density of 1.2 kg/m3, so that the viscosity is that of the flow
    sed 's/dimensions .*internal/dimensions [1 -1 -2 0 0 0 0]; internal/; s/uniform 0;/uniform 1e5;/' 0/p > p && mv p 0/p
    sed 's/dimensions .*internal/dimensions [0 0 0 1 0 0 0]; internal/; s/uniform 1e5;/uniform 289.6566;/' 0/p > 0/T
    sed 's/dimensions .*internal/dimensions [1 -1 -1 0 0 0 0]; internal/; s/uniform 1e5;/uniform 0;/; s/type zeroGradient;/type fixedValue; value uniform 0;/' 0/p > 0/alphat
    sed -i 's/^deltaT .*/deltaT 2e-4;/' system/controlDict
}

# Fills the channel evenly with parcels of a relaxation time over nu/u_tau2, without weight. The middle stays free, where ranks
# meet: OpenFOAM lets a parcel that crosses in the step of its injection lose the rest of it
fill_channel() { # count relaxation dispersion wall-interaction
    { header vectorField parcels; echo "("
      awk -v n="$1" 'BEGIN { srand(5); for (i = 0; i < n; i++) printf "(%.9f %.9f %.9f)\n", 0.01*rand(), 0.01*rand(), (i % 2 ? 1 : -1)*(0.0003 + 0.00969*rand()) }'
      echo ")"; } > constant/parcels
    cat >> constant/kinematicCloudProperties <<END
solution { interpolationSchemes { U cellPoint; } integrationSchemes { U analytical; } }
subModels
{
    particleForces { sphereDrag; }
    injectionModels { model1 { massTotal 1; U0 (4 0 0); sizeDistribution { fixedValueDistribution
        { value $(awk -v t="$2" 'BEGIN { printf "%.9g", sqrt(18*1.8e-5*t*1.5e-5/0.09/1000) }'); } } } }
    dispersionModel $3;
    patchInteractionModel standardWallInteraction;
    standardWallInteractionCoeffs { type $4; e 1; mu 0; }
}
END
}

# Deposition velocity over the friction velocity, from the parcels left at two times: the channel holds 0.01 m3 over each m2
deposition() { # log from to
    awk -v from="$2" -v to="$3" '
        /^Time = / { t = $3 }
        /Current number of parcels/ { n[t + 0] = $NF }
        END { a = n[from + 0]; b = n[to + 0]; printf("%.4f +- %.0f %%", b ? 0.01*log(a/b)/((to - from)*0.3) : 9, a > b ? 100/sqrt(a - b) : 0) }' "$1"
}

fly_channel() { # name folder count relaxation dispersion wall-interaction end
    rm -rf "$2"; cp -r "$work/dispersion" "$2"; cd "$2" || return
    fill_channel "$3" "$4" "$5" "$6"
    settings "$7" 0.02 startTime ascii
    sed -i 's/^writePrecision .*/writePrecision 17;/' system/controlDict
    solve "$1" run "$solver"
}

# Within a factor of two of 6e-4 tau+^2 up to 10 and of 0.1 to 0.17 above (Liu and Agarwal 1974)
case_dispersion() {
    local name relaxation low high model v
    channel "$work/dispersion" || return
    for relaxation in 10:0.06:0.06 30:0.1:0.17 100:0.1:0.17 1000:0.1:0.17; do
        IFS=: read -r relaxation low high <<< "$relaxation"
        for model in nearWallDispersion stochasticDispersionRAS; do
            name="dispersion/$relaxation"
            fly_channel "$name" "$work/dispersion-$model-$relaxation" 1000 "$relaxation" "$model" escape 0.12 || return
            v="$(deposition log.run 0.03 0.12)"
            if [ "$model" != nearWallDispersion ]; then echo "# $name: $model $v"
            elif awk -v v="${v% +*}" -v low="$low" -v high="$high" 'BEGIN { exit !(v > 0.5*low && v < 2*high) }'
            then ok "$name (V+ $v)"; else bad "$name" "V+ $v, measured $low to $high"; fi
        done
    done
    stays_mixed
    same_walks
}

# A tracer that fills the channel evenly keeps filling it: ten layers of equal height, after 6000 viscous times, within five
# standard errors; less in the two layers at the walls, which the starts up to 0.999 of the height leave
stays_mixed() {
    local model layers
    for model in nearWallDispersion stochasticDispersionRAS; do
        fly_channel dispersion/mixed "$work/dispersion-mixed-$model" 2000 0.02 "$model" rebound 0.5 || return
        layers="$(places 0.5 | awk '{ n[int(($3 + 0.01)/0.002)]++ } END { for (i = 0; i < 10; i++) printf "%d ", n[i] }')"
        if [ "$model" != nearWallDispersion ]; then echo "# dispersion/mixed: $model $layers"
        elif awk '{ for (i = 1; i <= 10; i++) if (($i - 200)^2 > 25*200) exit 1; exit NF != 10 }' <<< "$layers"
        then ok "dispersion/mixed ($layers)"; else bad dispersion/mixed "$layers"; fi
    done
}

# The places of the parcels at a time
places() {
    tr -d '()' < "$1/lagrangian/kinematicCloud/positions" | awk 'NF == 4 && $1 + 0 == $1 { print $1, $2, $3 }' | sort
}

# A restart gives the same bits; two ranks, which meet in the middle of the channel, the same places but for rounding
same_walks() {
    local dir="$work/dispersion-walks"
    fly_channel dispersion/walks "$dir" 500 10 nearWallDispersion rebound 0.04 || return
    places 0.04 > "$work/places"
    rm -rf "$dir-restart"; mkdir "$dir-restart"; cp -r 0.02 constant system "$dir-restart"; cd "$dir-restart" || return
    settings 0.04 0.02 latestTime ascii
    solve dispersion restart "$solver" || return
    if [ -s "$work/places" ] && places 0.04 | cmp -s - "$work/places"
    then ok dispersion/restart; else bad dispersion/restart "$(places 0.04 | diff - "$work/places" | wc -l) lines differ"; fi
    rm -rf "$dir-ranks"; mkdir "$dir-ranks"; cp -r "$dir"/{0,constant,system} "$dir-ranks"; cd "$dir-ranks" || return
    sed -i 's/n (2 1 1);/n (1 1 2);/' system/decomposeParDict
    quiet decompose decomposePar
    solve dispersion ranks mpirun -np 2 "$solver" -parallel || return
    quiet together reconstructPar -latestTime
    if diff <(rounded "$work/places") <(places 0.04 | rounded) > differing
    then ok "dispersion/ranks ($(wc -l < "$work/places") parcels)"; else bad dispersion/ranks "$(wc -l < differing) lines differ"; fi
}

rounded() { awk '{ printf "%.9f %.9f %.9f\n", $1, $2, $3 }' "$@" | sort; }
