"""The effects that a model lacks to explain measured impacts."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union

from .frames import Table, kind_of, names, source
from .library import Model
from .pages import Page, Run, axes, begin, options
from .prediction import predict
from .wheel import AnyPath, compiled, model_of, warn


@dataclass(frozen=True)
class Parameter:
    """A fitted number with its 95 % interval, in `unit` ("1" for none)."""

    value: float
    low: float
    high: float
    unit: str

    def __str__(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        return f"{self.value:.4g} ({self.low:.4g} to {self.high:.4g}){unit}"


@dataclass(frozen=True)
class Finding:
    """A cause of the misfit; `record` has everything that diagnosis.json says of it."""

    #: Id of an effect, or `unknown:COLUMN`.
    cause: str
    #: "e_n", "e_t" or "capture".
    observable: str
    variables: List[str]
    p_value: float
    q_value: float
    #: Share of the data splits that name this cause.
    certainty: float
    parameters: Dict[str, Parameter]
    #: Causes that the data cannot tell from this one.
    indistinguishable_from: List[str]
    explanation: str
    record: Dict[str, Any]

    @classmethod
    def of(cls, record: Dict[str, Any]) -> Finding:
        """The finding of an entry of diagnosis.json."""
        parameters = {name: Parameter(**estimate) for name, estimate in record["parameters"].items()}
        keys = ("cause", "observable", "variables", "p_value", "q_value", "certainty", "indistinguishable_from", "explanation")
        return cls(parameters=parameters, record=record, **{key: record[key] for key in keys})

    def _cells(self) -> str:
        numbers = "<br>".join(f"{escape(name)} = {escape(str(value))}" for name, value in self.parameters.items())
        same = escape(", ".join(self.indistinguishable_from)) or "-"
        return (f"<td>{escape(self.cause)}</td><td>{escape(self.observable)}</td><td>{numbers}</td><td>{self.q_value:.2g}</td>"
                f"<td>{same}</td><td style='text-align:left'>{escape(self.explanation)}</td>")

    def _repr_html_(self) -> str:
        return _table([self])


@dataclass(frozen=True)
class Gain:
    """The gain of the extended model on rows that it was not fitted to."""

    held_out_rows: int
    observable: str
    rmse_before: float
    rmse_after: float
    #: 95 % interval of rmse_after/rmse_before.
    ci95: Tuple[float, float]
    record: Dict[str, Any]

    @classmethod
    def of(cls, record: Dict[str, Any]) -> Gain:
        """The gain of an entry of diagnosis.json."""
        low, high = record["ci95"]
        return cls(record["held_out_rows"], record["observable"], record["rmse_before"], record["rmse_after"], (low, high), record)

    def __str__(self) -> str:
        low, high = self.ci95
        return (f"rms error of {self.observable} on {self.held_out_rows} held-out rows: {self.rmse_before:.3g} before, "
                f"{self.rmse_after:.3g} after; ratio {low:.2f} to {high:.2f}")

    def _repr_html_(self) -> str:
        return f"<p>{escape(str(self))}</p>"


def _table(findings: List[Finding]) -> str:
    head = "".join(f"<th>{word}</th>" for word in
                   ("cause", "acts on", "parameters (95 %)", "q", "indistinguishable from", "explanation"))
    rows = "".join(f"<tr>{finding._cells()}</tr>" for finding in findings)
    return f"<table><tr>{head}</tr>{rows}</table>"


@dataclass(frozen=True, repr=False)
class Diagnosis(Page):
    """The result of `diagnose`. `record` is diagnosis.json, `html` the page."""

    record: Dict[str, Any]

    @property
    def extended_toml(self) -> str:
        """The text of the extended model, which OpenFOAM reads unchanged."""
        return self._texts["extended.toml"]

    @property
    def draws(self) -> List[str]:
        """The texts of model files drawn from the fit."""
        return [text for name, text in self._texts.items() if name.startswith("draws/")]

    @property
    def verdict(self) -> str:
        """The result in a few sentences."""
        return str(self.record["verdict"])

    @cached_property
    def findings(self) -> List[Finding]:
        """The causes in the order in which they were found; empty if there is nothing beyond noise."""
        return [Finding.of(record) for record in self.record["findings"]]

    @cached_property
    def gain(self) -> Optional[Gain]:
        """The gain in the observable of the first finding; None without a finding."""
        return Gain.of(self.record["gain"]) if self.record["gain"] else None

    @cached_property
    def model(self) -> Model:
        """The extended model."""
        return Model.from_toml(self.extended_toml, "extended.toml")

    @property
    def rejected(self) -> List[Tuple[int, str]]:
        """Rows that were left out: line (1 is the header) and reason."""
        return [(row["line"], row["reason"]) for row in self.record["rows"]["rejected"]]

    def plot(self, table: Table, base: Union[Model, AnyPath], over: Optional[str] = None, observable: Optional[str] = None,
             ax: Any = None) -> Any:
        """Draws what was measured over a column, with the base and the extended model. By default the observable ("e_n", "e_t"
        or "capture_efficiency") and the first column of the first finding."""
        ax = ax or axes()
        first = self.findings[0] if self.findings else None
        observable = observable or (first.observable if first else "e_n")
        observable = "capture_efficiency" if observable == "capture" else observable
        over = over or (first.variables[0] if first and first.variables else "v_n")
        kind = "dict" if kind_of(table) is None else None
        predicted = "p_stick" if observable == "capture_efficiency" else observable
        for model, name, marker in ((base, "base model", "x"), (self.model, "extended model", "+")):
            with_model = predict(table, model, kind=kind)
            column = f"{predicted}_predicted" if f"{predicted}_predicted" in names(with_model) else predicted
            ax.plot(with_model[over], with_model[column], marker, label=name)
        ax.plot(with_model[over], with_model[observable], "o", mfc="none", color="black", label="measured")
        ax.set_xlabel(over)
        ax.set_ylabel(f"{observable} [1]")
        ax.legend()
        return ax

    def __repr__(self) -> str:
        return f"<nearwall.Diagnosis: {self.verdict}>"

    def _repr_html_(self) -> str:
        table = _table(self.findings) if self.findings else ""
        gain = self.gain._repr_html_() if self.gain else ""
        rows = self.record["rows"]
        return f"<p>{escape(self.verdict)}</p>{table}{gain}<p>{rows['used']} of {rows['read']} rows used.</p>"


def diagnose(table: Table, model: Optional[Union[Model, AnyPath]] = None, *, case: Optional[AnyPath] = None,
             impacts: Optional[AnyPath] = None, columns: Optional[AnyPath] = None, group: Optional[str] = None,
             wall: Optional[str] = None, seed: int = 1, level: float = 0.05, draws: int = 0,
             reach: Optional[Mapping[str, Tuple[float, float]]] = None) -> Diagnosis:
    """Finds the effects that a model lacks to explain measured impacts, as the command `nearwall diagnose` does.

    table: a pandas or polars frame, a dict of arrays, or the path of a CSV file, three rows or more. One row is an impact or an
        average: v_n [m/s] and other inputs in SI units, and at least one of e_n, e_t [1], outcome ("rebound" or "stick") and
        capture_efficiency [1]; every other column is a possible cause (docs/reference/data-file.md).
    model: the base model or the path of its file.
    case: path of a case of `simulate`: rows are experiments on this rig (docs/how-to/rig-diagnosis.md), and the model
        is the case's.
    impacts: folder of OpenFOAM cases with recorded impacts: rows are experiments on a rig; model is that of these runs.
    columns: path of a column map for a laboratory's own columns and units.
    group: column that tells groups of rows apart that may share an error.
    wall: the wall that is hit; by default the column `wall`, then the wall `default`, then the only wall.
    seed: of the split into fitted and held-out rows; the same seed gives the same result.
    level: accepted share of false discoveries, between 0 and 0.5.
    draws: number of model files to draw from the fit; the range over 39 is a 95 % band.
    reach: what can be varied in the next measurement: input, or key of the case, and its least and largest value in SI units,
        as {"T_p": (290, 400)}; by default what varies in the data, up to twice its range.

    Raises Error, as the command; what the command notes on standard error is a warning. Lines count from the header, line 1.
    Ctrl-C ends it.
    """
    if not 0 < level < 0.5:
        raise ValueError(f"level {level}: must lie between 0 and 0.5")
    ranges = [(name, (float(low), float(high))) for name, (low, high) in (reach or {}).items()]
    for name, (low, high) in ranges:
        if not -math.inf < low < high < math.inf:
            raise ValueError(f"reach {name}: {low} to {high} is no range")
    if case is not None or impacts is not None:
        with begin() as folder:
            run = Run(folder)
            words = [] if model is None else ["--model", run.model(model)]
            words += [word for name, (low, high) in ranges for word in ("--reach", f"{name}={low!r}:{high!r}")]
            run.command("diagnose", run.table(table), "--out", run.out, *words, *options(
                case=case, impacts=impacts, columns=columns, group=group, wall=wall, seed=seed, level=level, draws=draws))
            texts = run.texts()
            return Diagnosis(texts["report.html"], texts, json.loads(texts["diagnosis.json"]))
    if model is None:
        raise TypeError("diagnose needs a model, or a case for experiments on a rig")
    text, extended, page, drawn, notes = compiled().diagnose(
        model_of(model), source(table), columns, group, wall, seed, level, draws, ranges)
    warn(notes)
    texts = {"extended.toml": extended, "diagnosis.json": text, "report.html": page}
    texts.update({f"draws/{number:02}.toml": drawn_text for number, drawn_text in enumerate(drawn, 1)})
    return Diagnosis(page, texts, json.loads(text))
