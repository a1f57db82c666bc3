# Draws the batch of particles: prints OpenFOAM's injection table, one line for each particle.
#
#   awk -v n=3000 -v seed=1 -v speed=2 -f batch.awk
#
# The nozzle is in the middle between the plates and points at `plate`, 40 degrees from it, with normally distributed deviations of 5
# degrees; speed [m/s] with deviations of 10 %. Diameter uniform from 90 to 150 um.

# Generator of Park and Miller, so that every awk draws the same batch
function uniform() { state = (16807*state) % 2147483647; return state/2147483647 }
function normal()  { return sqrt(-2*log(uniform()))*cos(2*pi*uniform()) }

BEGIN {
    pi = 3.141592653589793
    state = seed*48271 + 12345
    for (i = 0; i < 20; i++) uniform()
    print "FoamFile { version 2.0; format ascii; class dictionary; object particles; }"
    print "// (x y z) (u v w) d rho mDot"
    print n; print "("
    for (i = 0; i < n; i++) {
        angle = (40 + 5*normal())*pi/180; v = speed*(1 + 0.1*normal())
        printf "(%.9g 0.005 %.9g) (%.9g 0 %.9g) %.9ge-6 1000 1\n", \
            0.0045 + 0.001*uniform(), 0.004 + 0.002*uniform(), -v*sin(angle), v*cos(angle), 90 + 60*uniform()
    }
    print ")"
}
