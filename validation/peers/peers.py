"""Runs nearwall, Operon and a lasso on every planted set of a folder and writes the table of `docs/why/peers.md`."""

import argparse
import platform
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor
from datetime import date
from functools import partial
from importlib.metadata import version
from pathlib import Path
from subprocess import run

import numpy as np

import diagnosis
import sparse
import symbolic
from planted_set import REPOSITORY, read

METHODS = ["nearwall", "Operon", "lasso"]
# Rows with the largest errors are left out of an error: the sets have 2 % of gross errors.
TRIM = 0.95
# Where the section of groups.py begins, and what it says of this script's table.
GROUPS_HEADING = "\n## Laws of a group\n"
EARLIER = "The table above is of an earlier version.\n"


def error(measured, predicted):
    """Root mean square of the smaller 95 % of the errors."""
    rest = np.sort(np.abs(measured - predicted)[np.isfinite(measured) & np.isfinite(predicted)])
    return float(np.sqrt(np.mean(rest[: max(1, int(TRIM * len(rest)))] ** 2))) if len(rest) else float("nan")


def judge(path, nearwall, seed):
    """One set by every method: name -> numbers of the table."""
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        one = read(path, nearwall, scratch)
        count = len(one.rows)
        train, held_out = np.arange(count * 3 // 4), np.arange(count * 3 // 4, count)
        answers, seconds = {}, {}
        for name, method in [
            ("nearwall", partial(diagnosis.answer, nearwall=nearwall, scratch=scratch)),
            ("Operon", symbolic.answer),
            ("lasso", sparse.answer),
        ]:
            start = time.monotonic()
            answers[name] = method(one, train, held_out, seed)
            seconds[name] = time.monotonic() - start

    observable, drivers = one.observable, one.driving_columns()
    before = error(one.measured[observable][held_out], one.predicted[observable][held_out])
    result = {"name": one.name, "rows": count, "null": one.is_null, "drivers": sorted(drivers), "methods": {}}
    result["planted"] = [cause["cause"] for cause in one.causes]
    for name, said in answers.items():
        column = said.column.get(observable, [])
        nothing = np.full(len(held_out), np.nan)
        after = error(one.measured[observable][held_out], said.held_out.get(observable, nothing))
        result["methods"][name] = {
            "claims": any(said.claims.values()),
            "column": column,
            "right": bool(set(column) & drivers),
            "cause": bool(said.causes) and said.causes[0] in result["planted"],
            "ratio": after / before if np.isfinite(after) else 1.0,
            "seconds": seconds[name],
        }
    return result


def share(results, method, key):
    return f"{sum(r['methods'][method][key] for r in results)} of {len(results)}"


def median(results, method):
    return f"{np.median([r['methods'][method]['ratio'] for r in results]):.2f}" if results else ""


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def summary(results):
    nulls = [r for r in results if r["null"]]
    driven = [r for r in results if r["drivers"]]
    known = [r for r in driven if not r["planted"][0].startswith("unknown:")]
    foreign = [r for r in driven if r["planted"][0].startswith("unknown:")]
    rest = [r for r in results if not r["null"] and not r["drivers"]]
    of = lambda some, key: [share(some, m, key) for m in METHODS] if some else [""] * 3
    rows = [
        ["most important column is the planted effect's", *of(driven, "right")],
        ["... a known effect", *of(known, "right")],
        ["... a column that no effect knows", *of(foreign, "right")],
        ["planted cause named first", share(driven + rest, "nearwall", "cause"), "names none", "names none"],
        ["null sets with a claim (fewer is better)", *of(nulls, "claims")],
        ["held-out error, after / before: known effect of a column", *[median(known, m) for m in METHODS]],
        ["... column that no effect knows", *[median(foreign, m) for m in METHODS]],
        ["... effect without a column of its own", *[median(rest, m) for m in METHODS]],
        ["... null sets", *[median(nulls, m) for m in METHODS]],
    ]
    return table(["", *METHODS], rows)


def families(results):
    """One line for each family of sets: right column and median ratio."""
    groups = defaultdict(list)
    for r in results:
        groups[r["name"].split(":")[0]].append(r)
    rows = []
    for family, some in groups.items():
        null = some[0]["null"]
        driven = [r for r in some if r["drivers"]]
        columns = [f"`{d}`" for d in sorted({d for r in driven for d in r["drivers"]})]
        if len(driven) < len(some):
            columns.append("none" if null else "every impact")
        counted = some if null else driven
        counts = [sum(r["methods"][m]["claims" if null else "right"] for r in counted) for m in METHODS]
        count = [f"{n}; " if counted else "" for n in counts]
        cells = [n + median(some, m) for m, n in zip(METHODS, count)]
        rows.append([f"`{family}`", len(some), ", ".join(columns), *cells])
    return table(["family", "sets", "planted in", *METHODS], rows)


PAGE = """# Peers: other regressions beside `nearwall diagnose`

Written by two commands, not by CI:

```sh
NEARWALL_TEST_SEED={set_seed} NEARWALL_PLANTED_OUT=SETS cargo test --release --test planted_effects -- --ignored write_sets
validation/peers/run SETS --set-seed {set_seed}
validation/peers/run groups
```

## Planted effects

{date}; {count} sets; seed {seed} of the methods; {versions}.

Each set is a CSV file and a base model without the planted effect; the last quarter of the rows is
held out. Operon (genetic programming, formulas of up to 30 symbols) and a lasso on a library of terms
(powers, roots, logarithms, inverses, products, labels, each also times the base prediction) regress
what the base model leaves; `nearwall diagnose` runs as it is. A regression claims something if it
beats a constant by one standard error of its five-fold cross-validation. The most important column is
the one whose shuffling raises the error most, for nearwall those of its first finding. The error is
the root mean square of the smaller 95 % of the held-out errors, divided by that of the base model.

{summary}

nearwall is told the candidate laws, and all planted effects but the unknown columns have a relative
among them, so its silence on null sets costs little power. The peers must find shape and column at
once: where the law is in no library, they are the measure.
"""


def versions(*packages):
    command = ["git", "-C", str(REPOSITORY), "rev-parse", "--short", "HEAD"]
    revision = run(command, capture_output=True, text=True).stdout.strip()
    listed = ", ".join(f"{name} {version(name)}" for name in packages)
    return f"nearwall {revision}, {listed}, Python {platform.python_version()}"


def line(result):
    """One set, for the terminal."""
    said = [
        f"{name} {','.join(one['column']) if one['claims'] else '-'} {one['ratio']:.2f} {one['seconds']:.1f}s"
        for name, one in result["methods"].items()
    ]
    return f"{result['name']:42} {','.join(result['drivers']) or '-':24} " + "; ".join(said)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("sets", type=Path, help="folder with NAME.csv, NAME.toml and NAME.truth.json")
    arguments.add_argument("--nearwall", default=str(REPOSITORY / "target/release/nearwall"))
    arguments.add_argument("--out", type=Path, default=REPOSITORY / "docs/why/peers.md")
    arguments.add_argument("--seed", type=int, default=1, help="of the methods")
    arguments.add_argument("--set-seed", default="SEED", help="NEARWALL_TEST_SEED of the sets, for the page")
    arguments.add_argument("--jobs", type=int, default=2)
    options = arguments.parse_args()

    paths = sorted(path for path in options.sets.glob("*.csv"))
    start, results = time.monotonic(), []
    with ProcessPoolExecutor(options.jobs) as pool:
        for result in pool.map(partial(judge, nearwall=options.nearwall, seed=options.seed), paths):
            results.append(result)
            print(line(result), flush=True)

    text = PAGE.format(
        date=date.today(),
        count=len(results),
        seed=options.seed,
        set_seed=options.set_seed,
        versions=versions("pyoperon", "scikit-learn", "numpy"),
        summary=summary(results),
    )
    # The section of groups.py stays.
    before = options.out.read_text() if options.out.exists() else ""
    section = before[before.find(GROUPS_HEADING) :].replace(EARLIER, "") if GROUPS_HEADING in before else ""
    options.out.write_text(text + section)
    print(f"\n{families(results)}\n\n{summary(results)}\n\n{len(results)} sets in {time.monotonic() - start:.0f} s; wrote {options.out}")


if __name__ == "__main__":
    main()
