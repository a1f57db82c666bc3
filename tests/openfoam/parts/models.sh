# Cases of run: which model decides, with which inputs; erosion; time near a wall.
# shellcheck shell=bash disable=SC2154

# The impact has the parcel's density: wax parcels of 2500 kg/m3 rebound as parcels of a
# material that has this density and is wax otherwise, and not as wax. Only where
# material and parcel differ, one line says so.
case_density() {
    local how found=""
    for how in material parcel wax; do
        build kinematic "$work/density-$how" || return
        [ "$how" = wax ] || echo 'constantProperties { rho0 2500; }' >> constant/kinematicCloudProperties
        sed -i 's/^\[normal\]/&\nyield_ratio = 0.7/; s/e_n = .*//; 0,/"constant"/ s/model = "constant"/model = "thornton-ning"/' constant/nearWall.toml
        cat >> constant/nearWall.toml <<END
[materials.twin]
density = $([ "$how" = material ] && echo 2500 || echo 1000)
youngs_modulus = 1e9
poisson_ratio = 0.4
yield_strength = 1e7
surface_energy = 0.03
END
        sed -i 's/"montan-wax"/"twin"/' constant/nearWall.toml
        solve density serial "$solver" || return
        found+="$(last "$(folder kinematicCloud)/floor.dat" e_n_sum) $(grep -c 'warning: parcels have a density' log.serial) "
    done
    # shellcheck disable=SC2086
    set -- $found
    if [ "$1" = "$3" ] && [ "$1" != "$5" ]
    then ok "density/decides (e_n_sum $1, of 1000 kg/m3 $5)"
    else bad density/decides "$found"
    fi
    if [ "$2 $4 $6" = "0 1 0" ] && grep -q "density of 2500 kg/m3, the material in the model 1000 kg/m3" \
        "$work/density-parcel/log.serial"
    then ok density/warning; else bad density/warning "warnings: $2 $4 $6"; fi
}

# Finnie's volume is that of OpenFOAM's particleErosion with the same constants, at
# impacts below and above the angle where his formula changes; Oka's by hand
case_erosion() {
    local f mine theirs depth
    build kinematic "$work/erosion" || return
    cat >> constant/kinematicCloudProperties <<'END'
subModels { injectionModels { model2 { $:subModels.injectionModels.model1; U0 (1 0.1 -0.45); massTotal 2e-6; } } }
cloudFunctions { finnie { type particleErosion; patches (floor); p 2e9; psi 1.5; K 3; } }
END
    printf '[erosion]\nlaw = "finnie"\nflow_stress = 2e9\ndepth_ratio = 1.5\nforce_ratio = 3\n' >> constant/nearWall.toml
    settings 0.2 0.1 startTime ascii
    solve erosion serial "$solver" || return
    f="$(folder kinematicCloud)/floor.dat"
    mine="$(last "$f" eroded_volume_m3)"
    theirs="$(floor_sum "$(find . -name kinematicCloudQ | sort | tail -n 1)")"
    depth="$(floor_sum 0.2/kinematicCloud:erodedDepth)"
    if near "$mine" "$theirs" 1e-10 && awk -v v="$mine" 'BEGIN { exit !(v > 0) }'
    then ok "erosion/particleErosion ($mine m3, OpenFOAM's $theirs, $(last "$f" hits) hits)"
    else bad erosion/particleErosion "$mine m3, OpenFOAM's particleErosion $theirs"; fi
    if near "$mine" "$(awk -v d="$depth" 'BEGIN { printf "%.17g", d*6.25e-4 }')" 1e-10
    then ok erosion/field; else bad erosion/field "depths of $depth m on faces of 6.25e-4 m2, volume $mine m3"; fi
    totals kinematicCloud 0 > totals.kinematicCloud
    restart_of erosion "$work/erosion"
    ranks_of erosion "$work/erosion"

    # 12 parcels of 1e-6/12 kg at sqrt(5) m/s and sin a = 2/sqrt(5) on 1.8 GPa
    build kinematic "$work/erosion-oka" || return
    printf '[erosion]\nlaw = "finnie"\nflow_stress = 1e9\n[walls.floor.erosion]\nlaw = "oka"\nhardness = 1.8e9\n' >> constant/nearWall.toml
    solve erosion-oka serial "$solver" || return
    expect_numbers erosion/oka "$(last "$(folder kinematicCloud)/floor.dat" eroded_volume_m3)" "$(awk 'BEGIN {
        h = 1.8; s = 2/sqrt(5)
        e = 65*h^-0.12*(sqrt(5)/104)^(2.3*h^0.038)*(1e-4/326e-6)^0.19
        printf "%.15g", 1e-15*e*s^(0.71*h^0.14)*(1 + h*(1 - s))^(2.4*h^-0.94) }')"
}

