"""Computes again, by other means, what the tutorials in other codes have written.

    check.py lammps|codeSaturne RUNS TUTORIAL NEARWALL

One line each: ok or FAIL.
"""

import csv
import glob
import subprocess
import sys
import tempfile

import numpy

import nearwall

code, runs, tutorial, command = sys.argv[1:5]
failures = 0


def say(name, good, text):
    global failures
    failures += not good
    print(f"{'ok  ' if good else 'FAIL'} {code}, {name}: {text}")


def read(pattern):
    """The columns of one or more tables, rows in an order that does not depend on files."""
    rows = []
    for path in sorted(glob.glob(pattern)):
        with open(path) as file:
            rows += list(csv.DictReader(file))
    rows.sort(key=lambda row: tuple(row.values()))
    if not rows:
        sys.exit(f"FAIL {code}: no rows in {pattern}")
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def total(path):
    return {name: float(values[0]) for name, values in read(path).items()}


def same_impacts(serial, parallel):
    shared = all(numpy.array_equal(serial[name], parallel[name]) for name in serial)
    say("impacts on 2 ranks", shared,
        f"{len(serial['v_n'])} in serial, {len(parallel['v_n'])} on 2 ranks, equal bits: {shared}")


def both_ranks_are_hit(folder):
    """A rank without impacts would leave the exchange between ranks untested."""
    rows = []
    for path in sorted(glob.glob(f"{folder}/impacts.*.csv")):
        with open(path) as file:
            rows.append(len(file.readlines()) - 1)
    say("impacts of each rank", len(rows) == 2 and min(rows) >= 100, " + ".join(map(str, rows)))


def predicted(name, model, pattern):
    """`nearwall predict` on the recorded impacts, and the mean of the draws."""
    impacts = read(pattern)
    inputs = [column for column in impacts if column in nearwall.INPUTS]
    with tempfile.TemporaryDirectory() as folder:
        with open(f"{folder}/in.csv", "w") as file:
            print(",".join(inputs), file=file)
            for row in zip(*(impacts[column] for column in inputs)):
                print(",".join(repr(float(value)) for value in row), file=file)
        subprocess.run([command, "predict", "--model", model, f"{folder}/in.csv", "-o", f"{folder}/out.csv"],
                       check=True, capture_output=True)
        with open(f"{folder}/out.csv") as file:
            rows = list(csv.DictReader(file))
    pairs = (("e_n", "e_n_found"), ("e_t", "e_t_found"), ("p_stick", "p_found"))
    off = max(abs(float(row[new]) - found) for new, old in pairs for row, found in zip(rows, impacts[old]))
    say(f"{name}, nearwall predict", off < 1e-12, f"{len(rows)} impacts, e_n, e_t and p_stick off by at most {off:.1e}")
    p, captures = impacts["p_found"], int(impacts["stuck"].sum())
    error = numpy.sqrt((p * (1 - p)).sum())
    say(f"{name}, draws", abs(captures - p.sum()) <= 4 * error,
        f"{captures} captured, {p.sum():.1f} ± {error:.1f} expected")
    return impacts, inputs


def drawn(name, model, impacts, inputs, keys):
    columns = {column: impacts[column] for column in inputs}
    out = nearwall.Model.from_file(model).resolve(seed=1, key=keys, **columns)
    same = numpy.array_equal(out.stuck, impacts["stuck"])
    distinct = len(set(keys.tolist())) == len(keys)
    say(f"{name}, keys", same and distinct,
        f"{len(keys)} distinct: {distinct}; the same captures through Python: {same}")


def balance(name, totals, parts, released="mass_released"):
    residual = abs(totals[released] - sum(totals[part] for part in parts)) / totals[released]
    say(f"{name}, mass", residual < 1e-12, f"{totals[released]:.6e} kg released, residual {residual:.1e} of it")


