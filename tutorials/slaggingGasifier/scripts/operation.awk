# One line of the table of operating points, from what a finished run wrote. Arguments: the lists active, origProcId and
# origId of the cloud at the end, then the arrivals at walls and at the outlet (of $NEARWALL_ARRIVALS). Variables: run, coal [kg]
# injected.
# A parcel that is at rest at the end was captured at its last arrival.
BEGIN { pi = atan2(0, -1); fixed_carbon = 0.504*coal }          # 0.6 char, 0.84 of it carbon: constant/coalCloud1Properties
function list_of(name) { return name ~ /active$/ ? "active" : name ~ /origProcId$/ ? "proc" : name ~ /origId$/ ? "id" : "" }
FNR == 1 { list = list_of(FILENAME); patch = FILENAME; sub(/.*\//, "", patch); sub(/\.(post|dat)$/, "", patch); inside = 0; n = 0 }
list != "" && /^\(/ { inside = 1; next }
list != "" && /^\)/ { inside = 0 }
list != "" { if (inside) of[list, n++] = $1; if (list == "id") parcels = n; next }
/^#/ { next }
!mapped { for (i = 0; i < parcels; i++) at_rest[of["proc", i] + 0, of["id", i]] = of["active", i] == "0"; mapped = 1 }
{
    while (match($0, /[0-9]+\{[^}]*\}/)) {                      # a list of equal values: 3{0} for 3(0 0 0)
        split(substr($0, RSTART, RLENGTH), equal, /[{}]/)
        full = equal[1] " "
        for (i = 0; i < equal[1]; i++) full = full equal[2] " "
        $0 = substr($0, 1, RSTART - 1) full substr($0, RSTART + RLENGTH)
    }
    gsub(/[()]/, " ")
    mass = $9*$14*pi/6*$10^3
    carbon = mass*$20*$28
}
patch == "outlet" { escaped += carbon; next }
patch ~ /[sS]lagWall$/ { arriving += mass; arrivals++ }
at_rest[$6, $7] && $1 >= last[$6, $7] { last[$6, $7] = $1; captured[$6, $7] = mass; caught[$6, $7] = carbon; on[$6, $7] = patch; z[$6, $7] = $5 }
END {
    for (parcel in captured) {
        if (on[parcel] !~ /[sS]lagWall$/) { elsewhere += captured[parcel]; continue }
        in_slag += captured[parcel]
        carbon_in_slag += caught[parcel]
        if (z[parcel] > -0.15) dome += captured[parcel]
    }
    printf "%s,%d,%.1f,%.2f,%.1f,%.2f,%.2f,%.2f\n", run, arrivals, (arriving ? 100*in_slag/arriving : 0), 100*in_slag/coal, \
        (in_slag ? 100*dome/in_slag : 0), 100*elsewhere/coal, 100*carbon_in_slag/fixed_carbon, 100*escaped/fixed_carbon
}
