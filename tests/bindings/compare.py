"""Compares the outputs of the examples in bindings/. Called by tests/bindings/run.

    compare.py prepare TABLE SHARE FOLDER   models and impacts of the golden table, and a grid of impacts on one model
    compare.py golden TABLE OUTPUT          e_n of an example against the golden table
    compare.py same OUTPUT OUTPUT           two examples, bit for bit
    compare.py udf OUTPUT UDF IMPACTS...    velocities of the user-defined wall against e_n and e_t of an example
    compare.py deposit IMPACTS OUTPUT OUTPUT...   deposit.c and the same in other languages, bit for bit; mass is conserved
    compare.py layout ABI MODULE            structs of library.py, as ctypes lays them out, against abi.txt
"""

import csv
import ctypes
import importlib.util
import itertools
import math
import pathlib
import re
import struct
import sys

GOLDEN_MODEL = """[particle]
material = "p"
[walls.default]
material = "w"
[normal]
model = "thornton-ning"
yield_ratio = 1
work_of_adhesion = {work_of_adhesion}
[tangential]
model = "constant"
e_t = 1
[materials.p]
density = {rho}
youngs_modulus = {E1}
poisson_ratio = {nu1}
yield_strength = {p_y}
surface_energy = 0
[materials.w]
density = {rho}
youngs_modulus = {E2}
poisson_ratio = {nu2}
yield_strength = {p_y}
surface_energy = 0
"""
HEADER = "v_n,v_t,d,T_p,T_w\n"


