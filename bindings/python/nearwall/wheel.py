"""The compiled part of the package, which only the wheel has. Internal."""

from __future__ import annotations

import os
import warnings
from types import ModuleType
from typing import Any, Iterable, Tuple, Union, cast

from .library import Model

AnyPath = Union[str, "os.PathLike[str]"]


def compiled() -> Any:
    """The compiled module; where there is none, an ImportError says how to get it."""
    try:
        from . import _compiled
    except ImportError as fault:
        raise ImportError("this function is in the wheel only, not in the module that bindings/install copies: run "
                          "`pip install ./bindings/python` in the source of nearwall") from fault
    return cast(ModuleType, _compiled)


def model_of(model: Union[Model, AnyPath]) -> Tuple[str, str]:
    """Name and text of a model or of a model file."""
    read = model if isinstance(model, Model) else Model.from_file(model)
    return read.name, read.text


def warn(notes: Iterable[str]) -> None:
    """Warns of what the command prints on standard error."""
    for note in notes:
        warnings.warn(note, stacklevel=3)
