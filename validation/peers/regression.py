"""What both regressions share: residuals, folds, the verdict of the cross-validation, the most important column."""

from dataclasses import dataclass, field

import numpy as np

FOLDS = 5
# With fewer values an observable is left alone.
FEWEST = 30
# Residuals beyond this many robust deviations are pulled in: gross errors.
CLIP = 6.0


@dataclass
class Answer:
    """What a method says of one set."""

    claims: dict = field(default_factory=dict)  # observable -> whether it claims to beat the base
    column: dict = field(default_factory=dict)  # observable -> columns it holds responsible
    held_out: dict = field(default_factory=dict)  # observable -> prediction of the held-out rows
    causes: list = field(default_factory=list)  # named effects (nearwall only)


def residuals(one, observable, rows):
    """Rows with a value and what the base model leaves of them, gross errors pulled in; `None` if too few."""
    rest = (one.measured[observable] - one.predicted[observable])[rows]
    seen = rows[np.isfinite(rest)]
    rest = rest[np.isfinite(rest)]
    if len(rest) < FEWEST or np.ptp(rest) == 0:
        return None
    if observable == "outcome":
        # A class of a handful of rows has nothing to learn from.
        few = min(np.sum(one.measured["outcome"][seen] == kind) for kind in (0, 1)) < 10
        return None if few else (seen, rest)
    middle = np.median(rest)
    reach = CLIP * 1.4826 * np.median(np.abs(rest - middle))
    return seen, np.clip(rest, middle - reach, middle + reach) if reach > 0 else rest


def folds(count, seed):
    order = np.random.default_rng(seed).permutation(count)
    return [np.sort(part) for part in np.array_split(order, FOLDS)]


def beats_mean(errors, errors_of_mean):
    """Whether the squared error over the folds is below that of a constant by more than its standard error."""
    gain = np.asarray(errors_of_mean) - np.asarray(errors)
    return bool(gain.mean() > gain.std(ddof=1) / np.sqrt(len(gain)))


def numbers(one):
    """Numeric columns, blanks at the median."""
    filled = {}
    for name, values in one.columns.items():
        if values.dtype.kind == "f":
            filled[name] = np.where(np.isfinite(values), values, np.nanmedian(values))
    return filled


def labels(one):
    """One-hot columns: (column, label) -> 0 or 1."""
    texts = {name: values for name, values in one.columns.items() if values.dtype.kind != "f"}
    pairs = [(name, word) for name, values in texts.items() for word in sorted(set(values))]
    flags = {(name, word): (texts[name] == word).astype(float) for name, word in pairs}
    return {key: flag for key, flag in flags.items() if flag.sum() > 4}


def most_important(names, design, predict, target, seed):
    """The column of `names` whose shuffling raises the squared error most.

    `design` makes the features; it takes the new order of each column that is shuffled.
    """
    rng = np.random.default_rng(seed)
    plain = np.mean((target - predict(design({}))) ** 2)
    order = rng.permutation(len(target))
    error = lambda name: np.mean((target - predict(design({name: order}))) ** 2)
    rise = {name: error(name) - plain for name in sorted(set(names))}
    best = max(rise, key=rise.get)
    return best if rise[best] > 0 else None
