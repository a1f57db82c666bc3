# What the plates caught, from a list of impacts (impacts.csv): the cells of a row of MEASURED.csv.
#
#   awk -F, -v injected=particles -v bins="0 0.02 0.06 0.2" -f deposit.awk impacts.csv
#
# Each share of the injected mass has the number of equal particles that are worth as much: (sum m)^2/(sum m^2).

BEGIN {
    bound = split(bins, edge, " ")
    while ((getline line < injected) > 0)
        if (split(line, word, /[() ]+/) > 8) { m = (word[8]*1e6)^3; total += m; squares += m*m }
}
/^#/ { next }
!header { header = 1; for (i = 1; i <= NF; i++) at[$i] = i; next }
$at["outcome"] == "stick" {
    m = ($at["d"]*1e6)^3
    if ($at["patch"] == "cover") cover += m
    else for (i = 1; i < bound; i++) if ($at["z"] >= edge[i] && $at["z"] < edge[i + 1]) bin[i] += m
}
END {
    n = total*total/squares
    for (i = 1; i < bound; i++) printf "%.6g,%.1f,", bin[i]/total, n
    printf "%.6g,%.1f\n", cover/total, n
}
