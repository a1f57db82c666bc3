"""Runs nearwall and other regressions on planted laws of a dimensionless group; writes the second table of
`docs/why/peers.md`.

    validation/peers/run groups [--nearwall FILE] [--seed 11] [--nulls 6] [--jobs 1] [--out docs/why/peers.md]

Columns of each set: v_n, d, mu_p and e_n = f(group) with Gaussian noise. The base model has a constant e_n = 0.5.
"""

import argparse
import dataclasses
import itertools
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from datetime import date
from functools import partial
from pathlib import Path

import numpy as np

import diagnosis
import sindy
import sparse
import symbolic
from peers import EARLIER, GROUPS_HEADING, table, versions
from planted_set import OBSERVED, REPOSITORY, PlantedSet

DENSITY, SURFACE_TENSION = 1000.0, 0.03  # kg/m3, N/m
COLUMNS = {"v_n": (0.3, 10.0), "d": (3e-5, 5e-4), "mu_p": (0.002, 0.2)}  # m/s, m, Pa s; evenly in the logarithm
# Exponents of v_n, d, mu_p, density and surface tension.
GROUPS = {
    "We": (2, 1, 0, 1, -1),
    "Re": (1, 1, -1, 1, 0),
    "Oh": (0, -0.5, 1, -0.5, -0.5),
    "Ca": (1, 0, 1, 0, -1),
    "K": (1.25, 0.75, -0.25, 0.75, -0.5),
}
# In no method's list: a rate of strain.
FOREIGN = {"v_n/d": (1, -1, 0, 0, 0)}
EXPONENTS = GROUPS | FOREIGN
FORMS = ["power", "exponential", "logistic"]
SIZES, NOISES = [100, 300], [0.02, 0.06]
FRESH = 1000
# A column matters if shuffling it raises the squared error by this share of the largest rise.
MATTERS = 0.02
BASE = f"""[particle]
material = "oil"
[materials.oil]
density = {DENSITY}
youngs_modulus = 1e9
poisson_ratio = 0.3
yield_strength = 1e8
surface_energy = 0.03
surface_tension = {SURFACE_TENSION}
viscosity = 0.02
[walls.default]
material = "pyrex"
[normal]
model = "constant"
e_n = 0.5
[tangential]
model = "constant"
e_t = 0.7
"""


def inputs(rng, count):
    return {name: np.exp(rng.uniform(*np.log(ends), count)) for name, ends in COLUMNS.items()}


def value(group, columns):
    """The group at each row, in SI units."""
    *powers, of_density, of_tension = EXPONENTS[group]
    rest = DENSITY**of_density * SURFACE_TENSION**of_tension
    return rest * np.prod([columns[name] ** power for name, power in zip(COLUMNS, powers)], axis=0)


def drivers(group):
    return {name for name, power in zip(COLUMNS, EXPONENTS[group]) if power != 0} if group else set()


def law(rng, group, form):
    """A function of the columns with parameters drawn at random; between 0.25 and 0.8 but for the power's tail."""
    if group is None:
        return lambda columns: np.full(len(columns["v_n"]), 0.5)
    typical = value(group, inputs(rng, 10_000))
    middle = np.quantile(typical, rng.uniform(0.4, 0.6))
    if form == "power":
        # 0.5 at the middle, 0.8 at one end of the range.
        end = typical.min() if rng.random() < 0.5 else typical.max()
        exponent = np.log(0.8 / 0.5) / np.log(end / middle)
        return lambda columns: 0.5 * (value(group, columns) / middle) ** exponent
    low, rise, steepness = rng.uniform(0.25, 0.3), rng.uniform(0.4, 0.5), rng.uniform(1.5, 3)
    if form == "exponential":
        return lambda columns: low + rise * np.exp(-value(group, columns) / middle)
    return lambda columns: low + rise / (1 + (value(group, columns) / middle) ** steepness)


def shuffled(rng, columns):
    """The fresh rows four times: as they are, then with one column in another order."""
    count = len(columns["v_n"])
    order = rng.permutation(count)
    copies = [columns] + [{**columns, name: columns[name][order]} for name in columns]
    return {name: np.concatenate([copy[name] for copy in copies]) for name in columns}