def lammps():
    model = f"{tutorial}/nearWall.toml"
    serial = read(f"{runs}/plate-1/impacts.*.csv")
    same_impacts(serial, read(f"{runs}/plate-2/impacts.*.csv"))
    both_ranks_are_hit(f"{runs}/plate-2")
    for ranks in (1, 2):
        totals = total(f"{runs}/plate-{ranks}/totals.csv")
        impacts, final = read(f"{runs}/plate-{ranks}/impacts.*.csv"), read(f"{runs}/plate-{ranks}/final.*.csv")
        counted = (len(impacts["v_n"]), int(impacts["stuck"].sum()))
        by_code = (totals["hits"], totals["captured"])
        at_end = (final["hits"].sum(), (final["type"] == 2).sum())
        good = counted == by_code == at_end and len(final["id"]) == totals["released"]
        say(f"{ranks} ranks, counts", good, f"{counted[0]} hits and {counted[1]} captures; counted by LAMMPS "
            f"{by_code[0]:.0f} and {by_code[1]:.0f}")
        balance(f"{ranks} ranks", totals, ["mass_captured", "mass_flying"])
    impacts, inputs = predicted("serial", model, f"{runs}/plate-1/impacts.*.csv")
    number, hit = impacts["id"].astype(numpy.uint64), impacts["hit"].astype(numpy.uint64)
    drawn("serial", model, impacts, inputs, number << numpy.uint64(16) | hit)

    # First landing in closed form: fall through gas at rest with drag in proportion to the speed.
    tau, g, box = 0.05, 9.81, 0.2
    release = read(f"{runs}/plate-1/release.csv")
    order = numpy.argsort(release["id"])
    first = impacts["hit"] == 0
    start = {name: values[order][impacts["id"][first].astype(int) - 1] for name, values in release.items()}
    height = lambda t: start["z"] + (start["vz"] + g * tau) * tau * (1 - numpy.exp(-t / tau)) - g * tau * t
    low, high = numpy.zeros(first.sum()), numpy.full(first.sum(), 10.0)
    for _ in range(80):
        middle = 0.5 * (low + high)
        above = height(middle) > 0
        low, high = numpy.where(above, middle, low), numpy.where(above, high, middle)
    place = (start["x"] + start["vx"] * tau * (1 - numpy.exp(-low / tau))) % box
    away = abs(place - impacts["x"][first] % box)
    away = numpy.minimum(away, box - away)
    speed = abs((start["vz"] + g * tau) * numpy.exp(-low / tau) - g * tau)
    slower = abs(speed - impacts["v_n"][first]).max()
    say("first landing", first.sum() == len(order) and away.max() < 2e-4 and slower < 1e-2,
        f"{first.sum()} particles, off by at most {1e3 * away.max():.3f} mm and {slower:.4f} m/s")


def watt_fereday(T):
    """Probability of capture by viscosity, from the composition of fly-ash and code_saturne's formula."""
    five = (49.2 + 28.4 + 11.1 + 2.1 + 0.8) / 100
    silica, alumina, iron, lime = 49.2 / five, 28.4 / five, 11.1 / five, 2.1 / five
    slope = 0.00835 * silica + 0.00601 * alumina - 0.109
    intercept = 0.0415 * silica + 0.0192 * alumina + 0.0276 * iron + 0.016 * lime - 3.92
    return numpy.minimum(1, 100 / (0.1 * 10 ** (1e7 * slope / (T - 423.15) ** 2 + intercept)))


