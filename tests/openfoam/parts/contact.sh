# Cases of run: colliding clouds, whose parcels touch a wall with their surface.
# shellcheck shell=bash disable=SC2154

# A sphere of 10 mm falls with 2 m/s from 51 mm: its surface touches after 23 ms, and e_n = 0.5 throws it back with 1 m/s
case_surface() {
    local z n
    build colliding "$work/surface" || return
    one_parcel; settings 0.04 0.04 startTime ascii
    sed -i 's/deltaT .*/deltaT 0.0002;/' system/controlDict
    sed -i 's/writeInterval.*/writeInterval 200;/' system/settings
    sed -i 's/maxInteractionDistance .*/maxInteractionDistance 0.012;/' constant/kinematicCloudProperties
    echo 'subModels { injectionModels { model1 { massTotal 6e-4; sizeDistribution { fixedValueDistribution { value 0.01; } } } } }' >> constant/kinematicCloudProperties
    solve surface serial "$solver" || return
    z="$(positions_of 0.04/lagrangian/kinematicCloud | cut -d' ' -f3)"
    # By hand 0.005 + 1*(0.04 - 0.023) m; parcels start and touch within a step, 0.4 mm; with its centre it would touch later
    # and be at 0.0145 m
    if awk -v z="$z" 'BEGIN { exit !(z > 0.0213 && z < 0.0227) }'
    then ok "surface/rebound (at $z m, by hand 0.022 m)"; else bad surface/rebound "at '$z' m, by hand 0.022 m"; fi
    n="$(last "$(folder kinematicCloud)/floor.dat" hits)"
    if [ "$n" = 1 ]; then ok surface/once; else bad surface/once "$n hits"; fi
    check_balance surface/balance kinematicCloud 0

    # Captured there: in the deposit, out of the cloud
    rm -rf 0.04 postProcessing
    sed -i 's/floor .*/floor { type stick; }/' constant/interaction
    solve surface stick "$solver" || return
    z="$(positions_of 0.04/lagrangian/kinematicCloudDeposit | cut -d' ' -f3)"
    if awk -v z="${z:-9}" 'BEGIN { exit !(z > 0.0045 && z <= 0.005) }' && [ ! -e 0.04/lagrangian/kinematicCloud ]
    then ok "surface/captured (its centre at $z m)"; else bad surface/captured "its centre at '$z' m"; fi
    check_balance surface/balance-captured kinematicCloud 0

    sed -i 's/wallModel nearWall;/wallModel wallSpringSliderDashpot;/; s/nearWallCoeffs/wallSpringSliderDashpotCoeffs/' constant/kinematicCloudProperties
    cp constant/interaction constant/interaction.good
    refuse wall-spring '' "turn parcels back before" "wallModel nearWall;"
}

# Positions of all parcels of a cloud's folder, one line each
positions_of() {
    awk '/^\(?-?[0-9.e+-]+ / || /^\([^)]*\) / { gsub(/[()]/, ""); print $1, $2, $3 }' "$1/positions"
}

# Two spheres of 10 mm fall freely between plates 0.2 mm wider than they: one touches a plate all the way, the other was put
# 0.05 mm into it. No impact: e_t = 0.2 takes nothing from their speed g (1 - 1.2/1000) t, of
# which OpenFOAM counts the first step twice. A third one lies on the floor and slides along it.
case_resting() {
    local v
    build colliding "$work/resting" || return
    { header vectorField parcels; echo "((0.005 0.051 0.051) (0.00495 0.075 0.051))"; } > constant/parcels
    { header vectorField slider; echo "((0.03 0.03 0.005))"; } > constant/slider
    settings 0.02 0.02 startTime ascii
    sed -i 's/(0 0 0)/(0 0 -9.81)/' constant/g
    sed -i 's/deltaT .*/deltaT 0.0001;/' system/controlDict
    sed -i 's/writeInterval.*/writeInterval 200;/' system/settings
    sed -i 's/maxInteractionDistance .*/maxInteractionDistance 0.012;/' constant/kinematicCloudProperties
    sed -i 's/e_t = .*/e_t = 0.2/' constant/nearWall.toml
    cat >> constant/kinematicCloudProperties <<'END2'
subModels
{
    particleForces { gravity; }
    injectionModels
    {
        model1 { massTotal 1.2e-3; U0 (1e-17 0 0); sizeDistribution { fixedValueDistribution { value 0.01; } } }
        model2
        {
            type manualInjection; massTotal 6e-4; parcelBasisType mass; SOI 0; positionsFile "slider"; U0 (0 0.5 0);
            sizeDistribution { type fixedValue; fixedValueDistribution { value 0.01; } }
        }
    }
}
END2
    echo 'model "<constant>/nearWall.toml"; patches { "(floor|lid|sides)" { type interact; } }' > constant/interaction
    solve resting serial "$solver" || return
    v="$(values 0.02/lagrangian/kinematicCloud/U | tr '\n' ' ')"
    if awk -v v="$v" 'BEGIN { split(v, u, " "); for (i = 1; i <= 9; i++) { want = i == 3 || i == 6 ? -0.19694 : i == 8 ? 0.5 : 0
        d = u[i] - want; if (d*d > 1e-10) bad = 1 } exit bad }'
    then ok "resting/momentum (velocities $v)"; else bad resting/momentum "velocities $v, by hand two of (0 0 -0.19694) and (0 0.5 0)"; fi
    v="$(last "$(folder kinematicCloud)/sides.dat" hits) $(last "$(folder kinematicCloud)/floor.dat" hits)"
    if [[ "$v" =~ ^(0|)\ (0|)$ ]] && [ "$(grep -c "parcels rest on walls or slide along them" log.serial)" = 1 ]
    then ok resting/no-impacts; else bad resting/no-impacts "hits on sides and floor: $v"; fi
}
