# Prints the rows of results/probe.csv for a run, one for each size. Input: the lines of reference.awk, then the list of
# arrivals at the tube (tube.post, since v2306 tube.dat).
#
#   -v rows=500     particles of each size on one tube radius
#   -v deposit=FILE diameters of the parcels on the tube at the end; missing when there are none
#   -v header=1     print the names of the columns
#
# impaction: particles that arrive (counted once each) over those released within one radius, known to half a particle.
# capture: particles on the tube at the end over the same number. Speeds, angle and temperature: means of first arrivals.

function size(x) { return sprintf("%.0f", x*1e6) }
function file() { if (FILENAME != shown) { shown = FILENAME; files++ } return files }

BEGIN {
    pi = 3.141592653589793; CONVFMT = "%.9g"
    if (header) {
        print "run,Stk,d_um,Stk_eff,Re_p,gas_T_K,arrived,impaction,impaction_reference,impaction_paper," \
            "stuck,capture,stuck_of_arrived,v_n_mean_m_s,angle_mean_deg,T_mean_K"
        exit
    }
    # An OpenFOAM list: one value per line between the brackets
    while ((getline line < deposit) > 0) {
        if (line ~ /^\(/) inside = 1; else if (line ~ /^\)/) inside = 0; else if (inside) stuck[size(line)]++
    }
}

file() == 1 { kinds++; name_of[kinds] = $1; stk[$1] = $2; eff[$1] = $3; re[$1] = $4; paths[$1] = $5; fit[$1] = $6; next }

/^#/ { next }

{
    gsub(/[()]/, "")        # time rank x y z origProc origId active nParticle d u v w rho T mass0
    if (($6, $7) in met) next
    met[$6, $7] = 1
    k = size($10); n[k]++
    r = sqrt($3*$3 + $4*$4)
    v_n = -($11*$3 + $12*$4)/r; v_t = ($11*$4 - $12*$3)/r
    speed[k] += v_n; angle[k] += atan2(v_n, v_t < 0 ? -v_t : v_t)*180/pi; hot[k] += $15
}

END {
    if (header) exit
    for (i = 1; i <= kinds; i++) {
        k = name_of[i]
        printf "%s,%s,%s,%s,%s,%s,%d,%.4f,%s,%s,%d,%.4f,", name, stk[k], k, eff[k], re[k], T, n[k], \
            n[k]/rows, paths[k], fit[k], stuck[k], stuck[k]/rows
        if (n[k]) printf "%.4f,%.3f,%.1f,%.1f\n", stuck[k]/n[k], speed[k]/n[k], angle[k]/n[k], hot[k]/n[k]
        else print "-,-,-,-"
    }
}
