"""A planted set: its rows, the prediction of its base model, and what was planted."""

import csv
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

OBSERVED = ["e_n", "e_t", "outcome"]
REPOSITORY = Path(__file__).resolve().parents[2]

# The inputs of the effects that have some (src/effect/); the others act on every impact.
INPUTS = {
    "conversion-decline": ["conversion"],
    "conversion-transition": ["conversion"],
    "dry-on-melt": ["v_n", "d", "T_w"],
    "gas-lift": ["v_gas", "v_t"],
    "liquid-film": ["film_thickness", "v_n", "d"],
    "melting-transition": ["T_p"],
    "micro-roughness": ["v_t", "v_n"],
    "oblique-angle": ["v_t", "v_n"],
    "powder-layer": ["layer_thickness"],
    "size-dependent-yield": ["d"],
    "sliding-to-rolling": ["v_t", "v_n"],
    "strain-rate-hardening": ["v_n"],
    "tangential-compliance": ["v_t", "v_n"],
    "thermal-softening": ["T_p"],
    "viscoelastic-loss": ["v_n"],
}

@dataclass
class PlantedSet:
    """Rows that can be used, in the order of the file."""

    path: Path
    truth: dict
    header: list
    rows: list  # cells of each row
    columns: dict  # possible causes: name -> array of numbers or of labels
    measured: dict  # observable -> array, NaN where blank; outcome: 1 captured, 0 rebound
    predicted: dict  # the same by the base model; outcome: probability of capture

    @property
    def name(self):
        return self.truth["name"]

    @property
    def causes(self):
        return self.truth["causes"]

    @property
    def is_null(self):
        return not self.causes

    @property
    def observable(self):
        """The observable by which the first plant is judged."""
        stated = self.causes[0].get("observable", "e_n") if self.causes else "e_n"
        return "outcome" if stated == "stick" else stated

    def driving_columns(self):
        """The columns on which the plants turn; empty if no column drives them."""
        return {c for cause in self.causes for c in cause.get("inputs") or driving(cause["cause"])}


def driving(cause):
    if cause.startswith("unknown:"):
        return [cause.removeprefix("unknown:")]
    return INPUTS.get(cause, [])


def number(cell):
    try:
        return float(cell)
    except ValueError:
        return float("nan")


def predict(nearwall, model, header, rows, scratch):
    """Prediction of each row by a model file: observable -> array, NaN where the model refuses the row."""
    unseen = [i for i, name in enumerate(header) if name not in OBSERVED and not name.endswith("_err")]
    source, target = scratch / "inputs.csv", scratch / "predicted.csv"
    with open(source, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow([header[i] for i in unseen] + ["row"])
        writer.writerows([row[i] for i in unseen] + [k] for k, row in enumerate(rows))
    command = [nearwall, "predict", "--model", str(model), str(source), "-o", str(target)]
    subprocess.run(command, check=True, capture_output=True)
    values = {name: np.full(len(rows), np.nan) for name in OBSERVED}
    with open(target, newline="") as file:
        for row in csv.DictReader(file):
            at = int(row["row"])
            values["e_n"][at], values["e_t"][at] = number(row["e_n"]), number(row["e_t"])
            values["outcome"][at] = number(row["p_stick"])
    return values


def read(path, nearwall, scratch):
    """The set whose CSV file is `path`; rows with a malformed cell are left out."""
    stem = path.with_suffix("")
    truth = json.loads(Path(f"{stem}.truth.json").read_text())
    with open(path, newline="") as file:
        lines = list(csv.reader(line for line in file if not line.startswith("#")))
    header, rows = lines[0], [row for row in lines[1:] if len(row) == len(lines[0])]
    numeric = {name for i, name in enumerate(header) if is_numeric([row[i] for row in rows])}
    rows = [row for row in rows if is_usable(header, row, numeric)]
    predicted = predict(nearwall, f"{stem}.toml", header, rows, scratch)
    keep = [k for k in range(len(rows)) if np.isfinite(predicted["outcome"][k])]
    rows = [rows[k] for k in keep]
    predicted = {name: values[keep] for name, values in predicted.items()}

    columns, measured = {}, {name: np.full(len(rows), np.nan) for name in OBSERVED}
    for i, name in enumerate(header):
        cells = [row[i] for row in rows]
        if name == "outcome":
            measured[name] = np.array([outcome(cell) for cell in cells])
        elif name in OBSERVED:
            measured[name] = np.array([number(cell) for cell in cells])
        elif not name.endswith("_err") and len(set(cells)) > 1:
            columns[name] = np.array([number(c) for c in cells]) if name in numeric else np.array(cells)
    return PlantedSet(path, truth, header, rows, columns, measured, predicted)


def is_numeric(cells):
    filled = [cell for cell in cells if cell.strip()]
    return len(filled) > 0 and sum(np.isfinite(number(cell)) for cell in filled) > 0.9 * len(filled)


def is_usable(header, row, numeric):
    """Whether every filled cell is what its column holds, and v_n, d and e_n are possible."""
    cells = dict(zip(header, row))
    readable = all(np.isfinite(number(c)) for n, c in cells.items() if n in numeric and c.strip())
    possible = number(cells["v_n"]) >= 0 and not number(cells.get("d", "1")) <= 0
    return readable and possible and not number(cells.get("e_n", "0")) < 0


def outcome(cell):
    return {"stick": 1.0, "stuck": 1.0, "rebound": 0.0, "bounce": 0.0}.get(cell.strip().lower(), float("nan"))
