"""tests/bindings/deposit.c, in Python."""

import sys

import numpy

import nearwall

model = nearwall.Model.from_file(sys.argv[1])
deposit, source = model.initial_deposit(model.find_wall("default"), 0.4), nearwall.DepositSource()
for row, (v_n, v_t, d, T_p, T_w) in enumerate(numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1).tolist()):
    met = model.apply_deposit(deposit, 0.4, T_w)
    impact = dict(v_n=v_n, v_t=v_t, d=d, T_p=T_p, conversion=0.5 if row % 2 else 1.0, **met)
    out = model.resolve(**impact, seed=1, key=numpy.array([row], numpy.uint64))
    if out.stuck[0]:
        model.add_captured(source, (1 + row % 7) / 1024, 2300.0, **impact)
    if row % 4 == 3:
        deposit.add(source)
        source = nearwall.DepositSource()
    velocity = model.film_velocity(deposit, T_w, 9.81)
    print(out.stuck[0], *(f"{number:.17g}" for number in (
        met["layer_thickness"], met["coverage"], met["melt_thickness"], deposit.molten, deposit.powder, deposit.solid, deposit.cover, deposit.conversion, velocity)))
