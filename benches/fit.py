"""Fits yield_ratio and the work of adhesion of Thornton & Ning to measured e_n, as one would with SciPy: the law in NumPy, least
squares from several starts. Usage: fit.py MEASURED.csv E_STAR YIELD_STRENGTH DENSITY [SI units]. Prints the two values, their standard
errors and the time [s] of the fit alone."""

import sys
import time

import numpy as np
from scipy.optimize import least_squares

# C1 and C2 of the law: see src/normal/thornton_ning.rs.
C1 = np.sqrt(3)/2*np.cbrt(np.pi)*np.sqrt((1 + 6*2**(2/3))/5)
C2 = np.pi**2/(2*np.sqrt(10))


def e_n(v, d, yield_ratio, work, modulus, strength, density):
    """Normal restitution; 0 where adhesion holds the particle."""
    pressure = yield_ratio*strength
    yielding = C2*np.sqrt(pressure**5/(density*modulus**4))
    adhesive2 = C1**2*modulus/density*(d*modulus/(2*work))**(-5/3)
    w = np.minimum(yielding/v, 1)
    plastic = 1.2*np.sqrt(3)*(1 - w*w/6)*np.sqrt(w/(w + 2*np.sqrt((6 - w*w)/5)))
    return np.sqrt(np.maximum(plastic - adhesive2/v**2, 0))


def main():
    v, d, measured = np.loadtxt(sys.argv[1], delimiter=",", skiprows=1, unpack=True)
    solids = [float(value) for value in sys.argv[2:5]]
    start = time.perf_counter()

    def residuals(logs):
        return e_n(v, d, *np.exp(logs), *solids) - measured

    fits = [least_squares(residuals, np.log([ratio, work])) for ratio in (0.5, 2) for work in (0.01, 0.1, 1)]
    best = min(fits, key=lambda fit: fit.cost)
    covariance = np.linalg.inv(best.jac.T @ best.jac)*2*best.cost/(len(v) - 2)
    values = np.exp(best.x)
    errors = values*np.sqrt(np.diag(covariance))
    spent = time.perf_counter() - start
    print(f"{values[0]:.5g} {errors[0]:.2g} {values[1]:.5g} {errors[1]:.2g} {spent:.4f}")


main()
