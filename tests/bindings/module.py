"""The Python module: its faults have the library's words, its arrays are the caller's own, its numbers agree with each other."""

import sys
import warnings

import numpy

import nearwall

warnings.simplefilter("ignore")
model = nearwall.Model.from_file(sys.argv[1])
checks = 0


def refused(kind, call, words):
    global checks
    checks += 1
    try:
        call()
    except kind as fault:
        assert words in str(fault), str(fault)
        return fault
    raise AssertionError(f"no {kind.__name__} with '{words}'")


v_n = numpy.geomspace(0.01, 20, 1000)
d = numpy.full(1000, 5e-5)
many = model.resolve(v_n, d=d, T_p=1300.0, T_w=1100.0, seed=7)
assert 0 < many.stuck.sum() < 1000 and many.e_n.max() > 0.05

# One by one with the key of its index: the same bits as all at once.
for index in range(0, 1000, 37):
    one = model.resolve(float(v_n[index]), d=5e-5, T_p=1300.0, T_w=1100.0, seed=7, key=numpy.array([index], numpy.uint64))
    for name in nearwall.Outcomes._fields:
        assert getattr(one, name)[0] == getattr(many, name)[index], (index, name)

# Another wall array, and a slice that is contiguous: read in place.
walls = numpy.zeros(10, numpy.uint32)
part = model.resolve(v_n[900:910], wall=walls, d=d[900:910], T_p=1300.0, T_w=1100.0)
assert (part.e_n == many.e_n[900:910]).all() and len(set(part.e_n)) == 10

speeds = model.speeds(d=5e-5, T_p=900.0, T_w=900.0)
dry = model.resolve(numpy.array([speeds.sticking * 0.999, speeds.sticking * 1.001]), d=5e-5, T_p=900.0, T_w=900.0)
assert list(dry.stuck) == [1, 0], (speeds, dry)
ranges = model.temperature_ranges()
assert 0 <= ranges.particle_low < ranges.particle_high and 0 <= ranges.wall_low < ranges.wall_high, ranges
assert model.find_wall("default") == 0 and len(nearwall.VERSION.split(".")) == 3

bad = d.copy()
bad[17] = 0.0
fault = refused(nearwall.Error, lambda: model.resolve(v_n, d=bad), "impact 17: an input is not finite or outside its bounds")
assert (fault.status, fault.index) == (7, 17)
assert nearwall.unlikely(T_p=25.0) == "T_p = 25 K; is that °C?" and nearwall.unlikely(v_n=2.0, T_p=900.0) == ""
assert nearwall.key_of_values(0.25, -0.5, 75e-6, 1300.0, 2.0) == 0x7304CDEACCF47FD1
refused(nearwall.Error, lambda: nearwall.key_of_values(), "not finite")
refused(nearwall.Error, lambda: nearwall.key_of_values(1.0, numpy.nan), "not finite")
assert "v_n = -1" in model.explain(-1.0) and model.explain(2.0, T_p=900.0, T_w=900.0) == "", model.explain(-1.0)
refused(nearwall.Error, lambda: model.find_wall("roof"), "the model has no such wall")
refused(nearwall.Error, lambda: nearwall.Model.from_file("/nowhere/nearWall.toml"), "/nowhere/nearWall.toml")
refused(nearwall.Error, lambda: nearwall.Model.from_toml("x = = 1", "mine.toml"), "mine.toml:1:")
deposit = model.initial_deposit(0, 0.4)
refused(nearwall.Error, lambda: model.initial_deposit(9, 0.4), "the model has no such wall")
refused(nearwall.Error, lambda: model.add_captured(nearwall.DepositSource(), -1.0, 2300.0, 900.0), "an input is not finite or outside its bounds")
refused(nearwall.Error, lambda: model.apply_deposit(deposit, 1.0, 900.0), "an input is not finite or outside its bounds")
deposit.molten = -1.0
refused(nearwall.Error, lambda: deposit.add(nearwall.DepositSource()), "an input is not finite or outside its bounds")
refused(nearwall.Error, lambda: model.film_velocity(deposit, 1600.0, 9.81), "an input is not finite or outside its bounds")
cooling = nearwall.WallCooling(600.0, 1700.0, gas_coefficient=100.0)
heat = model.heat(model.initial_deposit(0, 0.4), 0.4, cooling)
assert heat.surface_temperature == 600.0 and abs(heat.heat_flux / 110e3 - 1) < 1e-12 and heat.deposit_resistance == 0, heat.heat_flux
refused(TypeError, lambda: nearwall.WallCooling(600.0, 1700.0, gas_coeficient=1.0), "no such input: gas_coeficient")
refused(TypeError, lambda: nearwall.WallCooling(600.0, 1700.0, struct_size=1), "no such input: struct_size")
refused(nearwall.Error, lambda: model.heat(model.initial_deposit(0, 0.4), 1.0, cooling), "an input is not finite or outside its bounds")
calm = nearwall.DepositSurroundings(0.4)
refused(nearwall.Error, lambda: model.advance_deposit(model.initial_deposit(0, 0.4), calm, -1.0), "an input is not finite or outside its bounds")
held = nearwall.WallCooling(600.0, 1700.0, gas_coefficient=numpy.inf)
lying = nearwall.Deposit(0)
lying.molten = 1.0
refused(nearwall.Error, lambda: model.advance_deposit(lying, calm, 1.0, held), "an input is not finite or outside its bounds")
refused(nearwall.Error, lambda: model.advance_deposit(nearwall.Deposit(9), calm, 1.0), "the model has no such wall")
refused(TypeError, lambda: nearwall.DepositSurroundings(0.4, shear=1.0), "no such input: shear")
deposit = model.initial_deposit(0, 0.4)
wind = dict(kinematic_viscosity=1.5e-5, shear_down=1.2e6)
unknown_gas = nearwall.DepositSurroundings(0.4, **wind)
refused(nearwall.Error, lambda: model.advance_deposit(deposit, unknown_gas, 60.0), "an input is not finite or outside its bounds")
lost = model.advance_deposit(deposit, nearwall.DepositSurroundings(0.4, gas_density=1.2, **wind), 60.0)
assert lost == {"condensed": 0.0, "resuspended": 0.0, "shed": 0.0} and model.wall_processes(0) == ["melting", "sintering"], lost
assert bytes(deposit) == bytes(model.initial_deposit(0, 0.4)), "a model without a table of adhesion lost powder"
refused(TypeError, lambda: model.add_captured(nearwall.DepositSource(), 1.0, 2300.0, 900.0, diameter=1e-4), "no such input: diameter")
refused(TypeError, lambda: model.resolve(v_n, diameter=d), "no such input: diameter")
refused(TypeError, lambda: model.resolve(["fast"]), "v_n has to be of numbers: could not convert string to float: ")
refused(ValueError, lambda: model.resolve([[1.0, 2.0]]), "v_n has shape (1, 2), there are 1 impacts")
refused(TypeError, lambda: model.resolve(v_n, wall=numpy.zeros(1000)), "wall has to be of integers, not of float64")
refused(ValueError, lambda: model.resolve(v_n[:2], wall=[0, -1]), "wall has to be between 0 and 2**32 - 1")
refused(nearwall.Error, lambda: model.resolve(v_n, wall="roof"), "the model has no such wall")