# The sum over the faces of the floor
floor_sum() {
    awk '$1 == "floor" { on = 1 } $1 == "}" { on = 0 }
        on && $1 == "(" { list = 1; next } $1 ~ /^\)/ { list = 0 } on && list { s += $1 }
        on && $1 == "value" && /[0-9]\(/ { sub(/.*\(/, ""); sub(/\).*/, ""); n = split($0, x, " "); for (i = 1; i <= n; i++) s += x[i] }
        END { printf "%.17g", s }' "$1"
}

# Two injectors, each with a model: 12 parcels of e_n 0.5, and 12 of 0.9 on walls with
# other names. One that hits in the step of its injection has no number yet.
two_injectors() { # folder
    build kinematic "$1" || return
    cat >> constant/kinematicCloudProperties <<'END'
subModels { injectionModels { model1 { injectorID 3; } minerals { $:subModels.injectionModels.model1; injectorID 5; massTotal 2e-6; } } }
END
    sed 's/e_n = .*/e_n = 0.9/; s/^\[walls.floor\]/[walls.other]/' constant/nearWall.toml > constant/minerals.toml
    sed -i '1i injectors { minerals { model "<constant>/minerals.toml"; } }' constant/interaction
}

case_injectors() {
    local f
    two_injectors "$work/injectors" || return
    solve injectors serial "$solver" || return
    f="$(folder kinematicCloud)/floor.dat"
    expect_numbers injectors/by-hand "$(last "$f" rebounds) $(last "$f" e_n_sum) $(last "$f" e_n2_sum) $(last "$f" hit_mass_kg)" "24 16.8 12.72 3e-6"
    if grep -q "model of injector minerals: $PWD/constant/minerals.toml" log.serial \
        && ! grep -q "without the number" log.serial
    then ok injectors/log; else bad injectors/log "the log does not name the model, or warns"; fi
    totals kinematicCloud 0 > totals.kinematicCloud
    restart_of injectors "$work/injectors"
    ranks_of injectors "$work/injectors"

    two_injectors "$work/injectors-bad" || return
    cp constant/interaction constant/interaction.good
    refuse injector-name  's/minerals {/mineral {/'      "no injector 'mineral'" "(model1 minerals)"
    refuse injector-word  's/{ minerals {.*/{ minerals yes; }/' "'minerals' must be a dictionary"
    refuse injector-key   's/{ model "<constant>/{ film yes; model "<constant>/' \
        "injector 'minerals': unknown key 'film'"
    refuse injector-wall  's/floor .*/floor { type interact; wall floor; }/' \
        "the model of injector 'minerals' has no wall 'floor'" "[walls.floor]"
    sed -i 's/injectorID 5/injectorID 3/' constant/kinematicCloudProperties
    refuse injector-number '' "parcels of 'minerals' cannot be told from" "injectorID 1;"

    two_injectors "$work/injectors-early" || return
    { header vectorField parcels; echo "((0.021 0.051 0.001))"; } > constant/parcels
    solve injectors-early serial "$solver" || return
    if grep -q "2 impacts of parcels without the number of an injector" log.serial
    then ok injectors/early; else bad injectors/early "$(grep -c 'without the number' log.serial) warnings"; fi
}

# One parcel of 1e-6 kg, (1 0 -2) from z = 0.051: in the cells of the floor (z < 0.025,
# 2.5e-4 m3) from 0.013 s to 0.0505 s, that is at the end of 19 steps of 0.002 s
case_near-wall() {
    local f
    build kinematic "$work/near-wall" || return
    one_parcel; settings 0.1 0.05 startTime ascii
    solve near-wall serial "$solver" || return
    f="$(folder kinematicCloud)/floor.nearWall.dat"
    expect_numbers near-wall/by-hand "$(last "$f" residence_s) $(last "$f" mean_mass_kg) $(last "$f" volume_m3) $(last "$f" concentration_kg_m3)" \
        "0.038 3.8e-7 2.5e-4 1.52e-3"
    cp "$f" whole
    rm -rf 0.1; settings 0.1 0.05 latestTime ascii
    solve near-wall again "$solver" || return
    expect_numbers near-wall/restart "$(tail -n 1 "$(folder kinematicCloud 0.05)/floor.nearWall.dat")" \
        "$(tail -n 1 whole)"
    rm -rf 0.05 0.1 postProcessing; settings 0.1 0.05 startTime ascii
    quiet decompose decomposePar
    solve near-wall ranks mpirun -np 2 "$solver" -parallel || return
    expect_numbers near-wall/ranks "$(tail -n 1 "$f")" "$(tail -n 1 whole)"
}