def golden(table):
    with open(table, newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 400
    return rows


def prepare(table, share, folder):
    folder = pathlib.Path(folder)
    for number, row in enumerate(golden(table)):
        (folder / f"{number}.toml").write_text(GOLDEN_MODEL.format(**row))
        (folder / f"{number}.csv").write_text(HEADER + f"{row['v_n']},0,{row['d']},293.15,293.15\n")
    (folder / "400.toml").write_text((pathlib.Path(share) / "examples/impacts/nearWall.toml").read_text())
    grid = itertools.product((0.003, 0.1, 0.7, 2.3, 19), (0, 0.01, 1.7, 30), (1.3e-6, 3e-5, 4.1e-4),
                             (650, 1310.7, 1475, 1690.3), (650, 1333.3, 1500.1, 1700))
    (folder / "400.csv").write_text(HEADER + "".join(",".join(map(repr, row)) + "\n" for row in grid))


def outcomes(path):
    """One tuple of numbers for each line; floats from 17 digits, so the very bits."""
    return [tuple(map(float, line.split())) for line in pathlib.Path(path).read_text().splitlines()]


def bits(row):
    return [struct.pack("<d", number) for number in row]


def compare_golden(table, output):
    worst = 0.0
    found = outcomes(output)
    for number, (row, ours) in enumerate(zip(golden(table), found[:400])):
        expected = float(row["e_n"])
        # As in tests/library/golden.rs: near its zero e_n is a root of a difference that rounding fills.
        allowed = max(1e-11 * abs(expected), 1e-9)
        assert abs(ours[0] - expected) <= allowed, f"case {number}: e_n {ours[0]!r}, golden {expected!r}"
        if expected > 0.01:
            worst = max(worst, abs(ours[0] / expected - 1))
    assert worst <= 1e-11, f"relative error {worst:.1e} away from zero"
    print(f"400 cases, worst relative error {worst:.1e} where e_n > 0.01")


def compare_same(one, other):
    one, other = outcomes(one), outcomes(other)
    assert len(one) == len(other) == 400 + 960, f"{len(one)} and {len(other)} impacts"
    for number, (ours, theirs) in enumerate(zip(one, other)):
        assert bits(ours) == bits(theirs), f"impact {number}: {ours} and {theirs}"
    kinds = {(e_n > 0, 0 < p < 1, stuck) for e_n, _, p, stuck in one}
    assert len(kinds) > 3, f"the impacts are too much alike: {kinds}"
    print(f"{len(one)} impacts, the same bits")


def compare_udf(output, udf, *impacts):
    expected, found = outcomes(output), outcomes(udf)
    rows = [tuple(map(float, line.split(","))) for path in impacts
            for line in pathlib.Path(path).read_text().splitlines()[1:]]
    assert len(expected) == len(found) == len(rows), f"{len(expected)}, {len(found)}, {len(rows)} impacts"
    rebounds = ends = drawn = 0
    for number, ((e_n, e_t, p, _), (away, along, ended), (v_n, v_t, *_)) in enumerate(zip(expected, found, rows)):
        # The wall has another key than the examples, the particle's number and hits: the draws differ.
        assert ended == p if p in (0, 1) else ended in (0, 1), f"impact {number}: p {p}, ended {ended}"
        drawn += 0 < p < 1
        ends += ended == 1
        if ended == 0:
            rebounds += 1
            assert bits((away, along)) == bits((e_n * v_n, e_t * v_t)), f"impact {number}: {away!r}, {along!r}"
    assert rebounds > 300 and ends > 300 and drawn > 50, (rebounds, ends, drawn)
    print(f"{rebounds} rebounds with the same bits, {ends} ends, {drawn} by chance")


def compare_deposit(impacts, output, *others):
    """Computed here: the deposit has the captured mass and carbon until the wall, which holds 10 Pa of shear, lets it fall, less
    the loose powder that the gas carries away, which leaves as it lies; the speed of a laminar film grows with its thickness
    squared (Nusselt); the wall's two sides pass the same heat."""
    rows = outcomes(output)
    for other in others:
        theirs = outcomes(other)
        assert len(rows) == len(theirs), f"{len(rows)} and {len(theirs)} impacts"
        for number, (one, another) in enumerate(zip(rows, theirs)):
            assert bits(one) == bits(another), f"{other}, impact {number}: {one} and {another}"
    T_w = [float(line.split(",")[4]) for line in pathlib.Path(impacts).read_text().splitlines()[1:]]
    assert len(T_w) == len(rows) == 960, len(rows)
    # The wall begins with 10 um of the model's fly ash, of 2300 kg/m3 and with 0.4 voids.
    initial = 1e-5 * (1 - 0.4) * 2300
    mass, carbon, films = initial, 0.0, {}
    falls = sintered = melted = blown = 0
    lying, gone = [initial, initial / 2300] * 2, 0.0
    for number, (stuck, _, coverage, _, molten, powder, solid, cover, conversion, velocity, *cooled) in enumerate(rows):
        frozen, behind, closed, resuspended, surface, under, flux, passed, resistance, *conserved, taken_away, fallen = cooled
        outside = 1 - behind if molten + frozen > 0 else 1
        assert conserved == [0, 0, 0] and (number % 4 == 3 or fallen == 0), f"impact {number}: {cooled}"
        mass += stuck * (1 + number % 7) / 1024
        carbon += stuck * (1 + number % 7) / 1024 * (0.5 if number % 2 else 1)
        assert 0 <= coverage <= 1 and 0 <= resuspended <= 1
        if number % 4 != 3 and powder < lying[0]:
            kept = (1 - resuspended) / (1 - gone)
            assert molten == 0 and 0 < kept < 1, f"impact {number}: {resuspended!r} of the powder has left"
            for one, another in zip((powder * outside, solid * outside), lying[2:]):
                assert abs(one / (another * kept) - 1) < 1e-9, f"impact {number}: {one!r} of {another!r} is left"
            assert abs(taken_away / (lying[0] - powder) - 1) < 1e-9, f"impact {number}: {taken_away!r} kg/m2 left"
            mass -= lying[0] - powder
            carbon -= (lying[0] - powder) * conversion
            blown += 1
        elif number % 4 != 3:
            assert ([powder, solid], resuspended, taken_away) == (lying[:2], gone, 0), f"impact {number}: {powder!r} kg/m2"
        if number % 4 == 3:
            gas = 4000 if number % 64 == 63 else 1500
            given = 300 * (gas - surface) + 0.8 * (4e5 - 5.670374419e-8 * surface**4)
            taken = (surface - 600) / (1 / 2000 + 1e-3 + resistance)
            assert max(abs(given - flux), abs(taken - passed)) < 1e-6, f"impact {number}: {given!r}, {taken!r}, {flux!r} W/m2"
            assert flux == passed and 600 < under <= surface < gas and resistance > 0, f"impact {number}: {cooled}"
            sintered += 0 < closed < 0.6 * solid
            melted += molten > 0 and powder < rows[number - 1][5]
            # The gas acts before the weight; it takes powder of the mean conversion.
            carbon *= 1 - taken_away / mass if mass else 1
            mass -= taken_away
        if number % 4 == 3 and math.hypot(mass * 9.81 + 0.5, 0.25) >= 10:
            assert (molten, frozen, conversion, closed, resuspended) == (0,) * 5 and abs(powder / initial - 1) < 1e-12, \
                f"impact {number}: the wall holds {mass!r} kg/m2"
            assert abs(fallen / mass - 1) < 1e-12, f"impact {number}: {fallen!r} kg/m2 fell off of {mass!r}"
            mass, carbon, falls = initial, 0.0, falls + 1
        elif number % 4 == 3 and mass > 0:
            lies = molten + frozen + powder
            assert abs(lies / mass - 1) < 1e-12, f"impact {number}: {lies!r} kg/m2 lie there of {mass!r}"
            assert abs(conversion * mass - carbon) <= 1e-12 * carbon, f"impact {number}: conversion {conversion!r}"
        if velocity > 0:
            speed = films.setdefault(T_w[number], velocity / molten**2) * molten**2
            assert abs(velocity / speed - 1) < 1e-12, f"impact {number}: {velocity!r} m/s, {speed!r} by the square"
        lying, gone = [powder, solid, powder * outside, solid * outside], resuspended
    # The last gas of 4000 K melts all.
    ends = rows[-2][4] + rows[-2][10], rows[-2][5]
    # Coal slag is stiff below 1528 K.
    flowing = {temperature for temperature in T_w if temperature > 1528}
    assert min(ends) > 0 and films.keys() == flowing and len({row[0] for row in rows}) == 2, (ends, films)
    assert min(falls, sintered, melted, blown) > 2, (falls, sintered, melted, blown)
    print(f"{len(rows)} impacts in {1 + len(others)} languages, the same bits; {ends[0]:.3f} kg/m2 of slag and {ends[1]:.3f} of "
          f"powder; the deposit fell {falls} times, sintered in {sintered} steps, melted in {melted}; the gas "
          f"carried powder away {blown} times")


# --- layout -----------------------------------------------------------------------------------------------------------

def compare_layout(abi, module):
    text = pathlib.Path(abi).read_text()
    expected = re.findall(r"^(?:struct|field) (.*?)(?: align \d+)?$", text, re.MULTILINE)
    spec = importlib.util.spec_from_file_location("nearwall", module)
    nearwall = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(nearwall)
    found = []
    for name in dict.fromkeys(line.split(".")[0] for line in expected if "." in line):
        kind = getattr(nearwall, name)
        found.append(f"{name} size {ctypes.sizeof(kind)}")
        for field, _ in kind._fields_:
            at = getattr(kind, field)
            found.append(f"{name}.{field} at {at.offset} size {at.size}")
    assert found == expected, sorted(set(found) ^ set(expected))
    print(f"{len(found)} structs and fields as in abi.txt")


if __name__ == "__main__":
    {"prepare": prepare, "golden": compare_golden, "same": compare_same, "udf": compare_udf,
     "deposit": compare_deposit, "layout": compare_layout}[sys.argv[1]](*sys.argv[2:])
