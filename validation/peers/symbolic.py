"""Symbolic regression by Operon: a formula of the columns for what the base model leaves."""

import numpy as np
from pyoperon.sklearn import SymbolicRegressor

from planted_set import OBSERVED
from regression import Answer, beats_mean, folds, labels, most_important, numbers, residuals


def regressor(seed, effort):
    return SymbolicRegressor(
        allowed_symbols="add,sub,mul,div,exp,log,sqrt,square,constant,variable",
        population_size=500,
        generations=100 * effort,
        max_evaluations=25_000 * effort,
        max_length=30,
        optimizer_iterations=3,
        model_selection_criterion="minimum_description_length",
        n_threads=1,
        random_state=seed,
    )


def fit(x, y, seed, effort=1):
    """A function of the features; a constant where the formula is none or leaves the numbers."""
    mean = y.mean()
    if len(set(y)) < 2:
        return lambda new: np.full(len(new), mean)
    model = regressor(seed, effort).fit(x, y)
    reach = 3 * np.ptp(y)

    def predict(new):
        with np.errstate(all="ignore"):
            values = np.asarray(model.predict(np.ascontiguousarray(new)), dtype=float).ravel()
        return np.clip(np.where(np.isfinite(values), values, mean), mean - reach, mean + reach)

    return predict


def answer(one, train, held_out, seed, ratios=False, effort=1):
    """`effort`: evaluations in 25,000.

    `ratios`: numbers as multiples of their median, so that a product of powers stays one; all must be positive.
    """
    result = Answer()
    columns, words = numbers(one), labels(one)
    for observable in OBSERVED:
        found = residuals(one, observable, train)
        if found is None:
            continue
        rows, target = found
        base = np.nan_to_num(one.predicted[observable])
        names = [*columns, *(name for name, _ in words), None]
        raw = np.column_stack([*columns.values(), *words.values(), base])
        mean, spread = raw[rows].mean(0), raw[rows].std(0)
        spread[spread == 0] = np.inf
        # From 1 upwards for numbers, so that ratios and logarithms are in reach.
        low = np.where([n in columns for n in names], raw.min(0), mean)
        features = np.where([n in columns for n in names], 1 + (raw - low) / spread, raw - mean)
        if ratios:
            features[:, : len(columns)] = raw[:, : len(columns)] / np.median(raw[rows, : len(columns)], axis=0)

        errors, of_mean = [], []
        for part in folds(len(rows), seed):
            others = np.setdiff1d(np.arange(len(rows)), part)
            predict = fit(features[rows[others]], target[others], seed, effort)
            errors.append(np.mean((target[part] - predict(features[rows[part]])) ** 2))
            of_mean.append(np.mean((target[part] - target[others].mean()) ** 2))
        result.claims[observable] = beats_mean(errors, of_mean)
        if not result.claims[observable]:
            continue
        predict = fit(features[rows], target, seed, effort)

        def design(shuffled):
            moved = features[rows].copy()
            for k, name in enumerate(names):
                if name in shuffled:
                    moved[:, k] = moved[shuffled[name], k]
            return moved

        best = most_important([n for n in names if n], design, predict, target, seed)
        result.column[observable] = [best] if best else []
        result.held_out[observable] = base[held_out] + predict(features[held_out])
    return result