# Melt that a wall remembers brakes as the same film of the model file. By hand: 1e-4 m
# of 0.001 Pa s cost 9*0.001/(1000*1e-4) ln(1e-4/1e-6) m/s, once each way
case_film-effect() {
    local how found=""
    for how in memory file; do
        build kinematic "$work/film-effect-$how" || return
        cat > constant/nearWall.toml <<END
[particle]
material = "melt"
[walls.default]
material = "pyrex"
[walls.floor]
material = "pyrex"
$([ "$how" = memory ] || echo 'film_thickness = 1e-4')
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.75
[capture]
model = "viscosity"
law = "urbain"
reference_viscosity = 1e-7
[materials.melt]
density = 1000
youngs_modulus = 1e9
poisson_ratio = 0.4
yield_strength = 1e7
surface_energy = 0.03
viscosity = 1e8
[[effects]]
kind = "liquid-film"
viscosity = 0.001
asperity = 1e-6
END
        if [ "$how" = memory ]; then
            sed -i '1i memory { }' constant/interaction
            { header volScalarField kinematicCloud:moltenMass
              echo 'dimensions [1 -2 0 0 0 0 0]; internalField uniform 0;'
              echo 'boundaryField { floor { type calculated; value uniform 0.1; } ".*" { type calculated; value uniform 0; } }'
            } > 0/kinematicCloud:moltenMass
        fi
        solve film-effect serial "$solver" || return
        found+="$(last "$(folder kinematicCloud)/floor.dat" rebounds) $(last "$(folder kinematicCloud)/floor.dat" e_n_sum) "
    done
    expect_numbers film-effect "$found" "$(awk 'BEGIN { e = 12*(0.5 - 1.5*9*0.001*log(100)/0.1/2); printf "12 %.15g 12 %.15g", e, e }')"
}

# Inputs that the model declares: a number and a word for each patch, a field. By hand
# e_n = 0.5 + 0.2 humidity, e_t = 0.75, or 0.5 on glass, and all dirt captures.
damp_case() {   # folder
    build kinematic "$1" || return
    cat >> constant/nearWall.toml <<'TOML'
[inputs.humidity]
default = 0.4
[inputs.plate]
labels = ["steel", "glass"]
[inputs.dirt]
default = 0
[[effects]]
kind = "fitted-curve"
input = "humidity"
on = "e_n"
knots = [0, 1]
values = [0, 0.2]
[[effects]]
kind = "fitted-curve"
input = "plate"
on = "e_t"
knots = ["steel", "glass"]
values = [0, -0.25]
[[effects]]
kind = "fitted-curve"
input = "dirt"
on = "capture"
knots = [0, 1]
values = [0, 50]
TOML
    cat > constant/interaction <<'DICT'
model "<constant>/nearWall.toml";
record { }
extraInputs { plate steel; humidity 0.1; }
patches
{
    floor   { type interact; wallTemperature 300; extraInputs { humidity 0.9; plate glass; dirt field; } }
    lid     { type interact; wallTemperature 300; }
    sides   { type rebound; }
}
DICT
    # Dirt on half of the floor, where x is large
    field dirt volScalarField "0 0 0 0 0 0 0" 0 "type zeroGradient;" "type zeroGradient;"
    sed -i 's/^    outlet/    floor { type fixedValue; value nonuniform List<scalar> 16(0 0 1 1 0 0 1 1 0 0 1 1 0 0 1 1); }\n&/' 0/dirt
}

