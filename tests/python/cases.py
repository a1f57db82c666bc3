"""The readers of OpenFOAM's results against foamlib, NumPy and the balance of mass. Called by tests/python/run.

    cases.py FOLDER      with the cases that `tests/openfoam/run memory recorder` leaves
"""

import pathlib
import sys

import foamlib
import numpy
import polars

import nearwall

folder = pathlib.Path(sys.argv[1])
checks = 0


def same(one, other, what, tolerance=0.0):
    global checks
    checks += 1
    one, other = numpy.asarray(one, float), numpy.asarray(other, float)
    assert one.shape == other.shape, f"{what}: {one.shape} and {other.shape}"
    assert (abs(one - other) <= tolerance * abs(other)).all(), f"{what}: {one} and {other}"


def lying_mass(faces):
    return sum(faces[column].sum() for column in ("depositedMass", "moltenMass", "frozenMass", "powderMass") if column in faces)


# Serial, restarted and on two ranks: the same numbers in path, foamlib.FoamCase, pandas and polars.
frames = {}
for name in ("recorder", "recorder-2", "recorder-restart", "memory"):
    path = folder / name
    case = nearwall.openfoam.Case(foamlib.FoamCase(path))
    cloud, = case.clouds
    assert case.path == str(path) and nearwall.openfoam.Case(path).clouds == [cloud]
    deposit = frames[name] = case.deposit()
    assert deposit.time.nunique() == 1

    # Mass: what lies on the faces is what the tables say was captured.
    floor = deposit[deposit.patch == "floor"]
    if name == "memory":
        last = case.deposits("floor").iloc[-1]
        lying = (floor.area * (floor.moltenMass + floor.frozenMass + floor.powderMass)).sum()
        same(lying, last.molten_kg + last.frozen_kg + last.powder_kg, f"{name}, deposit", 1e-9)
    else:
        last = case.totals("floor").iloc[-1]
        same((floor.area * floor.depositedMass).sum(), last.stick_mass_kg, f"{name}, deposit", 1e-9)
        same(floor.hitCount.sum(), last.hits, f"{name}, hits")
    assert lying_mass(floor) > 0, name

    # Every field of every face as foamlib reads it.
    if not list(path.glob("processor*")):
        written = foamlib.FoamCase(path)[-1]
        for column in deposit.columns[7:]:
            theirs = written[f"{cloud}:{column}"].boundary_field
            for patch, faces in deposit.groupby("patch"):
                value = theirs[patch].get("value", 0.0)
                same(faces[column], numpy.broadcast_to(numpy.asarray(value, float), len(faces)), f"{name}, {column} on {patch}")

    # A table of a run in one go, as NumPy reads it.
    tables = path / "postProcessing/nearWallInteraction" / cloud
    starts = sorted(tables.iterdir(), key=lambda start: float(start.name))
    if len(starts) == 1:
        for patch in case.patches():
            file = starts[0] / f"{patch}.dat"
            names = file.read_text().splitlines()[0].lstrip("# ").split()
            rows = numpy.loadtxt(file, ndmin=2)
            found = case.totals(patch)
            assert list(found.columns) == names, patch
            same(found, rows, f"{name}, totals of {patch}")
    else:
        times = case.balance().time_s
        assert times.is_monotonic_increasing and times.is_unique, f"{name}: the rows of {len(starts)} starts are not joined"

    injected = case.balance().iloc[-1]
    same(injected.injected_kg + injected.read_back_kg,
         injected[["airborne_kg", "stuck_in_cloud_kg", "stuck_removed_kg", "escaped_kg", "reacted_kg", "unusable_removed_kg",
                   "to_film_kg"]].sum(),
         f"{name}, balance", 1e-9)

# Two ranks lay down what one does; their faces come in another order.
order = ["patch", "x", "y", "z"]
one, two = (frames[name].sort_values(order) for name in ("recorder", "recorder-2"))
same(two.depositedMass, one.depositedMass, "two ranks", 1e-9)
same(two.area, one.area, "two ranks", 1e-12)

case = nearwall.openfoam.Case(folder / "recorder")
text = nearwall.openfoam.Case(folder / "recorder", kind="polars")
assert isinstance(text.deposit(), polars.DataFrame)
same(text.deposit()["depositedMass"], case.deposit().depositedMass, "polars")
early = case.deposit(time=0.1)
assert (early.time == 0.1).all() and early.hitCount.sum() <= case.deposit().hitCount.sum()

# The record goes into predict as it is; polars reads the same rows by itself.
impacts = case.impacts()
record = max(pathlib.Path(case.path).rglob("impacts.csv"), key=lambda file: float(file.parent.name))
rows = polars.read_csv(record, comment_prefix="#")
assert list(impacts.columns) == rows.columns and len(impacts) == len(rows) > 100
same(impacts.v_n, rows["v_n"], "v_n of the record")
assert impacts.outcome.tolist() == rows["outcome"].to_list()

for call, words in (
    (lambda: nearwall.openfoam.Case(folder / "nowhere"), "there is no such folder; give the folder of a finished OpenFOAM case"),
    (lambda: case.totals("flor"), "no table flor.dat (known here: floor"),
    (lambda: case.deposit(time=77.0), "no fields kinematicCloud:* on the walls at time 77"),
    (lambda: case.deposit(cloud="coal"), "no tables of a cloud `coal` (known here: kinematicCloud)"),
    (lambda: nearwall.openfoam.Case(folder / "memory").impacts(), "no impacts.csv; add `record { }`"),
):
    try:
        call()
    except nearwall.Error as error:
        assert words in str(error), error
        checks += 1
    else:
        raise AssertionError(f"no error with '{words}'")
print(f"{checks} comparisons with foamlib {foamlib.__version__}, NumPy, polars and the balance of mass")
