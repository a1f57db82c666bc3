# Prints the row of results/dust.csv for a run from its list of impacts (impacts.csv of nearWallInteraction).
#
#   -v name=... -v grains=6000 -v from=set1     run, number of grains, source of the dust (scripts/dust.awk)
#   -v header=1                                 print the names of the columns
#
# Impacts on the target: in the runs of the paper's sets the first impact of each grain (the first 30 ms); with dust from
# the dropper all impacts from v_n = 0.57 m/s upwards, the lowest in the paper. bounces: impacts of a grain on any wall
# before capture.

BEGIN {
    CONVFMT = "%.9g"; pi = 3.141592653589793
    if (header) {
        print "run,set,grains,bounces,captured_by_target,captured_by_vessel,target_impacts,slower_target_impacts,v_n_least_m_s,v_n_mean_m_s," \
            "v_n_most_m_s,v_t_most_m_s,angle_mean_deg,captured,captured_standard_error,captured_paper," \
            "e_n_below_0.6,e_n_below_0.6_standard_error,e_n_below_0.6_paper,e_n_mean,e_t,e_t_standard_error,e_t_paper"
        exit
    }
    # Section 4: stuck/impacts, rebounds with e_n below 0.6/rebounds, mean e_t
    paper["set1"] = 62/230 " " 119/168 " 0.86"; paper["set2"] = 9/65 " " 37/56 " 0.75"; paper["set3"] = 2/122 " " 90/120 " 0.83"
    paper["set4"] = "0 1 0.74"; paper["set5"] = 2/49 " " 37/47 " 0.76"; paper["dropper"] = "- - -"
    set = from ~ /^set/ ? substr(from, 4) : "-"
}

/^#/ { next }
$1 == "time" { for (i = 1; i <= NF; i++) at[$i] = i; next }

{
    hits++
    stuck = $at["outcome"] == "stick"
    if (stuck) captured[$at["patch"]]++
    if ($at["patch"] != "target") next
    if (set == "-" ? $at["v_n"] < 0.57 : $1 > 0.03) { slower++; next }
    n++; v = $at["v_n"]; t = $at["v_t"]
    speed += v; if (!least || v < least) least = v; if (v > most) most = v; if (t > most_t) most_t = t
    angle += atan2(t, v)*180/pi
    if (stuck) { s++; next }
    e_n += $at["e_n"]; e_t += $at["e_t"]; e_t2 += $at["e_t"]^2
    if ($at["e_n"] < 0.6) below++
}

# A published number, or - if there is none
function published(x) { return x == "-" ? x : sprintf("%.4g", x) }
function share(k, n) { return n ? sprintf("%.4f,%.4f", k/n, sqrt(k/n*(1 - k/n)/n)) : "-,-" }

END {
    if (header) exit
    split(paper[from], p, " ")
    r = n - s
    printf "%s,%s,%d,%.2f,%d,%d,%d,%d,", name, set, grains, hits/grains, captured["target"], captured["vessel"], n, slower
    if (n) printf "%.2f,%.2f,%.2f,%.2f,%.1f,", least, speed/n, most, most_t, angle/n; else printf "-,-,-,-,-,"
    printf "%s,%s,%s,%s,", share(s, n), published(p[1]), share(below, r), published(p[2])
    if (r) { m = e_t/r; q = e_t2/r - m*m; printf "%.3f,%.4f,%.4f,", e_n/r, m, sqrt((q > 0 ? q : 0)/r) } else printf "-,-,-,"
    print published(p[3])
}
