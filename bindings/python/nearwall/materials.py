"""The built-in materials."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import Dict, Optional, Sequence, Tuple

from .wheel import compiled


@dataclass(frozen=True)
class Property:
    """A property of a material at one temperature."""

    #: Its unit; "1" for a number without one.
    unit: str
    #: None where it is not known at this temperature.
    value: Optional[float]
    #: Standard uncertainty, in the same unit.
    uncertainty: Optional[float]
    #: Temperatures [K] between which there is a value; None for all.
    known: Optional[Tuple[float, float]]
    #: Temperatures [K] for which the source states it; None where it does not say.
    valid: Optional[Tuple[float, float]]
    #: Where the number comes from, or "assumed".
    source: Optional[str]


@dataclass(frozen=True)
class Material:
    """A built-in material at a temperature [K]; `composition` has the oxides of a slag [wt%]."""

    name: str
    about: str
    temperature: float
    properties: Dict[str, Property]
    composition: Dict[str, float]

    def __getitem__(self, key: str) -> Property:
        return self.properties[key]

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{escape(key)}</td><td>{'not known' if p.value is None else f'{p.value:.6g}'} {escape(p.unit)}</td>"
            f"<td style='text-align:left'>{escape(p.source or 'none given')}</td></tr>" for key, p in self.properties.items())
        return (f"<p><b>{escape(self.name)}</b> at {self.temperature:g} K: {escape(self.about)}</p>"
                f"<table><tr><th>property</th><th>value</th><th>source</th></tr>{rows}</table>")


def _pair(ends: Optional[Sequence[float]]) -> Optional[Tuple[float, float]]:
    return None if ends is None else (ends[0], ends[1])


def materials(name: Optional[str] = None, temperature: float = 293.15) -> Dict[str, Material]:
    """The built-in materials by name, or only the one named, with their properties at a `temperature` [K].

    Raises Error for an unknown name, with the nearest known ones.
    """
    found = compiled().materials(name, temperature)
    return {
        key: Material(key, about or "", temperature, {
            kind: Property(unit, value, uncertainty, _pair(known), _pair(valid), origin)
            for kind, unit, value, uncertainty, known, valid, origin in properties}, dict(composition))
        for key, about, properties, composition in found}
