"""Predictions of a model for a table of impacts."""

from __future__ import annotations

from typing import Optional, Union

import numpy

from .frames import Frame, Table, arrays, extended, make, names, source
from .library import Model
from .wheel import AnyPath, compiled, model_of, warn

#: Most reasons of rows left out in one warning.
_SHOWN = 5


def predict(table: Table, model: Union[Model, AnyPath], *, wall: Optional[str] = None, draws: Optional[AnyPath] = None,
            kind: Optional[str] = None) -> Frame:
    """Adds what the model predicts on average to each impact, as the command `nearwall predict` does.

    table: a pandas or polars frame, a dict of arrays, or the path of a CSV file, N rows. Its columns are v_n [m/s] and any of
        v_t [m/s], d [m], T_p, T_w [K] and the other inputs (docs/reference/data-file.md); blanks take their defaults, other columns are
        kept.
    model: a model or the path of a model file.
    wall: the wall that is hit; by default the column `wall`, then the wall `default`, then the only wall.
    draws: folder of the model files that `Diagnosis.save` wrote into `draws`: adds 95 % bands.
    kind: "pandas", "polars" or "dict" for the result of a CSV file; by default pandas if it is installed, then polars.

    Returns the table with e_n, e_t and p_stick [1] and regime (with `draws` also e_n_low, e_n_high and so on), and in
    beyond the stated ranges that a row leaves, with what that moves; of the kind that
    came in. A column of that name is kept, the prediction then ends in `_predicted`. Rows that cannot be used have NaN in a
    frame, are left out of a file, and are listed in a warning; line 1 of a frame is its header. Raises Error, as the command.

    For one call without a table, and without copies, use `Model.resolve`; it draws a single outcome of what a model draws by
    chance, `predict` averages.
    """
    cells, numbers, regimes, beyond, left_out, notes = compiled().predict(model_of(model), source(table), wall, draws)
    if left_out:
        shown = "; ".join(f"line {line}: {reason}" for line, reason in left_out[:_SHOWN])
        more = f"; and {len(left_out) - _SHOWN} more" if len(left_out) > _SHOWN else ""
        notes = [*notes, f"{len(left_out)} rows left out: {shown}{more}"]
    warn(notes)
    frame = table if cells is None else make(arrays(cells), kind)
    added = {**arrays(numbers), "regime": numpy.array(regimes, dtype=object),
             "beyond": numpy.array(beyond, dtype=object)}
    taken = set(names(frame))
    bands = (name for name in added if name.endswith(("_low", "_high")))
    order = ["e_n", "e_t", "p_stick", "regime", *bands, "beyond"]
    return extended(frame, {f"{name}_predicted" if name in taken else name: added[name] for name in order})
