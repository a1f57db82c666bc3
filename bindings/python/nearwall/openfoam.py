"""Results of OpenFOAM cases that ran with nearWallInteraction, as frames.

    case = nearwall.openfoam.Case("run")       # or a foamlib.FoamCase
    case.totals("slagWall")                    # hits, captures and rebounds over time
    case.deposit()                             # what lies on each face of the walls at the last time
    case.impacts()                             # recorded impacts, as `diagnose` and `predict` read them

openfoam/README.md describes every column; units stand in their names or there.
"""

from __future__ import annotations

import os
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy

from .frames import Frame, arrays, make
from .wheel import AnyPath, compiled

#: Tables by their endings; that of the totals has none of its own.
_ENDINGS = {"distributions": ".distributions.dat", "deposits": ".wall.dat", "fluxes": ".flux.dat", "stays": ".nearWall.dat"}
_BALANCE = "balance.dat"


class Case:
    """A case folder: a path, or an object with a `path`, such as a foamlib.FoamCase. `kind` is that of the frames, "pandas",
    "polars" or "dict"; by default pandas if it is installed, then polars.

    Methods take the name of a cloud where the case has several. The rows of all starts of the solver are joined. Damaged or
    missing files raise nearwall.Error.
    """

    def __init__(self, case: Union[AnyPath, Any], kind: Optional[str] = None) -> None:
        if not isinstance(case, (str, os.PathLike)):
            case = case.path
        self.path = os.fspath(case)
        self.kind = kind
        #: The clouds with tables.
        self.clouds: List[str] = compiled().clouds(self.path)

    def __repr__(self) -> str:
        return f"<nearwall.openfoam.Case {self.path}>"

    def _cloud(self, cloud: Optional[str]) -> str:
        from .library import Error
        if cloud is None and len(self.clouds) == 1:
            return self.clouds[0]
        if cloud in self.clouds:
            return str(cloud)
        known = ", ".join(self.clouds) or "none; run the case with nearWallInteraction first"
        raise Error(None, f"{self.path}: " + ("name a cloud" if cloud is None else f"no tables of a cloud `{cloud}`")
                    + f" (known here: {known})")

    def _tables(self, ending: str, cloud: Optional[str], unlike: Tuple[str, ...] = ()) -> Dict[str, Frame]:
        found = compiled().tables(self.path, self._cloud(cloud), ending, list(unlike))
        return {name: make(arrays(columns), self.kind) for name, columns in found}

    def _table(self, patch: str, ending: str, cloud: Optional[str], unlike: Tuple[str, ...] = ()) -> Frame:
        from .library import Error
        tables = self._tables(ending, cloud, unlike)
        if patch not in tables:
            raise Error(None, f"{self.path}: no table {patch}{ending} (known here: {', '.join(tables) or 'none'})")
        return tables[patch]

    def patches(self, cloud: Optional[str] = None) -> List[str]:
        """The patches with totals, which are those that were hit."""
        return list(self._tables(".dat", cloud, (_BALANCE, *_ENDINGS.values())))

    def totals(self, patch: str, cloud: Optional[str] = None) -> Frame:
        """`<patch>.dat`: hits, rebounds, captures and escapes since the start of the case, a row for each `time_s`."""
        return self._table(patch, ".dat", cloud, (_BALANCE, *_ENDINGS.values()))

    def distributions(self, patch: str, cloud: Optional[str] = None) -> Frame:
        """`<patch>.distributions.dat`: impacts by injector and class of speed, angle and size."""
        return self._table(patch, _ENDINGS["distributions"], cloud)

    def fluxes(self, patch: str, cloud: Optional[str] = None) -> Frame:
        """`<patch>.flux.dat`: mass fluxes of arrival and capture [kg/(m2 s)]."""
        return self._table(patch, _ENDINGS["fluxes"], cloud)

    def stays(self, patch: str, cloud: Optional[str] = None) -> Frame:
        """`<patch>.nearWall.dat`: how densely and how long parcels stay in the cells next to the wall."""
        return self._table(patch, _ENDINGS["stays"], cloud)

    def deposits(self, patch: str, cloud: Optional[str] = None) -> Frame:
        """`<patch>.wall.dat`, with `memory`: the deposit of the whole patch over time."""
        return self._table(patch, _ENDINGS["deposits"], cloud)

    def balance(self, cloud: Optional[str] = None) -> Frame:
        """`balance.dat`: injected, airborne, stuck, escaped and reacted mass [kg] over time."""
        return self._table("", _BALANCE, cloud)

    def deposit(self, time: Optional[float] = None, cloud: Optional[str] = None) -> Frame:
        """What the cloud's fields say of every face of the walls at a `time` [s], by default the last one with such fields.

        Columns: `time` [s], `patch`, `face` (its number on the patch; of a decomposed case, rank after rank), `x`, `y`, `z`
        (centre [m]), `area` [m2], and the fields that are written: `depositedMass` [kg/m2], `hitCount`,
        `meanImpactSpeed` [m/s], `moltenMass`, `powderMass` [kg/m2] and others (openfoam/README.md).
        """
        at, patches, columns = compiled().wall_fields(self.path, self._cloud(cloud), time)
        place = numpy.array(patches, dtype=object)
        seen: Dict[Optional[str], int] = {}
        faces = []
        for patch in patches:
            faces.append(seen.get(patch, 0))
            seen[patch] = faces[-1] + 1
        return make({"time": numpy.full(len(patches), at), "patch": place, "face": numpy.array(faces), **arrays(columns)},
                    self.kind)

    def impacts(self, cloud: Optional[str] = None) -> Frame:
        """The newest `impacts.csv` of the case (key `record`): one row for each recorded impact, inputs in SI units, outcome,
        patch and wall. `diagnose` and `predict` take it as it is."""
        return make(arrays(compiled().read_csv(str(compiled().record_file(self.path, cloud)))), self.kind)
