"""Tables in and out: a pandas or polars frame, a dict of arrays, or the path of a CSV file. Internal."""

from __future__ import annotations

import os
import sys
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy
from numpy.typing import NDArray

#: A pandas.DataFrame, a polars.DataFrame or a mapping of names to sequences of one length.
Frame = Any
#: A frame, or the path of a CSV file.
Table = Any

_Column = Union[bytes, List[Optional[str]]]
_Parts = Tuple[str, Union[bytearray, List[Optional[str]]]]


def kind_of(table: Table) -> Optional[str]:
    """"pandas", "polars" or "dict"; None for a path."""
    if isinstance(table, (str, os.PathLike)):
        return None
    for name in ("pandas", "polars"):
        module = sys.modules.get(name)
        if module is not None and isinstance(table, module.DataFrame):
            return name
    if isinstance(table, Mapping):
        return "dict"
    raise TypeError("the table has to be a pandas or polars DataFrame, a dict of arrays, or the path of a CSV file, not "
                    f"{type(table).__module__}.{type(table).__qualname__}")


def source(table: Table) -> Union[str, List[Tuple[str, _Column]]]:
    """What the compiled module reads: a path, or names and columns of 64-bit floats or texts."""
    kind = kind_of(table)
    if kind is None:
        return os.fsdecode(table)
    if kind == "pandas":
        columns = [(str(name), _numbers_or_texts(table.iloc[:, place])) for place, name in enumerate(table.columns)]
    elif kind == "polars":
        columns = [(series.name, _of_polars(series)) for series in table.get_columns()]
    else:
        columns = [(str(name), _numbers_or_texts(values)) for name, values in table.items()]
    counts = {len(column) // 8 if isinstance(column, bytes) else len(column) for _, column in columns}
    if len(counts) > 1:
        raise ValueError(f"the columns have different lengths: {', '.join(map(str, sorted(counts)))}")
    return columns


def _of_polars(series: Any) -> _Column:
    import polars
    if series.dtype.is_numeric():
        return _bytes(series.cast(polars.Float64).fill_null(float("nan")).to_numpy())
    return [_text(value) for value in series.to_list()]


def _numbers_or_texts(values: Any) -> _Column:
    if hasattr(values, "to_numpy"):  # a pandas.Series, whose nullable numbers have their own blank
        kind = getattr(values.dtype, "kind", "O")
        values = values.to_numpy(dtype=float, na_value=numpy.nan) if kind in "iuf" else values.to_numpy(dtype=object)
    array = numpy.asarray(values)
    if array.ndim != 1:
        raise ValueError(f"a column has shape {array.shape}; it has to have one dimension")
    if array.dtype.kind in "iuf":
        return _bytes(array)
    if array.dtype.kind == "O":  # numbers and None
        filled = [numpy.nan if value is None else value for value in array.tolist()]
        if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in filled):
            return _bytes(numpy.asarray(filled, dtype=float))
    return [_text(value) for value in array.tolist()]


def _bytes(array: NDArray[Any]) -> bytes:
    return numpy.ascontiguousarray(array, dtype=numpy.float64).tobytes()


def _text(value: Any) -> Optional[str]:
    # pandas.NA has no truth; NaN and NaT differ from themselves.
    if value is None or type(value).__name__ == "NAType" or value != value:
        return None
    return str(value)


def arrays(parts: Sequence[_Parts]) -> Dict[str, NDArray[Any]]:
    """Columns of the compiled module as arrays: of float64, or of str and None."""
    return {name: numpy.array(column, dtype=object) if isinstance(column, list)
            else numpy.frombuffer(column, dtype=numpy.float64) for name, column in parts}


def default_kind() -> str:
    """pandas if it is installed, else polars, else dict."""
    import importlib.util
    for name in ("pandas", "polars"):
        if importlib.util.find_spec(name):
            return name
    return "dict"


def make(columns: Mapping[str, Any], kind: Optional[str]) -> Frame:
    """A frame of a kind, "pandas", "polars" or "dict"; by default of the first that is installed."""
    kind = kind or default_kind()
    if kind == "pandas":
        import pandas
        return pandas.DataFrame(dict(columns))
    if kind == "polars":
        import polars
        return polars.DataFrame({name: values.tolist() if values.dtype == object else values for name, values in columns.items()})
    if kind == "dict":
        return dict(columns)
    raise ValueError(f"kind has to be \"pandas\", \"polars\" or \"dict\", not {kind!r}")


def extended(table: Frame, columns: Mapping[str, Any]) -> Frame:
    """The frame with more columns, of the same kind; the frame handed over stays as it is."""
    kind = kind_of(table)
    if kind == "pandas":
        return table.assign(**{name: values for name, values in columns.items()})
    if kind == "polars":
        import polars
        return table.with_columns(
            polars.Series(name, values.tolist() if values.dtype == object else values) for name, values in columns.items())
    return {**table, **columns}


def names(table: Frame) -> List[str]:
    """The names of the columns."""
    return [str(name) for name in (table.keys() if isinstance(table, Mapping) else table.columns)]
