# Draws the batch of particles: prints OpenFOAM's injection table, one line for each particle.
#
#   awk -v n=4000 -v seed=1 -v C=70 -v air=2.7 -v d=80 -v sd=15 -v low=50 -v high=110 -v disc=0.010 -v scatter=3 -f batch.awk
#
# Diameter [um]: normal distribution (d, sd), cut at low and high. Position: uniform over a disc of diameter `disc` [m].
# Direction: down, with normally distributed deviations `scatter` [degrees] in x and in y. Speed at the end of the tube:
# air [m/s] + terminal velocity, as in the paper. Temperature C [degrees Celsius]: that of the air.

# Generator of Park and Miller, so that every awk draws the same batch
function uniform() { state = (16807*state) % 2147483647; return state/2147483647 }
function normal()  { return sqrt(-2*log(uniform()))*cos(2*pi*uniform()) }

function terminal(d,    v, k, re) {     # drag of Schiller and Naumann, as OpenFOAM's sphereDrag
    for (k = 0; k < 60; k++) {
        re = rho*v*d/mu
        v = (1000 - rho)*9.81*d*d/(18*mu*(1 + re^(2/3)/6))
    }
    return v
}

BEGIN {
    pi = 3.141592653589793
    state = seed*48271 + 12345
    for (i = 0; i < 20; i++) uniform()
    T = C + 273.15
    mu = 1.458e-6*sqrt(T)/(1 + 110.4/T)
    rho = 101325*28.96/(8314.47*T)

    print "FoamFile { version 2.0; format ascii; class dictionary; object particles; }"
    print "// (x y z) (u v w) d rho mDot T Cp (gas liquid solid) () () (wax)"
    print n; print "("
    for (i = 0; i < n; i++) {
        do size = d + sd*normal(); while (size < low || size > high)
        r = 0.5*disc*sqrt(uniform()); phi = 2*pi*uniform()
        tx = scatter*pi/180*normal(); ty = scatter*pi/180*normal()
        v = air + terminal(size*1e-6); w = v/sqrt(1 + tx*tx + ty*ty)
        printf "(%.9g %.9g 0.0495) (%.9g %.9g %.9g) %.9ge-6 1000 1 %.2f 2000 (0 0 1) () () (1)\n", \
            r*cos(phi), r*sin(phi), w*tx, w*ty, -w, size, T
    }
    print ")"
}
