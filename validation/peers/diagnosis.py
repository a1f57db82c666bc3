"""`nearwall diagnose` on the same rows; the held-out rows are predicted by its extended.toml."""

import csv
import json
import subprocess

from planted_set import OBSERVED, predict
from regression import Answer


def answer(one, train, held_out, seed, nearwall, scratch):
    source, out = scratch / "train.csv", scratch / "out"
    with open(source, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(one.header)
        writer.writerows(one.rows[k] for k in train)
    model = one.path.with_suffix(".toml")
    command = [nearwall, "diagnose", str(source), "--model", str(model), "--out", str(out), "--seed", str(seed)]
    run = subprocess.run(command, capture_output=True, text=True)
    result = Answer()
    if run.returncode != 0:
        return result
    said = json.loads((out / "diagnosis.json").read_text())
    result.causes = [finding["cause"] for finding in said["findings"]]
    for finding in said["findings"]:
        columns = finding["variables"] or [finding["cause"].removeprefix("unknown:")]
        # A cause may act on all observables.
        for observable in OBSERVED:
            result.claims[observable] = True
            result.column.setdefault(observable, columns)
    rows = [one.rows[k] for k in held_out]
    result.held_out = predict(nearwall, out / "extended.toml", one.header, rows, scratch)
    return result
