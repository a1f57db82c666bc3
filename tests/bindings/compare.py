"""What the examples in bindings/ have to agree on. Called by tests/bindings/run.

    compare.py prepare TABLE SHARE FOLDER   models and impacts of the golden table, and a grid of impacts on one model
    compare.py golden TABLE OUTPUT          e_n of an example against the golden table
    compare.py same OUTPUT OUTPUT           two examples, bit for bit
    compare.py udf OUTPUT UDF IMPACTS...    velocities of the user-defined wall against e_n and e_t of an example
    compare.py deposit IMPACTS OUTPUT OUTPUT...   deposit.c and the same in other languages, bit for bit; what arrived lies there
    compare.py layout ABI MODULE            structs, numbers and functions of nearwall.f90 or nearwall.py against abi.txt
    compare.py named ABI HEADER             every function of abi.txt is called in nearwall.hpp
"""

import csv
import ctypes
import importlib.util
import itertools
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
        # The wall draws with the particle's number and hits, the examples with the row: chance may fall otherwise.
        assert ended == p if p in (0, 1) else ended in (0, 1), f"impact {number}: p {p}, ended {ended}"
        drawn += 0 < p < 1
        ends += ended == 1
        if ended == 0:
            rebounds += 1
            assert bits((away, along)) == bits((e_n * v_n, e_t * v_t)), f"impact {number}: {away!r}, {along!r}"
    assert rebounds > 300 and ends > 300 and drawn > 50, (rebounds, ends, drawn)
    print(f"{rebounds} rebounds with the same bits, {ends} ends, {drawn} by chance")


def compare_deposit(impacts, output, *others):
    """By hand: the mass and carbon of what stayed are there, and a laminar film's speed goes with its thickness squared (Nusselt)."""
    rows = outcomes(output)
    for other in others:
        theirs = outcomes(other)
        assert len(rows) == len(theirs), f"{len(rows)} and {len(theirs)} impacts"
        for number, (one, another) in enumerate(zip(rows, theirs)):
            assert bits(one) == bits(another), f"{other}, impact {number}: {one} and {another}"
    T_w = [float(line.split(",")[4]) for line in pathlib.Path(impacts).read_text().splitlines()[1:]]
    assert len(T_w) == len(rows) == 960, len(rows)
    # The wall begins with 10 um of the model's fly ash, of 2300 kg/m3 and with 0.4 voids.
    mass, carbon, films = 1e-5 * (1 - 0.4) * 2300, 0.0, {}
    for number, (stuck, _, coverage, _, molten, powder, _, _, conversion, velocity) in enumerate(rows):
        mass += stuck * (1 + number % 7) / 1024
        carbon += stuck * (1 + number % 7) / 1024 * (0.5 if number % 2 else 1)
        assert 0 < coverage <= 1
        if number % 4 == 3:
            assert abs((molten + powder) / mass - 1) < 1e-12, f"impact {number}: {molten + powder!r} kg/m2 lie there of {mass!r}"
            assert abs(conversion * mass / carbon - 1) < 1e-12 or carbon == 0, f"impact {number}: conversion {conversion!r}"
        if velocity > 0:
            speed = films.setdefault(T_w[number], velocity / molten**2) * molten**2
            assert abs(velocity / speed - 1) < 1e-12, f"impact {number}: {velocity!r} m/s, {speed!r} by the square"
    ends = rows[-1][4], rows[-1][5]
    assert min(ends) > 0 and len(films) > 2 and len({row[0] for row in rows}) == 2, (ends, films)
    print(f"{len(rows)} impacts in {1 + len(others)} languages, the same bits; {ends[0]:.3f} kg/m2 of melt and {ends[1]:.3f} of powder")


# --- layout -----------------------------------------------------------------------------------------------------------

# Functions that nearwall.py and nearwall.hpp do without, and why.
LEFT_OUT = {
    "nearwall.py": {
        "nw_resolve": "Model.resolve hands arrays over, also for one impact",
        "nw_outcome_init": "no struct for a single outcome",
        "nw_regime_name": "REGIMES has the names",
    },
    "nearwall.hpp": {"nw_regime_name": "needs no C++ of its own"},
}

SIZES = {"integer(c_int32_t)": 4, "real(c_double)": 8, "integer(c_int64_t)": 8, "integer(c_size_t)": 8, "type(c_ptr)": 8}


