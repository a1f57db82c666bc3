"""Sparse regression by PySINDY: sequentially thresholded least squares on polynomials of the logarithms of the columns.

In logarithms a product of powers, such as a dimensionless group, is a sum.
"""

import warnings

import numpy as np
from pysindy import STLSQ, PolynomialLibrary

from planted_set import OBSERVED
from regression import Answer, beats_mean, folds, numbers, residuals

DEGREE = 3
# Smallest coefficient that is kept, in standard deviations of the observable per one of the term.
THRESHOLDS = np.geomspace(0.01, 1, 15)
RIDGE = 1e-3


def fit(x, y, threshold):
    """A function of the terms; a constant where no term is left."""
    mean, spread, middle, scale = x.mean(0), x.std(0), y.mean(), y.std()
    model = STLSQ(threshold=threshold, alpha=RIDGE)
    with warnings.catch_warnings():
        # All terms below the threshold: a constant.
        warnings.simplefilter("ignore")
        model.fit((x - mean) / spread, ((y - middle) / scale)[:, None])
    weights = np.ravel(model.coef_) * scale
    return lambda new: middle + np.asarray((new - mean) / spread) @ weights


def answer(one, train, held_out, seed):
    """`regression.Answer` without a most important column: its caller shuffles."""
    result = Answer()
    columns = np.column_stack([np.log(x) for x in numbers(one).values()])
    columns = (columns - columns[train].mean(0)) / columns[train].std(0)
    everything = np.asarray(PolynomialLibrary(degree=DEGREE, include_bias=False).fit_transform(columns))
    for observable in OBSERVED:
        found = residuals(one, observable, train)
        if found is None:
            continue
        rows, target = found
        parts, every = folds(len(rows), seed), np.arange(len(rows))
        errors, of_mean = np.zeros((len(THRESHOLDS), len(parts))), np.zeros(len(parts))
        for j, part in enumerate(parts):
            others = np.setdiff1d(every, part)
            of_mean[j] = np.mean((target[part] - target[others].mean()) ** 2)
            for i, threshold in enumerate(THRESHOLDS):
                predict = fit(everything[rows[others]], target[others], threshold)
                errors[i, j] = np.mean((target[part] - predict(everything[rows[part]])) ** 2)
        best = errors.mean(1).argmin()
        within = errors[best].mean() + errors[best].std(ddof=1) / np.sqrt(len(parts))
        chosen = np.flatnonzero(errors.mean(1) <= within).max()
        result.claims[observable] = beats_mean(errors[chosen], of_mean)
        if result.claims[observable]:
            predict = fit(everything[rows], target, THRESHOLDS[chosen])
            result.held_out[observable] = one.predicted[observable][held_out] + predict(everything[held_out])
    return result
