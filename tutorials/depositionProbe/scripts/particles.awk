# Prints the injection table of the ash: for each size a row of particles, evenly spaced across the stream, 20 radii
# upstream of the tube.
#
#   awk -v sizes="10 20 50" -v rows=500 -v T=1600 -f particles.awk
#
# sizes [um]; rows: particles on one tube radius; T [K]: temperature of particles and gas. Particles start at the gas
# speed of 10 m/s between the plane of symmetry and 1.05 radii, each in the middle of a strip. An efficiency is
# therefore known to half a strip, 0.5/rows.
BEGIN {
    kinds = split(sizes, d)
    per = int(1.05*rows)
    print "FoamFile { version 2.0; format ascii; class dictionary; object particles; }"
    print "// (x y z) (u v w) d rho mDot T Cp (gas liquid solid) () () (ash)"
    print kinds*per; print "("
    for (k = 1; k <= kinds; k++) for (i = 0; i < per; i++)
        printf "(-0.4 %.9g 0) (10 0 0) %.9ge-6 2300 1 %g 1200 (0 0 1) () () (1)\n", 0.02*(i + 0.5)/rows, d[k], T
    print ")"
}