def planted(rng, case, scratch):
    """A set for all methods: rows to learn from, then the fresh rows four times; and the law at the latter."""
    truth = law(rng, case["group"], case["form"])
    train, fresh = inputs(rng, case["rows"]), shuffled(rng, inputs(rng, FRESH))
    columns = {name: np.concatenate([train[name], fresh[name]]) for name in COLUMNS}
    e_n = truth(columns)
    e_n[: case["rows"]] += case["noise"] * rng.standard_normal(case["rows"])
    e_n = e_n.round(5)
    blank = np.full(len(e_n), np.nan)
    path = scratch / "set.csv"
    path.with_suffix(".toml").write_text(BASE)
    header = [*COLUMNS, "e_n"]
    rows = [[f"{x:.9g}" for x in row] for row in zip(*columns.values(), e_n)]
    measured = {name: e_n if name == "e_n" else blank for name in OBSERVED}
    predicted = {name: np.full(len(e_n), 0.5) if name == "e_n" else blank for name in OBSERVED}
    return PlantedSet(path, {}, header, rows, columns, measured, predicted), truth(fresh)


def told_groups(one):
    """The same set with the five groups as further columns."""
    return dataclasses.replace(one, columns={**one.columns, **{g: value(g, one.columns) for g in GROUPS}})


# Three times the evaluations of the first table, for more would take hours.
operon = partial(symbolic.answer, ratios=True, effort=3)
METHODS = {
    "nearwall": diagnosis.answer,
    "Operon": operon,
    "Operon, told the groups": lambda one, *rest: operon(told_groups(one), *rest),
    "PySINDY": sindy.answer,
    "lasso": sparse.answer,
}


def mattering(predicted, truth):
    """The columns whose shuffling moves the prediction away from the law of the rows as they are."""
    plain, *others = np.split(predicted, 1 + len(COLUMNS))
    error = lambda some: np.nanmean((some - truth[:FRESH]) ** 2)
    rise = {name: error(other) - error(plain) for name, other in zip(COLUMNS, others)}
    return {name for name, more in rise.items() if more > MATTERS * max(rise.values()) > 0}


def judge(case, nearwall, seed):
    """One set by every method."""
    rng = np.random.default_rng([seed, case["number"]])
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        one, truth = planted(rng, case, scratch)
        train, held_out = np.arange(case["rows"]), np.arange(case["rows"], len(one.rows))
        for name, method in METHODS.items():
            more = {"nearwall": nearwall, "scratch": scratch} if name == "nearwall" else {}
            start = time.monotonic()
            said = method(one, train, held_out, 1, **more)
            seconds = time.monotonic() - start
            # A regression that claims nothing leaves the mean.
            predicted = said.held_out.get("e_n", np.full(len(held_out), one.measured["e_n"][train].mean()))
            known = np.isfinite(predicted[:FRESH])
            results[name] = {
                "claims": any(said.claims.values()),
                "causes": said.causes,
                "columns": mattering(predicted, truth),
                "refused": int(np.sum(~known)),
                "error": np.sqrt(np.mean((predicted - truth)[:FRESH][known] ** 2)) / case["noise"],
                "seconds": seconds,
            }
    # The rule of the columns must pass the law itself.
    results["law"] = {"columns": mattering(truth, truth)}
    return case, results