# Whatever holds the numbers: the same bits; one number beside many; walls by their names.
whole = numpy.array([1.0, 2.0, 3.0])
fixed = dict(d=5e-5, T_p=1300.0, T_w=1100.0)
same = model.resolve(whole, **fixed)
for given in ([1, 2, 3], (1.0, 2.0, 3.0), whole.astype("f4"), whole.astype(int), numpy.repeat(whole, 2)[::2]):
    assert (model.resolve(given, **fixed).e_n == same.e_n).all(), type(given)
assert (model.resolve(2.0, **{**fixed, "d": [5e-5, 5e-5]}).e_n == same.e_n[1]).all()
assert (model.resolve(whole, wall=["default"] * 3, **fixed).e_n == same.e_n).all()
assert model.speeds("default", **fixed) == model.speeds(0, **fixed) and set(same.regime) <= set(nearwall.REGIMES)
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    model.resolve(whole, d=5e-5)
assert "assumed, in SI units: T_p = 293.15, conversion = 1, T_w = 293.15" in str(said[0].message), said
refused(TypeError, lambda: model.resolve(v_n, key=3), "key has to be an array")
refused(ValueError, lambda: model.resolve(v_n, wall=2**32), "wall has to be between 0 and 2**32 - 1")
refused(ValueError, lambda: model.resolve(v_n, seed=-1), "seed has to be between 0 and 2**64 - 1")
refused(ValueError, lambda: model.find_wall("default\0x"), "name has a zero byte in it")
refused(ValueError, lambda: nearwall.Model.from_file("nearWall.toml\0x"), "path has a zero byte in it")
refused(ValueError, lambda: model.resolve(v_n, d=d[:10]), "d has shape (10,), there are 1000 impacts")

# Inputs that the model file declares: e_n = 0.5 + 0.2 humidity, e_t = 0.76, or 0.66 on glass.
PLAIN = """[particle]
material = "montan-wax"
[walls.default]
material = "pyrex"
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.76
[inputs.humidity]
default = 0.4
[inputs.plate]
labels = ["steel", "glass"]
[[effects]]
kind = "fitted-curve"
input = "humidity"
on = "e_n"
knots = [0, 1]
values = [0, 0.2]
[[effects]]
kind = "fitted-curve"
input = "plate"
on = "e_t"
knots = ["steel", "glass"]
values = [0, -0.1]
"""
damp = nearwall.Model.from_toml(PLAIN)
assert damp.extra_inputs == ["humidity", "plate"] and model.extra_inputs == []
assert damp.extra_input_default("humidity") == 0.4 and numpy.isnan(damp.extra_input_default("plate"))
assert damp.extra_input_value("plate", "glass") == 1.0
assert damp.extra_input_words("plate") == ["steel", "glass"] and damp.extra_input_words("humidity") == []
part = damp.resolve(v_n[:3], v_t=1.0, humidity=numpy.array([0.0, numpy.nan, 1.0]), plate="glass")
assert numpy.allclose(part.e_n, [0.5, 0.58, 0.7], atol=1e-15) and numpy.allclose(part.e_t, 0.66, atol=1e-15), part
assert numpy.allclose(damp.resolve(2.0, v_t=1.0).e_t, 0.76, atol=1e-15)
assert damp.speeds(humidity=0.1, plate="steel").sticking >= 0
powder = nearwall.Deposit()
powder.solid, powder.powder = 1e-3, 1.0
fault = refused(nearwall.Error, lambda: damp.heat(powder, 0.4, cooling), "has no thermal_conductivity")
assert fault.status == nearwall.NO_CONDUCTIVITY
refused(nearwall.Error, lambda: damp.resolve(v_n, plate="glas"), "did you mean `glass`? (known here: steel, glass)")
refused(TypeError, lambda: model.resolve(v_n, humidity=0.1), "no such input: humidity")
print(f"{checks} faults, {len(v_n)} impacts")
