# Prints results/dust.csv as a table.
NR == 1 {
    for (i = 1; i <= NF; i++) at[$i] = i
    print "                       grains on           impacts on the target                    captured        e_n < 0.6         mean e_t"
    print "  run          bounces target vessel   number   v_n m/s (mean)     angle    here   paper    here   paper    here   paper"
    next
}
function cell(name) { return $at[name] }
function percent(name) { return cell(name) == "-" ? "-" : sprintf("%.1f", 100*cell(name)) }
{
    printf "  %-12s %7s %6s %6s %8s   %5s-%5s (%5s) %6s  %6s  %6s  %6s  %6s  %6s  %6s\n", $1, cell("bounces"), cell("captured_by_target"), \
        cell("captured_by_vessel"), cell("target_impacts"), cell("v_n_least_m_s"), cell("v_n_most_m_s"), cell("v_n_mean_m_s"), \
        cell("angle_mean_deg"), percent("captured"), percent("captured_paper"), percent("e_n_below_0.6"), percent("e_n_below_0.6_paper"), \
        cell("e_t") == "-" ? "-" : sprintf("%.2f", cell("e_t")), cell("e_t_paper")
}
