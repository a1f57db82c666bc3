"""tests/bindings/deposit.c, in Python."""

import sys

import numpy

import nearwall

model = nearwall.Model.from_file(sys.argv[1])
deposit, source = model.initial_deposit(model.find_wall("default"), 0.4), nearwall.DepositSource()
cooling = nearwall.WallCooling(600.0, 1500.0, coolant_coefficient=2000.0, wall_resistance=1e-3, gas_coefficient=300.0,
                               emissivity=0.8, irradiation=4e5)
heat = nearwall.WallHeat()
for row, (v_n, v_t, d, T_p, T_w) in enumerate(numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1).tolist()):
    met = model.apply_deposit(deposit, 0.4, T_w, d)
    impact = dict(v_n=v_n, v_t=v_t, d=d, T_p=T_p, conversion=0.5 if row % 2 else 1.0, **met)
    out = model.resolve(**impact, seed=1, key=numpy.array([row], numpy.uint64))
    if out.stuck[0]:
        model.add_captured(source, (1 + row % 7) / 1024, 2300.0, **impact)
    if row % 4 == 3:
        deposit.add(source)
        source = nearwall.DepositSource()
        cooling.gas_temperature = 4000.0 if row % 64 == 63 else 1500.0
        heat = model.heat(deposit, 0.4, cooling)
        around = nearwall.DepositSurroundings(0.4, gas_density=0.25, kinematic_viscosity=2.5e-4, gravity_along=9.81,
                                              shear_down=0.5, shear_across=0.25, draw=0.5)
    else:
        around = nearwall.DepositSurroundings(0.4, gas_density=0.25, kinematic_viscosity=2.5e-4,
                                              shear_down=0.25 * (0.25 * (1 + row % 5))**2)
    losses = model.advance_deposit(deposit, around, 1.0, cooling if row % 4 == 3 else None)
    if row % 4 == 3 and deposit.molten + deposit.frozen + deposit.powder <= 0:
        deposit = model.initial_deposit(deposit.wall, 0.4)
    velocity = model.film_velocity(deposit, T_w, 9.81)
    print(out.stuck[0], *(f"{number:.17g}" for number in (
        met["layer_thickness"], met["coverage"], met["melt_thickness"], deposit.molten, deposit.powder, deposit.solid, deposit.cover, deposit.conversion, velocity,
        deposit.frozen, deposit.behind, deposit.closed, deposit.resuspended, heat.surface_temperature, heat.wall_temperature, heat.heat_flux,
        heat.coolant_flux, heat.deposit_resistance,
        0.0, 0.0, 0.0, losses["resuspended"], losses["shed"])))
