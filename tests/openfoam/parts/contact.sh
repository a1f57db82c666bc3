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
