# Prints the row of results/wax.csv for a run. Input: its log, the table of the plate (target.dat) and the list of impacts
# (target.post, in another folder since v2306 target.dat).
#
# First impacts only, as the paper's camera recorded them. A run ends before a particle that rebounded can return. Hot
# particles hardly rebound and return at once, too slowly to leave again; their number identifies them.
#
#   -v list=FILE    also write the first impacts to FILE, a data file for `nearwall predict`
#   -v header=1     print the names of the columns
#   -v tilt=4.5     inclination of the plate [degrees]

function sum(i, x) { s[i] += x; q[i] += x*x }
function mean(i) { return s[i]/n }
function sd(i,    m) { m = s[i]/n; return sqrt(q[i]/n - m*m) }
function degrees(x) { return x*180/pi }
# Percent as a share; ">85" stays a bound, "-" means no value
function share(x,    bound) { bound = sub(/^>/, "", x) ? ">" : ""; return x == "-" ? x : bound x/100 }
function known(name) { return name in column }
function total(name) { return value[column[name]] }

BEGIN {
    pi = 3.141592653589793; CONVFMT = "%.9g"
    if (header) {
        print "run,T_C,d_um,d_sd_um,first_impacts,stuck,capture_efficiency,capture_efficiency_low95,capture_efficiency_high95," \
            "v_mean_m_s,v_sd_m_s,angle_mean_deg,angle_sd_deg,angle_seen_mean_deg,angle_seen_sd_deg," \
            "e_n_rebounds,e_n,e_n_standard_error,e_g,capture_efficiency_paper,e_n_paper,later_impacts,balance_residual"
        exit
    }
    if (list) print "v_n,v_t,d,T_p,T_w" > list
    nx = -sin(tilt*pi/180); nz = cos(tilt*pi/180)
}

FILENAME ~ /log\./ { if (/Near-wall mass balance/) residual = $NF; next }

FILENAME ~ /nearWallInteraction\/.*target\.dat$/ {
    if ($1 == "#") { delete column; for (i = 2; i <= NF; i++) column[$i] = i - 1 }
    else if ($1 + 0 >= latest) { latest = $1 + 0; split($0, value) }    # totals since the start
    next
}

/^#/ { next }

{
    gsub(/[()]/, "")        # time rank x y z origProc origId d u v w T
    if (($6, $7) in met) { later++; next }
    met[$6, $7] = 1; n++
    v_n = -($9*nx + $11*nz)
    v_x = $9*nz - $11*nx    # along the plate, in the plane that the camera sees
    v = sqrt($9*$9 + $10*$10 + $11*$11)
    sum("d", $8*1e6); sum("v", v)
    v_t = sqrt(v_x*v_x + $10*$10)
    if (list) print v_n "," v_t "," $8 "," $12 "," C + 273.15 > list
    sum("angle", degrees(atan2(v_n, v_t)))
    sum("seen", degrees(atan2(v_n, -v_x)))
}

END {
    if (header) exit
    if (!n) { print name ": nothing hit the plate" > "/dev/stderr"; exit 1 }
    if (total("hits") != n + later) { print name ": impacts listed " n + later ", counted " total("hits") > "/dev/stderr"; exit 1 }
    rebounds = total("rebounds"); stuck = n - rebounds; p = stuck/n
    z = 1.96; half = z*sqrt(p*(1 - p)/n + z*z/(4*n*n)); middle = p + z*z/(2*n)      # Wilson
    printf "%s,%s,%.1f,%.1f,%d,%d,%.4f,%.4f,%.4f,", name, C, mean("d"), sd("d"), n, stuck, p, \
        (middle - half)/(1 + z*z/n), (middle + half)/(1 + z*z/n)
    printf "%.3f,%.3f,%.2f,%.2f,%.2f,%.2f,", mean("v"), sd("v"), mean("angle"), sd("angle"), mean("seen"), sd("seen")
    if (known("e_n_sum")) {
        e_n = total("e_n_sum")/n
        printf "%.4f,%.4f,%.4f,", rebounds ? total("e_n_sum")/rebounds : 0, e_n, sqrt((total("e_n2_sum")/n - e_n*e_n)/n)
    } else printf ",,,"
    if (known("e_g_sum")) printf "%.4f,", total("e_g_sum")/n; else printf ","
    printf "%s,%s,%d,%s\n", share(capture), e_n_paper, later, residual
}
