"""What the gas leaves of loose powder on a wall, by direct integration of the law of Reeks & Hall 2001 over the adhesion of
the particles (no classes, no states): the oracle of case_blown.

    blown.py RADIUS DENSITY KINEMATIC_VISCOSITY FRICTION_VELOCITY WORK MEDIAN SPREAD TIME

prints the share that remains."""
import sys
from math import erf, exp, log, pi, sqrt

radius, density, nu, u, work, median, spread, time = map(float, sys.argv[1:])
plus = radius * u / nu
lift = 20.9 * density * nu**2 * plus**2.31
drag = 32 * density * nu**2 * plus**2
mean = lift / 2 + 100 * drag
deviation = 0.2 * mean
frequency = 0.00658 * u**2 / nu


def rate(force):
    x = (force - mean) / deviation
    if x < 0:
        return frequency
    return frequency * min(1, exp(-min(x, 30) ** 2 / 2) / (0.5 * (1 + erf(x / sqrt(2)))))


# Over the logarithm of the reduced adhesion, ten geometric deviations to both sides
steps = 100_000
share = 0
for i in range(steps):
    t = 20 * (i + 0.5) / steps - 10
    adhesion = 1.5 * pi * work * radius * median * exp(log(spread) * t)
    share += exp(-t * t / 2) / sqrt(2 * pi) * exp(-rate(adhesion) * time) * 20 / steps
print(f"{share:.9f}")
