# Prints the reference of the runs, computed without OpenFOAM, a line for each size:
#
#     d [um]  Stk  Stk_eff  Re_p  impaction from trajectories  impaction from the published fit (- below its range)
#
#   awk -v sizes="10 20 50" -v T=1600 -f reference.awk
#
# Trajectories: d v/dt = (u - v) C_D Re/(24 tau) in the exact potential flow around a tube, u_x = U (1 - R2 (x2 - y2)/r4),
# u_y = -2 U R2 x y/r4, tau = rho d2/(18 mu), C_D Re = 24 (1 + Re^(2/3)/6) (Putnam 1961; OpenFOAM's sphereDrag). Method:
# classical Runge-Kutta, with bisection for the start that just hits (to 1e-4 radii). Start: 20 radii upstream with speed
# U, as in the runs.
#
# Fit: Israel and Rosner, Aerosol Sci. Technol. 2 (1983) 45, eta = 1/(1 + 1.25/s - 1.4e-2/s2 + 0.508e-4/s3), s = Stk_eff - 1/8, for
# Stk_eff > 0.14 (quoted from others; the paper was not available). Stk = tau U/R, and Stk_eff = Stk psi with
# psi = 1/Re int_0^Re 24/(C_D Re') dRe' = 18 (q - sqrt6 atan(q/sqrt6))/q3, q = Re^(1/3), at Re = rho_g U d/mu.

function move(x, y, u, v,    r2, r4, gx, gy, re, rate) {
    r2 = x*x + y*y; r4 = r2*r2
    gx = U*(1 - R*R*(x*x - y*y)/r4) - u
    gy = -2*U*R*R*x*y/r4 - v
    re = sqrt(gx*gx + gy*gy)*rho*d/mu
    rate = (1 + re^(2/3)/6)/tau
    ax = gx*rate; ay = gy*rate
}

function hits(start,    x, y, u, v, u1, v1, u2, v2, u3, v3, a1, b1, a2, b2, a3, b3) {
    x = -20*R; y = start; u = U; v = 0
    while (x < R) {
        if (x*x + y*y <= R*R) return 1
        move(x, y, u, v);                           a1 = ax; b1 = ay
        u1 = u + h/2*a1; v1 = v + h/2*b1
        move(x + h/2*u, y + h/2*v, u1, v1);         a2 = ax; b2 = ay
        u2 = u + h/2*a2; v2 = v + h/2*b2
        move(x + h/2*u1, y + h/2*v1, u2, v2);       a3 = ax; b3 = ay
        u3 = u + h*a3; v3 = v + h*b3
        move(x + h*u2, y + h*v2, u3, v3)
        x += h/6*(u + 2*u1 + 2*u2 + u3); y += h/6*(v + 2*v1 + 2*v2 + v3)
        u += h/6*(a1 + 2*a2 + 2*a3 + ax); v += h/6*(b1 + 2*b2 + 2*b3 + ay)
    }
    return 0
}

BEGIN {
    U = 10; R = 0.02; density = 2300
    mu = 1.458e-6*sqrt(T)/(1 + 110.4/T); rho = 101325*28.96/(8314.47*T)
    kinds = split(sizes, list)
    for (k = 1; k <= kinds; k++) {
        d = list[k]*1e-6; tau = density*d*d/(18*mu)
        h = 2e-5; if (h > 0.2*tau) h = 0.2*tau
        low = 0; high = 1
        if (!hits(1e-6*R)) high = 0
        while (high - low > 1e-4) { middle = (low + high)/2; if (hits(middle*R)) low = middle; else high = middle }
        re = rho*U*d/mu; q = re^(1/3); r6 = sqrt(6)
        stk = tau*U/R; eff = stk*18*(q - r6*atan2(q, r6))/re; s = eff - 1/8
        fit = "-"
        if (eff > 0.14) fit = sprintf("%.4f", 1/(1 + 1.25/s - 1.4e-2/(s*s) + 0.508e-4/(s*s*s)))
        printf "%s %.4f %.4f %.3f %.4f %s\n", list[k], stk, eff, re, (low + high)/2, fit
    }
}
