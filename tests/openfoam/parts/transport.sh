# Cases of run: what carries parcels to walls.
# shellcheck shell=bash disable=SC2154

# A channel between planes 2 cm apart whose pressure drop gives a friction velocity of 0.3 m/s, with cells down to y+ = 0.3 and
# kOmegaSST: y+ is 200 in the middle. "coarse": of 3 m/s, with 40 equal cells, kEpsilon and wall functions: y+ is 2000 there and 50
# in the first cell. Both other directions are one cell and cyclic. The steady flow, which the parcels do not change
channel() { # folder [coarse]
    local patch cyclic="" f class dimensions value wall shear=0.3 model=kOmegaSST
    local cells="80) simpleGrading (1 1 ((1 1 25) (1 1 0.04)))"
    build kinematic "$1" || return
    if [ "${2:-}" = coarse ]; then shear=3 model=kEpsilon cells="40) simpleGrading (1 1 1)"; fi
    for patch in inlet:outlet:"0 4 7 3" outlet:inlet:"1 2 6 5" left:right:"0 1 5 4" right:left:"3 7 6 2"; do
        IFS=: read -r patch f value <<< "$patch"
        cyclic+="$patch { type cyclic; neighbourPatch $f; faces (($value)); } "
    done
    with_header blockMeshDict "scale 1; vertices ((0 0 -0.01) (0.01 0 -0.01) (0.01 0.01 -0.01) (0 0.01 -0.01) (0 0 0.01) (0.01 0 0.01) (0.01 0.01 0.01) (0 0.01 0.01));
        blocks (hex (0 1 2 3 4 5 6 7) (1 1 $cells);
        boundary (floor { type wall; faces ((0 3 2 1)); } lid { type wall; faces ((4 5 6 7)); } $cyclic);"
    mv constant/blockMeshDict system
    quiet blockMesh blockMesh
    sed -i "s/^simulationType .*/simulationType RAS; RAS { RASModel $model; turbulence on; printCoeffs no; }/" constant/turbulenceProperties
    echo 'wallDist { method meshWave; }' >> system/fvSchemes
    echo 'SIMPLE { nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; residualControl { ".*" 1e-9; } }
        relaxationFactors { equations { ".*" 0.9; p 1; } fields { p 0.3; } }' >> system/fvSolution
    with_header fvOptions "drop { type vectorSemiImplicitSource; active yes; vectorSemiImplicitSourceCoeffs { selectionMode all;
        volumeMode specific; injectionRateSuSp { U (($(awk -v u="$shear" 'BEGIN { print u*u/0.01 }') 0 0) 0); } } }"
    rm -f 0/*
    channel_field U volVectorField "0 1 -1 0 0 0 0" "(15 0 0)" "type noSlip;"
    channel_field p volScalarField "0 2 -2 0 0 0 0" 0 "type zeroGradient;"
    if [ "$model" = kEpsilon ]; then
        channel_field k volScalarField "0 2 -2 0 0 0 0" 20 "type kqRWallFunction; value uniform 20;"
        channel_field epsilon volScalarField "0 2 -3 0 0 0 0" 1e4 "type epsilonWallFunction; value uniform 1e4;"
        channel_field nut volScalarField "0 2 -1 0 0 0 0" 1e-3 "type nutkWallFunction; value uniform 1e-3;"
    else
        channel_field k volScalarField "0 2 -2 0 0 0 0" 0.2 "type fixedValue; value uniform 1e-10;"
        channel_field omega volScalarField "0 0 -1 0 0 0 0" 500 "type omegaWallFunction; value uniform 500;"
        channel_field nut volScalarField "0 2 -1 0 0 0 0" 1e-5 "type nutLowReWallFunction; value uniform 0;"
    fi
    settings 2000 4 startTime ascii     # the interval is in steps
    sed -i 's/^deltaT .*/deltaT 1;/' system/controlDict
    quiet flow simpleFoam || { bad channel "simpleFoam failed: $(grep -m1 -A4 FATAL log.flow)"; return 1; }
    mv 2000/[Ukeon]* 0; rm -r 2000 constant/fvOptions
    # A density of 1.2 kg/m3, so that the viscosity is that of the flow
    channel_field p volScalarField "1 -1 -2 0 0 0 0" 1e5 "type zeroGradient;"
    channel_field T volScalarField "0 0 0 1 0 0 0" 289.6566 "type zeroGradient;"
    channel_field alphat volScalarField "1 -1 -1 0 0 0 0" 0 "type fixedValue; value uniform 0;"
    sed -i 's/^deltaT .*/deltaT 2e-4;/' system/controlDict
    [ "$model" = kOmegaSST ] || sed -i 's/^deltaT .*/deltaT 2e-6;/' system/controlDict
}

