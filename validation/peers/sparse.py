"""Sparse regression: lasso on a library of terms, the penalty by cross-validation and the rule of one standard error."""

import warnings
from itertools import combinations

import numpy as np
from sklearn.exceptions import ConvergenceWarning
from sklearn.linear_model import Lasso, LassoCV

from planted_set import OBSERVED
from regression import Answer, folds, labels, most_important, numbers, residuals


def sizes(columns):
    """A typical size of each column."""
    return {name: np.median(np.abs(x[x != 0])) if np.any(x != 0) else 1.0 for name, x in columns.items()}


def terms(columns, words, base, size, least):
    """The library: x, x², sqrt x, log x, 1/x, products, labels; x and labels also times the base prediction, also a term."""
    scaled = {name: x / size[name] for name, x in columns.items()}
    library, names = [], []

    def add(values, *of):
        library.append(values)
        names.append(of)

    for name, z in scaled.items():
        add(z, name)
        add(z**2, name)
        if least[name] >= 0:
            add(np.sqrt(z), name)
        if least[name] > 0:
            add(np.log(z), name)
            add(1 / z, name)
        add(base * z, name)
    for one, other in combinations(scaled, 2):
        add(scaled[one] * scaled[other], one, other)
    for (name, _), flag in words.items():
        add(flag, name)
        add(base * flag, name)
    add(base)
    return np.column_stack(library), names


def answer(one, train, held_out, seed):
    result = Answer()
    columns, words = numbers(one), labels(one)
    size, least = sizes(columns), {name: x.min() for name, x in columns.items()}
    for observable in OBSERVED:
        found = residuals(one, observable, train)
        if found is None:
            continue
        rows, target = found
        base = np.nan_to_num(one.predicted[observable])
        everything, names = terms(columns, words, base, size, least)
        mean, spread = everything[rows].mean(0), everything[rows].std(0)
        spread[spread == 0] = np.inf
        scale = lambda x: np.clip((x - mean) / spread, -20, 20)
        parts = folds(len(rows), seed)
        splits = [(np.setdiff1d(np.arange(len(rows)), part), part) for part in parts]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)
            path = LassoCV(cv=splits, alphas=30, eps=1e-2, max_iter=3000, tol=1e-3).fit(scale(everything[rows]), target)
            error = path.mse_path_.mean(1)
            within = error.min() + path.mse_path_[error.argmin()].std(ddof=1) / np.sqrt(len(parts))
            penalty = path.alphas_[np.argmax(error <= within)]
            model = Lasso(alpha=penalty, max_iter=10000, tol=1e-4).fit(scale(everything[rows]), target)
        used = {name for coefficient, of in zip(model.coef_, names) if coefficient != 0 for name in of}
        result.claims[observable] = bool(used)
        if not used:
            continue

        def design(shuffled):
            moved = {n: x[rows][shuffled[n]] if n in shuffled else x[rows] for n, x in columns.items()}
            flags = {k: f[rows][shuffled[k[0]]] if k[0] in shuffled else f[rows] for k, f in words.items()}
            return scale(terms(moved, flags, base[rows], size, least)[0])

        best = most_important(used, design, model.predict, target, seed)
        result.column[observable] = [best] if best else []
        result.held_out[observable] = base[held_out] + model.predict(scale(everything[held_out]))
    return result

