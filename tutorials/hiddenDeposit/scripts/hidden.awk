# Draws what the rig's wall does: prints the table of a model file.
#
#   awk -v seed=1 -f hidden.awk

function uniform() { state = (16807*state) % 2147483647; return state/2147483647 }
function between(low, high) { return low + (high - low)*uniform() }

BEGIN {
    state = seed*48271 + 4711
    for (i = 0; i < 20; i++) uniform()
    which = int(3*uniform())
    print ""; print "[[effects]]"
    if (which == 0) {
        print "kind = \"melting-transition\""
        printf "temperature = %.1f\nwidth = %.1f\n", between(335, 365), between(4, 12)
    } else if (which == 1) {
        print "kind = \"adhesion-energy\""
        printf "work_of_adhesion = %.2f\n", between(1, 4)
    } else {
        print "kind = \"powder-layer\""
        printf "thickness = %.3e\nresidual = %.2f\n", between(0.5e-4, 2e-4), between(0.05, 0.3)
    }
}