channel_field() { # name class dimensions value wall
    { header "$2" "$1"
      echo "dimensions [$3]; internalField uniform $4; boundaryField { \".*\" { type cyclic; } \"(floor|lid)\" { $5 } }"; } > "0/$1"
}

# Fills the channel evenly with parcels of a relaxation time over nu/u_tau2, without weight. The middle stays free, where ranks
# meet: OpenFOAM lets a parcel that crosses in the step of its injection lose the rest of it
fill_channel() { # count relaxation dispersion[@peak-height] wall-interaction
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
    dispersionModel ${3%@*};
    $([ "$3" = "${3%@*}" ] || echo "${3%@*}Coeffs { peakHeight ${3#*@}; }")
    patchInteractionModel standardWallInteraction;
    standardWallInteractionCoeffs { type $4; e 1; mu 0; }
}
END
}

# Deposition velocity over the friction velocity, from the parcels left at two times: the channel holds 0.01 m3 over each m2
deposition() { # log from to friction-velocity
    awk -v from="$2" -v to="$3" -v shear="$4" '
        /^Time = / { t = $3 }
        /Current number of parcels/ { n[t + 0] = $NF }
        END { a = n[from + 0]; b = n[to + 0]; printf("%.4f +- %.0f %%", b ? 0.01*log(a/b)/((to - from)*shear) : 9, a > b ? 100/sqrt(a - b) : 0) }' "$1"
}

fly_channel() { # name folder count relaxation dispersion wall-interaction end [channel]
    rm -rf "$2"; cp -r "${8:-$work/dispersion}" "$2"; cd "$2" || return
    fill_channel "$3" "$4" "$5" "$6"
    settings "$7" 0.02 startTime ascii
    sed -i 's/^writePrecision .*/writePrecision 17;/' system/controlDict
    solve "$1" run "$solver"
}

# Within a factor of two of 3.25e-4 tau+^2 (McCoy and Hanratty 1977) to 6e-4 tau+^2 up to 10 and of 0.1 to 0.17 above (Liu and
# Agarwal 1974); at 3 known to be low, but not on peaks of a quarter of the viscous length; at 1 only no more than twice
case_dispersion() {
    local row
    channel "$work/dispersion" || return
    channel "$work/dispersion-coarse" coarse || return
    for row in 3:1.5e-3:5.4e-3 5:8.1e-3:0.015 10:0.0325:0.06 30:0.1:0.17 100:0.1:0.17 1000:0.1:0.17 1:0:6e-4:coarse 10:0.0325:0.06:coarse 100:0.1:0.17:coarse; do
        IFS=: read -ra row <<< "$row"
        deposits "${row[@]}" nearWallDispersion || return
    done
    deposits 3 2.9e-3 5.4e-3 nearWallDispersion@1.25e-5 || return
    # For comparison
    for row in 30:0:9 100:0:9 1:0:9:coarse 10:0:9:coarse 100:0:9:coarse; do
        IFS=: read -ra row <<< "$row"
        deposits "${row[@]}" stochasticDispersionRAS || return
    done
    stays_mixed
    same_walks
}