def read_abi(path):
    """Structs as {name: [size, (field, offset, size)...]}, numbers, and functions with how many arguments they have."""
    structs, numbers, functions = {}, {}, {}
    for line in pathlib.Path(path).read_text().splitlines():
        kind, _, rest = line.partition(" ")
        if kind == "number":
            name, value = rest.split()
            numbers[name] = int(value)
        elif kind == "struct":
            name, size = re.fullmatch(r"(\w+) size (\d+) align \d+", rest).groups()
            structs[name] = [int(size)]
        elif kind == "field":
            name, field, offset, size = re.fullmatch(r"(\w+)\.(\w+) at (\d+) size (\d+)", rest).groups()
            structs[name].append((field, int(offset), int(size)))
        elif kind == "function":
            name, arguments = re.fullmatch(r".*?(\w+)\((.*)\)", rest).groups()
            functions[name] = 0 if arguments == "void" else len(arguments.split(","))
    assert len(structs) == 6 and len(numbers) > 10 and len(functions) > 15, "abi.txt is not what this script reads"
    return structs, numbers, functions


def fortran(path):
    text = re.sub(r"!.*", "", pathlib.Path(path).read_text())
    structs, numbers, functions = {}, {}, {}
    for name, body in re.findall(r"type, bind\(c\) :: (\w+)\n(.*?)end type", text, re.DOTALL):
        fields, end = [], 0
        for kind, names in re.findall(r"(\S+) :: (.*)", body):
            for field in names.split(","):
                size = SIZES[kind]
                start = -(-end // size) * size
                fields.append((field.split("=")[0].strip(), start, size))
                end = start + size
        structs[name] = [-(-end // 8) * 8] + fields
        for size in re.findall(r"struct_size = (\d+)", body):
            assert int(size) == structs[name][0], f"{name}: struct_size {size}, {structs[name][0]} bytes"
    for line in re.findall(r"integer\(c_int32_t\), parameter :: (.*)", text):
        numbers.update((name, int(value)) for name, value in re.findall(r"(\w+) = (\d+)", line))
    numbers["NW_ABI_VERSION"] = numbers.pop("NEARWALL_ABI_VERSION")  # Fortran has a function of that name
    for name, arguments in re.findall(r"(?:function|subroutine) (nw_\w+)\((.*?)\) bind\(c\)", text):
        functions[name] = len([argument for argument in arguments.split(",") if argument])
    return structs, numbers, functions


def python(path):
    spec = importlib.util.spec_from_file_location("nearwall", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    structs = {}
    for name, kind in module.STRUCTS.items():
        fields = [(field, getattr(kind, field)) for field, _ in kind._fields_]
        structs[name] = [ctypes.sizeof(kind)] + [(field, at.offset, at.size) for field, at in fields]
    numbers = {"NW_ABI_VERSION": module.ABI_VERSION, "NW_OK": module.OK,
               "NW_OUTSIDE_VALID_RANGE": module.OUTSIDE_VALID_RANGE}
    numbers.update(("NW_" + name.replace("-", "_"), number) for number, name in enumerate(module.REGIMES))
    # What the module looked up in the library, each with its arguments.
    functions = {name: len(function.argtypes or ()) for name, function in vars(module._library).items() if name.startswith("nw_")}
    return structs, numbers, functions


def compare_layout(abi, module):
    structs, numbers, functions = read_abi(abi)
    for name in LEFT_OUT.get(pathlib.Path(module).name, ()):
        del functions[name]
    whole = module.endswith(".f90")
    their_structs, their_numbers, their_functions = (fortran if whole else python)(module)
    for kind, ours, theirs in (("struct", structs, their_structs), ("number", numbers, their_numbers),
                               ("function", functions, their_functions)):
        assert theirs, f"no {kind} found"
        if whole or kind == "function":
            assert set(ours) == set(theirs), f"{kind}: {sorted(set(ours) ^ set(theirs))}"
        for name, value in theirs.items():
            assert ours.get(name) == value, f"{kind} {name}: abi.txt {ours.get(name)}, here {value}"
    print(f"{len(their_structs)} structs, {len(their_numbers)} numbers, {len(their_functions)} functions as in abi.txt")


def compare_named(abi, header):
    _, _, functions = read_abi(abi)
    left_out = LEFT_OUT[pathlib.Path(header).name]
    code = re.sub(r"//.*", "", pathlib.Path(header).read_text())
    called = {name for name in functions if re.search(rf"\b{name}\(", code)}
    assert called == set(functions) - set(left_out), sorted(called ^ (set(functions) - set(left_out)))
    print(f"{len(called)} functions, without {', '.join(left_out)}")


if __name__ == "__main__":
    {"prepare": prepare, "golden": compare_golden, "same": compare_same, "udf": compare_udf,
     "deposit": compare_deposit, "layout": compare_layout, "named": compare_named}[sys.argv[1]](*sys.argv[2:])
