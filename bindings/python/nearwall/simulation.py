"""Standalone cases, without OpenFOAM."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Dict, List, Optional

from .frames import Frame, arrays, make
from .pages import Page
from .wheel import AnyPath, compiled, warn


@dataclass(frozen=True, repr=False)
class Simulation(Page):
    """What a case gave: `summary` is summary.json (docs/reference/case-file.md), `impacts` a frame with one row for each recorded hit
    (inputs in SI units, outcome, wall), `deposit` a frame of what lay on the walls over time or None, `html` the page."""

    summary: Dict[str, Any]
    impacts: Frame
    deposit: Optional[Frame]

    @property
    def runs(self) -> List[Dict[str, Any]]:
        """The runs of the summary: one, or one for each value of a sweep."""
        return list(self.summary["runs"])

    def __repr__(self) -> str:
        return f"<nearwall.Simulation of {len(self.runs)} run(s), {len(self.impacts)} impacts recorded>"


def simulate(case: AnyPath, *, draws: Optional[AnyPath] = None, kind: Optional[str] = None) -> Simulation:
    """Follows the particles of a case file through its gas, as the command `nearwall simulate` does.

    case: path of the case file (docs/reference/case-file.md).
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
    return Simulation(page, texts, json.loads(text), make(arrays(columns), kind), frame)
