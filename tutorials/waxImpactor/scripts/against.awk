# Prints two tables of Allrun beside the paper's numbers: a row for each run, then the root mean square errors of both.
#
#   awk -v out=against.csv -f against.awk before/wax.csv after/wax.csv
#
# A bound such as ">0.85" is printed but not counted.

function shown(x, places) { return x == "" || x == "-" ? "-" : sprintf("%." places "f", x) }
function percent(x,    bound) { bound = sub(/^>/, "", x) ? ">" : ""; return x == "" || x == "-" ? "-" : sprintf("%s%.1f", bound, 100*x) }
function number(x) { return x ~ /^[0-9.]+$/ }
function count(what, paper, b, a) {
    if (!number(paper)) return
    n[what]++; before[what] += (b - paper)^2; after[what] += (a - paper)^2
}
function rms(sum, what) { return n[what] ? sqrt(sum/n[what]) : "" }

BEGIN {
    FS = ","
    print "       capture efficiency [%]         e_n, stuck = 0"
    print "   C    paper   before    after      paper   before    after"
    print "run,T_C,capture_paper,capture_before,capture_after,e_n_paper,e_n_before,e_n_after" > out
}

FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }

{ share = $at["capture_efficiency"]; e_n = $at["e_n"] }

NR == FNR { capture[$1] = share; restitution[$1] = e_n; next }

{
    paper = $at["capture_efficiency_paper"]; e_n_paper = $at["e_n_paper"]
    count("capture", paper, capture[$1], share)
    count("e_n", e_n_paper, restitution[$1], e_n)
    printf "%4d  %7s  %7s  %7s    %7s  %7s  %7s\n", $at["T_C"], percent(paper), percent(capture[$1]), percent(share), \
        shown(e_n_paper, 2), shown(restitution[$1], 3), shown(e_n, 3)
    print $1 "," $at["T_C"] "," paper "," capture[$1] "," share "," e_n_paper "," restitution[$1] "," e_n > out
}

END {
    printf " rms error     %7s  %7s             %7s  %7s\n", percent(rms(before["capture"], "capture")), \
        percent(rms(after["capture"], "capture")), shown(rms(before["e_n"], "e_n"), 3), shown(rms(after["e_n"], "e_n"), 3)
    print "rms_error,,," rms(before["capture"], "capture") "," rms(after["capture"], "capture") ",," \
        rms(before["e_n"], "e_n") "," rms(after["e_n"], "e_n") > out
}