# relaxation lowest highest [coarse] model: in the coarse channel times are 100 times shorter. Fine particles gather at the wall for a
# thousand viscous times first
deposits() {
    local model="${*: -1}" name="dispersion/$1" v from=0.03 end=0.12
    [ "$1" -ge 10 ] || { from=0.2; end=0.6; }
    if [ "$4" = coarse ]; then
        name="dispersion/coarse-$1"
        fly_channel "$name" "$work/dispersion-$model-coarse" 1000 "$1e-2" "$model" escape 4e-3 "$work/dispersion-coarse" || return
        v="$(deposition log.run 1e-3 4e-3 3)"
    else
        fly_channel "$name" "$work/dispersion-$model" 1000 "$1" "$model" escape "$end" || return
        v="$(deposition log.run "$from" "$end" 0.3)"
    fi
    if awk -v v="${v%% *}" -v low="$2" -v high="$3" 'BEGIN { exit !(v >= 0.5*low && v < 2*high) }'
    then ok "$name ($model: V+ $v)"; else bad "$name" "$model: V+ $v, measured $2 to $3"; fi
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

# A restart gives the same bits; two ranks, which meet in the middle of the channel, the same draws: places but for rounding,
# which turbulence doubles in some two milliseconds
same_walks() {
    local dir="$work/dispersion-walks"
    fly_channel dispersion/walks "$dir" 500 10 nearWallDispersion rebound 0.04 || return
    places 0.02 > "$work/places-2"; places 0.04 > "$work/places"
    rm -rf "$dir-restart"; mkdir "$dir-restart"; cp -r 0.02 constant system "$dir-restart"; cd "$dir-restart" || return
    settings 0.04 0.02 latestTime ascii
    solve dispersion restart "$solver" || return
    if [ -s "$work/places" ] && places 0.04 | cmp -s - "$work/places"
    then ok dispersion/restart; else bad dispersion/restart "$(places 0.04 | diff - "$work/places" | wc -l) lines differ"; fi
    rm -rf "$dir-ranks"; mkdir "$dir-ranks"; cp -r "$dir"/{0,constant,system} "$dir-ranks"; cd "$dir-ranks" || return
    sed -i 's/n (2 1 1);/n (1 1 2);/' system/decomposeParDict
    settings 0.02 0.02 startTime ascii
    quiet decompose decomposePar
    solve dispersion ranks mpirun -np 2 "$solver" -parallel || return
    quiet together reconstructPar -latestTime
    if diff <(rounded "$work/places-2") <(places 0.02 | rounded) > differing
    then ok "dispersion/ranks ($(wc -l < "$work/places-2") parcels)"; else bad dispersion/ranks "$(wc -l < differing) lines differ"; fi
}

rounded() { awk '{ printf "%.9f %.9f %.9f\n", $1, $2, $3 }' "$@" | sort; }

# A parcel at rest in gas between walls of 300 and 400 K, 0.1 m apart, reaches the speed at which Stokes's drag holds thermophoresis,
# here by Talbot's formula in awk. The conductivity of the gas is mu Cp/Pr
case_thermophoresis() {
    local d v want
    build kinematic "$work/thermophoresis" || return
    { header vectorField parcels; echo "((0.0375 0.0375 0.0625))"; } > constant/parcels
    { header volScalarField T
      echo "dimensions [0 0 0 1 0 0 0]; internalField nonuniform List<scalar> 64("
      awk 'BEGIN { for (z = 0; z < 4; z++) for (i = 0; i < 16; i++) print 312.5 + 25*z }'
      echo '); boundaryField { ".*" { type zeroGradient; } floor { type fixedValue; value uniform 300; } lid { type fixedValue; value uniform 400; } }'
    } > 0/T
    for d in 1e-7 1e-6 1e-5; do
        cat > constant/more <<END
subModels { particleForces { sphereDrag; nearWallThermophoresis { conductivity 0.5; } }
    injectionModels { model1 { massTotal 1; U0 (0 0 0); sizeDistribution { fixedValueDistribution { value $d; } } } } }
solution { integrationSchemes { U analytical; } }
END
        [ "$d" != 1e-7 ] || echo '#include "more"' >> constant/kinematicCloudProperties
        settings 0.04 0.04 startTime ascii
        solve thermophoresis run "$solver" || return
        v="$(velocity 0.04)"
        want="$(awk -v d="$d" 'BEGIN {
            pi = atan2(0, -1); mu = 1.8e-5; rho = 1e5*28.9/(8314.47*362.5); K = mu*1007/0.7/0.5; Kn = 2*mu*sqrt(pi/(2*rho*1e5))/d
            C = 6*pi*1.17*(K + 2.18*Kn)/((1 + 3.42*Kn)*(1 + 2*K + 4.36*Kn)); printf "%.9g", -C*mu/(3*pi*rho)*1000/362.5 }')"
        if near "${v##* }" "$want" 1e-3
        then ok "thermophoresis/$d (${v##* } m/s, by hand $want)"; else bad "thermophoresis/$d" "velocity $v, by hand 0 0 $want"; fi
    done
}

# Every cloud has both models, and its parcels walk in turbulent gas. The gas of the colliding and the MPPIC cloud has no
# temperature; that of the MPPIC cloud is laminar here, so that nothing walks
case_dispersed() {
    local kind c walking force
    for kind in $clouds_all; do
        unset thermoClass mixtureClass gasT prgh
        build "$kind" "$work/dispersed-$kind" || return
        [ "$kind" = mppic ] || turbulent_wall 0
        force="nearWallThermophoresis { conductivity 0.5; }"
        case "$kind" in colliding|mppic) force="" ;; esac
        for c in $clouds; do
            echo "subModels { dispersionModel nearWallDispersion; particleForces { sphereDrag; $force } }" >> "constant/${c}Properties"
        done
        settings 0.01 0.01 startTime ascii
        solve "dispersed/$kind" run "$solver" || continue
        for c in $clouds; do
            walking="$(values "0.01/lagrangian/$c/tTurb" | awk -v mppic="$([ "$kind" != mppic ] || echo 1)" '
                { n++; w += mppic ? ($1 == 0) : ($1 > 4.5e15) } END { print((n && n == w) ? n : "only " w + 0 " of " n + 0) }')"
            case "$walking" in only*) bad "dispersed/$kind/$c" "$walking parcels walk" ;; *) ok "dispersed/$kind/$c ($walking parcels)" ;; esac
        done
    done
}
