"""Standalone cases, without OpenFOAM."""

from __future__ import annotations

import json
import pathlib
from dataclasses import dataclass
from html import escape
from typing import Any, Dict, List, Optional

from .frames import Frame, arrays, make
from .wheel import AnyPath, compiled, warn


@dataclass(frozen=True, repr=False)
class Simulation:
    """What a case gave: `summary` is summary.json (docs/standalone.md), `impacts` a frame with one row for each recorded hit
    (inputs in SI units, outcome, wall), `deposit` a frame of what lay on the walls over time or None, `html` the page."""

    summary: Dict[str, Any]
    impacts: Frame
    deposit: Optional[Frame]
    html: str
    _texts: Dict[str, str]

    @property
    def runs(self) -> List[Dict[str, Any]]:
        """The runs of the summary: one, or one for each value of a sweep."""
        return list(self.summary["runs"])

    def save(self, folder: AnyPath) -> None:
        """Writes summary.json, impacts.csv, report.html and, with a deposit, deposit.csv, as the command does."""
        place = pathlib.Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        for name, text in self._texts.items():
            (place / name).write_text(text, encoding="utf-8")

    def __repr__(self) -> str:
        return f"<nearwall.Simulation of {len(self.runs)} run(s), {len(self.impacts)} impacts recorded>"

    def _repr_html_(self) -> str:
        # The page has its own style sheet, so it stands in a frame.
        return f"<iframe style='width:100%;height:40em;border:0' srcdoc=\"{escape(self.html)}\"></iframe>"


def simulate(case: AnyPath, *, draws: Optional[AnyPath] = None, kind: Optional[str] = None) -> Simulation:
    """Follows the particles of a case file through its gas, as the command `nearwall simulate` does.

    case: path of the case file (docs/standalone.md).
    draws: folder of the model files that `Diagnosis.save` wrote into `draws`: adds 95 % bands of the captures.
    kind: "pandas", "polars" or "dict" for the tables; by default pandas if it is installed, then polars.

    Raises Error, which names file, line and key. Ctrl-C ends it.
    """
    text, impacts, columns, deposit, page, notes = compiled().simulate(case, draws)
    warn(notes)
    texts = {"impacts.csv": impacts, "summary.json": text, "report.html": page}
    frame = None
    if deposit is not None:
        texts["deposit.csv"], of_deposit = deposit
        frame = make(arrays(of_deposit), kind)
    return Simulation(json.loads(text), make(arrays(columns), kind), frame, page, texts)