case_extra-inputs() {
    local said floor lid
    damp_case "$work/extra-inputs" || return
    solve extra-inputs serial "$solver" || return
    floor="$(folder kinematicCloud)/floor.dat"; lid="$(folder kinematicCloud)/lid.dat"
    said="$(last "$floor" sticks) $(last "$floor" rebounds) $(last "$lid" sticks) $(last "$lid" rebounds)"
    if awk -v s="$said" 'BEGIN { split(s, n, " "); exit !(n[1] > 0 && n[2] > 0 && n[3] == 0 && n[4] > 0) }'
    then ok "extra-inputs/capture (floor: $(last "$floor" sticks) on dirt, $(last "$floor" rebounds) rebound)"
    else bad extra-inputs/capture "sticks and rebounds on floor, then lid: $said"; fi
    for said in "floor $floor 0.68" "lid $lid 0.52"; do
        # shellcheck disable=SC2086
        set -- $said
        if near "$(last "$2" e_n_sum)" "$(awk -v n="$(last "$2" rebounds)" -v e="$3" 'BEGIN { printf "%.17g", n*e }')" 1e-12
        then ok "extra-inputs/by-hand-$1 (e_n $3)"
        else bad "extra-inputs/by-hand-$1" "e_n_sum $(last "$2" e_n_sum), e_n $3"
        fi
    done
    if grep -q "floor: interact.*humidity 0.9, plate glass, dirt from field" log.serial \
        && grep -q "lid: interact.*humidity 0.1, plate steel, dirt 0" log.serial
    then ok extra-inputs/log; else bad extra-inputs/log "$(grep 'interact' log.serial | tr '\n' ' ')"; fi

    # The command reads the record, with a column for each input, and says the same bits
    cp "$(folder kinematicCloud)/impacts.csv" .
    nearwall predict --model constant/nearWall.toml impacts.csv -o predicted.csv > log.predict 2>&1 \
        || { bad extra-inputs/predict "nearwall predict failed, see $PWD/log.predict"; return; }
    if said="$(awk -F, '
        /^#/ { next }
        $1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }
        { n++; stuck = $at["outcome"] == "stick"; captures += stuck; plates[$at["plate"]]++ }
        stuck != ($at["p_stick"] == 1) { bad++ }
        !stuck && ($at["e_n"] != $at["e_n_predicted"] || $at["e_t"] != $at["e_t_predicted"]) { bad++ }
        END { print n " impacts, " captures " captured, " bad + 0 " differ"; exit bad || !captures || !plates["glass"] || !plates["steel"] }' predicted.csv)"
    then ok "extra-inputs/predict ($said)"; else bad extra-inputs/predict "$said"; fi

    check_balance extra-inputs/balance kinematicCloud 0
    totals kinematicCloud 0 > totals.kinematicCloud
    restart_of extra-inputs "$work/extra-inputs"
    ranks_of extra-inputs "$work/extra-inputs"
    refused_inputs
}

refused_inputs() {
    damp_case "$work/extra-inputs-bad" || return
    cp constant/interaction constant/interaction.good
    refuse input-name     's/humidity 0.9/humidty 0.9/' \
        "no model declares the input 'humidty'" "humidity plate dirt" "[inputs.humidty]"
    refuse input-top-name 's/humidity 0.1/wind 0.1/'     "no model declares the input 'wind'"
    refuse input-missing  '/^extraInputs/d' \
        "has the input 'plate', which has no default" "extraInputs { plate steel; }"
    refuse input-word     's/plate glass/plate glas/' \
        "'plate' must be one of its words or 'field'" "did you mean \`glass\`? (known here: steel, glass)"
    refuse input-number   's/humidity 0.9/humidity damp/' \
        "'humidity' must be a number or 'field'" "\`damp\` is not a finite number"
    refuse input-two      's/humidity 0.9/humidity 0.9 1/' "'humidity' must be a number or 'field'"
    refuse input-field    's/humidity 0.9/humidity field/' "no field 'humidity' is registered or in" "volScalarField"
    refuse input-dict     's/^extraInputs.*/extraInputs 0.4;/' "'extraInputs' must be a dictionary" "humidity 0.4"
    refuse input-of-other-type 's/{ type rebound;/{ type rebound; extraInputs { humidity 1; }/' \
        "unknown key 'extraInputs'" "'sides', type rebound"
    sed -i 's/16(0 0 1 1/16(0 0 1 0.5/' 0/dirt; mv 0/dirt 0/plate; sed -i 's/dirt/plate/' 0/plate
    refuse input-places   's/plate glass; dirt field/plate field/' \
        "the field 'plate' has values that are not the place of one of its words"
}
