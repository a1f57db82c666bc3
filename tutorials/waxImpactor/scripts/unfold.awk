# Averages as impacts: a row of n impacts of which a share was captured becomes n rows that stuck or rebounded, which says
# the same and lets each count. What an average says of e_n and e_t stays one row.
#
#   awk -f unfold.awk measured/troiano.csv > impacts.csv

BEGIN { FS = OFS = "," }

/^#/ { next }

!header {
    for (i = 1; i <= NF; i++) at[$i] = i
    header = 1
    $at["capture_efficiency"] = "outcome"
    print
    next
}

{
    n = $at["n_impacts"]; share = $at["capture_efficiency"]
    $at["capture_efficiency"] = ""
    if ($at["e_n"] != "" || $at["e_t"] != "") print
    if (share == "") next
    $at["n_impacts"] = 1; $at["e_n"] = $at["e_t"] = ""
    stuck = int(n*share + 0.5)
    for (i = 1; i <= n; i++) { $at["capture_efficiency"] = i <= stuck ? "stick" : "rebound"; print }
}
