# Draws the dust: prints OpenFOAM's injection table, one line for each grain.
#
#   awk -v n=6000 -v seed=1 -v from=dropper -f dust.awk
#   awk -v n=4000 -v seed=1 -v from=set1 -f dust.awk
#
# from=dropper: grains start 1 mm below the top of the vessel, 22 cm from the source (32 cm from the end plate), on a disc
# of 10 mm (assumed), with the speed of a free fall from the dropper 1.875 m above the axis. Direction: down, with normally
# distributed deviations of 0.2 degrees in x and in y (assumed; 6 mm after the fall).
#
# from=set1 to set5: grains start 4 mm before the target and hit it as the paper prints for that set: v_n uniform over its
# range, angle from the normal exponential over its range with the printed mean, v_t within its range (the shapes are
# assumed). Sets 1, 2, 3 and 5: upright target, v_t in any direction. Set 4: oblique target, v_t up its slope.
#
# Diameter: triangular distribution over the printed range about the most probable one.

# Generator of Park and Miller, so that every awk draws the same batch
function uniform() { state = (16807*state) % 2147483647; return state/2147483647 }
function normal()  { return sqrt(-2*log(uniform()))*cos(2*pi*uniform()) }

# Arguments: v_n, v_t [m/s] (min, max), angle [degrees from the normal] (min, max, mean), d [um] (min, most probable, max)
function take(a, b, c, e, f, g, h, i, j, k) { n0 = a; n1 = b; t0 = c; t1 = e; a0 = f; a1 = g; mean = h; d0 = i; dm = j; d1 = k }

# Draws one impact: sets v_n and v_t for an angle with density exp(-lean angle)
function impact(    u) {
    do {
        v_n = n0 + (n1 - n0)*uniform()
        u = uniform()
        angle = lean == 0 ? a0 + (a1 - a0)*u : a0 - log(1 - u*(1 - exp(-lean*(a1 - a0))))/lean
        v_t = v_n*sin(angle*pi/180)/cos(angle*pi/180)
    } while (v_t < t0 || v_t > t1)
}

# Sets lean so that the mean angle is the printed one
function find_lean(    low, high, k, sum, i) {
    low = -0.5; high = 0.5
    for (k = 0; k < 16; k++) {
        lean = (low + high)/2; sum = 0; state = 4711
        for (i = 0; i < 2000; i++) { impact(); sum += angle }
        if (sum/2000 > mean) low = lean; else high = lean
    }
}

function size(    u, m) {
    u = uniform(); m = (dm - d0)/(d1 - d0)
    return u < m ? d0 + (d1 - d0)*sqrt(u*m) : d1 - (d1 - d0)*sqrt((1 - u)*(1 - m))
}

BEGIN {
    pi = 3.141592653589793
    #                      v_n          v_t         angle             d
    if (from == "set1")      take(1.36, 12.95, 0, 6.88, 0, 73.4, 24.3, 8, 9, 10)
    else if (from == "set2") take(0.70, 8.86, 0, 3.53, 0, 73.3, 22.9, 8, 9, 10)
    else if (from == "set3") take(0.78, 7.71, 0, 3.11, 0, 80.8, 19.0, 8, 9, 10)
    else if (from == "set4") take(0.88, 4.50, 2.04, 8.81, 42.9, 77.3, 60.6, 8, 9, 10)
    else if (from == "set5") take(0.57, 7.90, 0, 2.48, 0, 57.8, 21.7, 12, 14, 16)
    else                     take(0, 0, 0, 0, 0, 0, 0, 8, 9, 10)
    if (mean) find_lean()
    state = seed*48271 + 12345
    for (i = 0; i < 20; i++) uniform()

    print "FoamFile { version 2.0; format ascii; class dictionary; object " from "; }"
    print "// (x y z) (u v w) d rho mDot"
    print n; print "("
    slope = from == "set4" ? 10*pi/180 : pi/2           # angle of the target from the axis
    nx = -sin(slope); nz = cos(slope)                   # its normal, into the vessel
    fall = sqrt(2*9.81*(1.875 - 0.199))
    for (i = 0; i < n; i++) {
        d = size(); r = (mean ? 0.010 : 0.005)*sqrt(uniform()); phi = 2*pi*uniform()
        if (mean) {
            impact()
            way = slope < 1.5 ? pi/2 : 2*pi*uniform()   # pi/2: up the slope
            t = v_t*sin(way)
            u = -v_n*nx + t*nz; v = v_t*cos(way); w = -v_n*nz - t*nx
            back = 0.004/v_n                            # s, to 4 mm before the target
            x = 0.54 - 0.015*(slope < 1.5)*nz + r*sin(phi)*nz - back*u; y = r*cos(phi) - back*v; z = -r*sin(phi)*nx - back*w
        } else {
            u = fall*0.2*pi/180*normal(); v = fall*0.2*pi/180*normal(); w = -fall
            x = 0.22 + r*cos(phi); y = r*sin(phi); z = 0.199
        }
        printf "(%.9g %.9g %.9g) (%.9g %.9g %.9g) %.9ge-6 18318 1\n", x, y, z, u, v, w, d
    }
    print ")"
}