def cases(nulls):
    plants = lambda groups: list(itertools.product(groups, FORMS, SIZES))
    empty = [(None, "constant", SIZES[k % 2]) for k in range(nulls)]
    every = [*plants(GROUPS), *empty, *plants(FOREIGN)]
    # 100 and 300 rows get each noise equally often.
    noise = lambda k: NOISES[(k // 2 + k) % 2]
    keys = ["group", "form", "rows", "number", "noise"]
    return [dict(zip(keys, (*case, k, noise(k)))) for k, case in enumerate(every)]


def summary(results):
    nulls = [r for r in results if r[0]["group"] is None]
    plants = [r for r in results if r[0]["group"] in GROUPS]
    foreign = [r for r in results if r[0]["group"] in FOREIGN]
    right = lambda case, said: said["claims"] and said["columns"] == drivers(case["group"])
    named = lambda case, said: said["causes"] == [f"unknown:{case['group']}"]
    claims = lambda _, said: said["claims"]

    def count(label, some, test):
        return [label, *(f"{sum(test(case, r[m]) for case, r in some)}/{len(some)}" for m in METHODS)]

    def middle(label, some, key="error", quantile=0.5):
        return [label, *(f"{np.quantile([r[m][key] for _, r in some], quantile):.2f}" for m in METHODS)]

    rows = [
        middle("error, `v_n/d`", foreign),
        count("columns right, `v_n/d`", foreign, right),
        count("nulls with a claim", nulls, claims),
        count("columns right, groups", plants, right),
        count("group named", plants, named)[:2] + [""] * (len(METHODS) - 1),
        *[middle(f"error, {form}", [r for r in plants if r[0]["form"] == form]) for form in FORMS],
        middle("error, 90 % below", plants, quantile=0.9),
        middle("seconds", results, key="seconds"),
    ]
    return table(["", *METHODS], rows)


def line(case, results):
    """One set, for the terminal."""
    said = [
        f"{name}: {'+'.join(one['causes']) or ('claims' if one['claims'] else '-')} {','.join(sorted(one['columns']))} "
        f"{one['error']:.2f} {one['seconds']:.1f}s" + (f" {one['refused']} refused" if one["refused"] else "")
        for name, one in results.items()
        if name != "law"
    ]
    what = f"{case['group']} {case['form']} {case['rows']} {case['noise']}"
    return f"{what:26} {','.join(sorted(results['law']['columns']))} | " + " | ".join(said)


def write(options, results):
    """Replaces the section of the page."""
    page = options.out.read_text().partition(GROUPS_HEADING)[0]
    packages = versions("pyoperon", "pysindy", "scikit-learn")
    text = SECTION.format(
        date=date.today(),
        seed=options.seed,
        earlier=EARLIER,
        versions=packages,
        nulls=options.nulls,
        summary=summary(results),
    )
    options.out.write_text(page + GROUPS_HEADING + text)


SECTION = """
{date}; seed {seed}; {versions}.
{earlier}
Sets of `v_n`, `d`, `mu_p` and `e_n` = f(group): We, Re, Oh, Ca, K; power, exponential, logistic; 100
and 300 rows, noise 0.02 and 0.06; {nulls} nulls; and 6 of `v_n/d`, which is in no list. Columns are
right if exactly those of the law change the prediction of 1000 fresh rows when shuffled. The error
is that against the law without noise, root mean square, divided by the noise; medians. Operon has
three times the evaluations of above; PySINDY is thresholded least squares on cubics of the logarithms.

{summary}

Groups and forms are of nearwall's own lists. Other laws it approximates by single
columns, a surface or another group: there Operon is the measure.
"""


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--nearwall", default=str(REPOSITORY / "target/release/nearwall"))
    arguments.add_argument("--seed", type=int, default=11, help="of the sets")
    arguments.add_argument("--nulls", type=int, default=6)
    arguments.add_argument("--jobs", type=int, default=1)
    arguments.add_argument("--out", type=Path, default=REPOSITORY / "docs/why/peers.md")
    options = arguments.parse_args()

    print(f"seed {options.seed}", flush=True)
    start, results = time.monotonic(), []
    with ProcessPoolExecutor(options.jobs) as pool:
        for result in pool.map(partial(judge, nearwall=options.nearwall, seed=options.seed), cases(options.nulls)):
            results.append(result)
            print(line(*result), flush=True)
    passed = sum(r["law"]["columns"] == drivers(case["group"]) for case, r in results)
    write(options, results)
    print(f"\n{summary(results)}\n\nthe law itself passes the rule of the columns on {passed} of {len(results)} sets")
    print(f"{len(results)} sets in {time.monotonic() - start:.0f} s")


if __name__ == "__main__":
    main()