def code_saturne():
    serial = read(f"{runs}/nearWall-1/impacts.*.csv")
    same_impacts(serial, read(f"{runs}/nearWall-2/impacts.*.csv"))
    both_ranks_are_hit(f"{runs}/nearWall-2")
    parts = ["mass_walls", "mass_left", "mass_airborne"]
    for name in ("nearWall-1", "nearWall-2", "elastic-1", "fouling-1"):
        totals = total(f"{runs}/{name}/totals.csv")
        balance(name, totals, parts)
        if name.startswith("fouling"):
            continue
        impacts = read(f"{runs}/{name}/impacts.*.csv")
        counted = (len(impacts["v_n"]), int(impacts["stuck"].sum()))
        good = counted == (totals["hits"], totals["deposited"]) and totals["lost"] == 0
        mass = abs(impacts["mass"][impacts["stuck"] == 1].sum() / totals["mass_walls"] - 1)
        say(f"{name}, counts", good and mass < 1e-12,
            f"{counted[0]} hits and {counted[1]} captures, {totals['deposited']:.0f} counted by code_saturne; "
            f"their mass off by {mass:.1e}")

    # Where nothing sticks and nothing is lost, these walls are code_saturne's own, which counts its hits itself.
    ours, own = total(f"{runs}/rebound-1/totals.csv"), total(f"{runs}/ownRebound-1/totals.csv")
    same = all(ours[name] == own[name] for name in ("released", "left", "airborne", *parts))
    same = same and ours["hits"] == own["own_hits"]
    say("rebound without loss", same,
        f"{ours['hits']:.0f} hits, {own['own_hits']:.0f} of code_saturne's own wall; all else equal: {same}")

    for name in ("nearWall", "elastic"):
        model = f"{tutorial}/DATA/{name}.toml"
        impacts, inputs = predicted(name, model, f"{runs}/{name}-1/impacts.*.csv")
        identity = zip(impacts["number"], impacts["hit"])
        keys = numpy.array([nearwall.key_of_values(*values) for values in identity], numpy.uint64)
        drawn(name, model, impacts, inputs, keys)
        if name == "elastic":
            off = abs(impacts["p_found"] - watt_fereday(impacts["T_p"])).max()
            say("Watt-Fereday", off < 1e-9, f"p_stick off by at most {off:.1e}")

    # Flights do not depend on captures, so that those of `rebound` say what code_saturne's fouling model must capture.
    flights = read(f"{runs}/rebound-1/impacts.*.csv")
    order = numpy.lexsort((flights["hit"], flights["number"]))
    number, p = flights["number"][order], watt_fereday(flights["T_p"][order])
    draw = numpy.random.default_rng(1)
    counts = []
    for _ in range(200):
        sticks = draw.random(len(p)) < p
        earlier = numpy.cumsum(sticks) - sticks
        begins = numpy.flatnonzero(numpy.r_[True, number[1:] != number[:-1]])
        before = numpy.repeat(earlier[begins], numpy.diff(numpy.r_[begins, len(p)]))
        meets = earlier == before
        counts.append((meets.sum(), (meets & sticks).sum()))
    mean, error = numpy.mean(counts, axis=0), numpy.std(counts, axis=0)
    found = total(f"{runs}/fouling-1/totals.csv")
    off = numpy.abs(numpy.array([found["own_hits"], found["fouled"]]) - mean) / error
    say("code_saturne's fouling", off.max() < 5,
        f"{found['own_hits']:.0f} hits and {found['fouled']:.0f} captures, {mean[0]:.0f} ± {error[0]:.0f} "
        f"and {mean[1]:.0f} ± {error[1]:.0f} expected")

    # Flights to the first hit, integrated again with steps of 2 us and the same drag law.
    first = serial["hit"] == 0
    turns = lambda n, axis: 0.5 + n * 1.1673039782614187 ** -(axis + 1.0)
    spread = lambda n, axis, low, high: low + (high - low) * numpy.modf(turns(n, axis))[0]
    every = spread(numpy.arange(1, 4001.0), 2, 20e-6, 120e-6)
    n = 1.0 + numpy.abs(every[None, :] - serial["d"][first][:, None]).argmin(axis=1)
    slope, speed, d = numpy.radians(spread(n, 0, -60, 60)), spread(n, 1, 3, 15), spread(n, 2, 20e-6, 120e-6)
    x, z = numpy.zeros(len(n)), 0.0225 + spread(n, 4, -2e-3, 2e-3)
    u, w = speed * numpy.cos(slope), speed * numpy.sin(slope)
    gas, viscosity, gas_density = 5.0, 5.8e-5, 0.21967
    landed = numpy.full(len(n), numpy.nan)

    def drag(u, w):
        reynolds = gas_density * numpy.hypot(gas - u, w) * d / viscosity
        rate = 18 * viscosity / (2070 * d * d) * (1 + 0.15 * reynolds ** 0.687)
        return rate * (gas - u), -rate * w

    step = 1e-5
    for _ in range(6000):
        a, b = drag(u, w)
        middle = u + 0.5 * step * a, w + 0.5 * step * b
        a, b = drag(*middle)
        x, z, u, w = x + step * middle[0], z + step * middle[1], u + step * a, w + step * b
        hit = numpy.isnan(landed) & ((z <= 0) | (z >= 0.04))
        landed[hit] = x[hit]
    off = abs(landed - serial["x"][first])
    typical, most = numpy.median(off), numpy.quantile(off, 0.95)
    say("first landing", bool(numpy.isfinite(landed).all()) and typical < 2e-4 and most < 3e-3,
        f"{len(n)} flights of up to 240 mm, half within {1e3 * typical:.2f} mm, 95 % within {1e3 * most:.2f} mm")


lammps() if code == "lammps" else code_saturne()
sys.exit(failures > 0)
