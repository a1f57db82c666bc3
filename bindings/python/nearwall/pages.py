"""Functions that run the command `nearwall` beside this process, so that Ctrl-C ends it, and give its tables and pages."""

from __future__ import annotations

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from html import escape
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy

from .frames import Frame, Table, arrays, kind_of, make, source
from .library import Error, Model
from .wheel import AnyPath, compiled, warn

#: Name of an input, its least and largest value in SI units, and by choice the number of points.
Axis = Union[Tuple[str, float, float], Tuple[str, float, float, int]]
#: SI units of the inputs of an impact.
UNITS = {"v_n": "m/s", "v_t": "m/s", "omega": "rad/s", "d": "m", "T_p": "K", "rho_p": "kg/m3", "conversion": "1", "T_w": "K",
         "T_under": "K", "roughness": "m", "coverage": "1", "layer_thickness": "m", "film_thickness": "m",
         "melt_thickness": "m", "v_gas": "m/s"}


@dataclass(frozen=True, repr=False)
class Page:
    """A page that shows itself in a notebook: `html` is its text."""

    html: str
    _texts: Dict[str, str]

    def save(self, folder: AnyPath) -> None:
        """Writes the files that the command writes into a folder."""
        for name, text in self._texts.items():
            place = pathlib.Path(folder, name)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text, encoding="utf-8")

    def _repr_html_(self) -> str:
        # The page has its own style sheet, so it stands in a frame.
        return f"<iframe style='width:100%;height:40em;border:0' srcdoc=\"{escape(self.html)}\"></iframe>"


class Run:
    """A run of the command in a folder of its own, which is taken out of all its texts."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        self.out = os.path.join(folder, "out")

    def table(self, table: Table) -> str:
        """The path of a table; a frame becomes a file."""
        if kind_of(table) is None:
            return os.fsdecode(table)
        path = os.path.join(self.folder, "frame")
        pathlib.Path(path).write_bytes(compiled().csv_of(source(table)))
        return path

    def model(self, model: Union[Model, AnyPath]) -> str:
        """The path of a model file."""
        if not isinstance(model, Model):
            return os.fsdecode(model)
        path = pathlib.Path(self.folder, str(len(os.listdir(self.folder))), pathlib.Path(model.name).name)
        path.parent.mkdir()
        path.write_text(model.text, encoding="utf-8")
        return str(path)

    def command(self, *arguments: Any) -> str:
        """What the command prints; its notes become warnings, its fault an Error."""
        compiled()
        words = [sys.executable, "-m", "nearwall", *(os.fsdecode(word) if isinstance(word, os.PathLike) else str(word)
                                                     for word in arguments)]
        done = subprocess.run(words, capture_output=True, encoding="utf-8", errors="replace")
        notes = [self.own(note).strip() for note in re.split(r"^nearwall: ", done.stderr, flags=re.MULTILINE)]
        # A wrong value is refused before the command runs, in the words of a usage error.
        fault = notes.pop().removeprefix("error: ").split("\n\nFor more")[0] if done.returncode else ""
        warn(note for note in notes if note)
        if done.returncode:
            raise Error(None, fault)
        return self.own(done.stdout)

    def own(self, text: str) -> str:
        """A text without the folder; a drawn folder has no name of its own."""
        return re.sub(re.escape(self.folder) + r"/(\d+/)?", "", text)

    def texts(self) -> Dict[str, str]:
        """The files that were written, by name."""
        files = sorted(path for path in pathlib.Path(self.out).rglob("*") if path.is_file())
        return {str(path.relative_to(self.out)): self.own(path.read_text(encoding="utf-8")) for path in files}

    def frame(self, name: str, kind: Optional[str]) -> Frame:
        """A CSV file that was written."""
        return make(arrays(compiled().read_csv(os.path.join(self.out, name))), kind)


def begin() -> "tempfile.TemporaryDirectory[str]":
    """A folder for a run."""
    return tempfile.TemporaryDirectory(prefix="nearwall-")


def options(**given: Any) -> List[str]:
    """Options of the command; those that are None are left out."""
    return [word for name, value in given.items() if value is not None for word in (f"--{name}", str(value))]


def check(model: Union[Model, AnyPath]) -> str:
    """Checks a model or a model file and describes it in words, as `nearwall check`. Raises Error, which names line and key."""
    with begin() as folder:
        run = Run(folder)
        return run.command("check", run.model(model)).rstrip()


@dataclass(frozen=True, repr=False)
class Comparison(Page):
    """The result of `compare`: `record` is compare.json (docs/how-to/compare.md)."""

    record: Dict[str, Any]

    @property
    def verdict(self) -> str:
        """The result in a few sentences."""
        return str(self.record["verdict"])

    @property
    def ranking(self) -> List[str]:
        """The models, the best first."""
        return [str(model["model"]) for model in self.record["models"]]

    def plot(self, measure: str = "log_likelihood", ax: Any = None) -> Any:
        """Draws a measure of each model with its 95 % interval: "log_likelihood", "rmse_e_n", "rmse_e_t", "log_loss_stick"."""
        models = [model for model in self.record["models"] if model[measure]]
        ax = ax or axes()
        for place, model in enumerate(models):
            value, ends = model[measure]["value"], model[measure]["ci95"]
            low, high = ends or (value, value)
            ax.errorbar(value, place, xerr=[[value - low], [high - value]], fmt="o", color="C0", capsize=3)
        ax.set_yticks(range(len(models)), [pathlib.Path(model["model"]).name for model in models])
        ax.invert_yaxis()
        ax.set_xlabel(measure.replace("_", " "))
        return ax

    def __repr__(self) -> str:
        return f"<nearwall.Comparison: {self.verdict}>"


def compare(table: Table, models: Sequence[Union[Model, AnyPath]], *, columns: Optional[AnyPath] = None,
            wall: Optional[str] = None, seed: int = 1) -> Comparison:
    """Ranks two or more models on measured impacts, as `nearwall compare`; table, columns and wall are those of `diagnose`."""
    with begin() as folder:
        run = Run(folder)
        run.command("compare", run.table(table), "--models", *[run.model(model) for model in models], "--out", run.out,
                    *options(columns=columns, wall=wall, seed=seed))
        texts = run.texts()
        return Comparison(texts["compare.html"], texts, json.loads(texts["compare.json"]))


@dataclass(frozen=True, repr=False)
class Map(Page):
    """What a model decides over two inputs, or three with a slider: `frame` has a row for each choice of their values, with
    e_n, e_t, p_stick and regime; `axes` are the names of the inputs."""

    frame: Frame
    axes: Tuple[str, ...]

    def _grid(self, quantity: str) -> Tuple[List[Any], Any]:
        """The values of the inputs, and the quantity over them: y, x and, with a slider, first its input."""
        values = [numpy.asarray(self.frame[name], float) for name in self.axes]
        own = [numpy.unique(one) for one in values]
        cells = numpy.asarray(self.frame[quantity])
        shape = tuple(one.size for one in reversed(own))
        if cells.dtype.kind in "fiu":
            grid = numpy.full(shape, numpy.nan)
        else:
            grid = numpy.full(shape, None, dtype=object)
        grid[tuple(numpy.searchsorted(one, of) for one, of in zip(reversed(own), reversed(values)))] = cells
        return own, grid

    def to_xarray(self) -> Any:
        """An xarray.Dataset with e_n, e_t, p_stick and regime over the inputs, as in `map.to_xarray().p_stick.sel(T_p=1200)`."""
        import xarray
        quantities = ("e_n", "e_t", "p_stick", "regime")
        grids = {quantity: self._grid(quantity) for quantity in quantities}
        names = tuple(reversed(self.axes))
        return xarray.Dataset({quantity: (names, grid) for quantity, (_, grid) in grids.items()},
                              coords=dict(zip(self.axes, grids["p_stick"][0])))

    def plot(self, quantity: str = "p_stick", ax: Any = None, at: Optional[float] = None) -> Any:
        """Draws "e_n", "e_t" or "p_stick" in colours over x and y; at: the value of the slider, of which the nearest is
        taken, by default the middle one."""
        ax = ax or axes()
        (columns, rows, *third), grid = self._grid(quantity)
        if third:
            place = len(third[0]) // 2 if at is None else int(numpy.argmin(abs(third[0] - at)))
            grid = grid[place]
            ax.set_title(f"{self.axes[2]} = {third[0][place]:g} {UNITS[self.axes[2]]}")
        colours = ax.pcolormesh(columns, rows, grid, shading="nearest", cmap="cividis", vmin=0, vmax=1)
        ax.figure.colorbar(colours, ax=ax, label=f"{quantity} [1]")
        for axis, values, scale, label in ((0, columns, ax.set_xscale, ax.set_xlabel), (1, rows, ax.set_yscale, ax.set_ylabel)):
            label(f"{self.axes[axis]} [{UNITS[self.axes[axis]]}]")
            if values[0] > 0 and values[-1] / values[0] >= 30:
                scale("log")
        return ax

    def __repr__(self) -> str:
        return f"<nearwall.Map over {' and '.join(self.axes)}>"


def map(model: Union[Model, AnyPath], x: Optional[Axis] = None, y: Optional[Axis] = None, *, slider: Optional[Axis] = None,
        fixed: Optional[Mapping[str, float]] = None, wall: Optional[str] = None, kind: Optional[str] = None) -> Map:
    """Decides impacts over two or three inputs while the others are fixed, as `nearwall map`.

    x, y: input with its least and largest value in SI units and, by choice, the number of points, as ("v_n", 0.1, 30).
    slider: a third input in the same form; the page has a slider over its values, 7 unless given.
    fixed: values of other inputs, as {"T_p": 1700}.
    """
    def word(axis: Optional[Axis]) -> Optional[str]:
        if axis is None:
            return None
        name, low, high, *points = axis
        return f"{name}={float(low)!r}:{float(high)!r}" + "".join(f":{count}" for count in points)
    with begin() as folder:
        run = Run(folder)
        settings = [part for name, value in (fixed or {}).items() for part in ("--set", f"{name}={float(value)!r}")]
        run.command("map", run.model(model), "-o", run.out, *settings,
                    *options(x=word(x), y=word(y), slider=word(slider), wall=wall))
        texts = run.texts()
        names = texts["map.csv"].split("\n", 1)[0].split(",")
        return Map(texts["map.html"], texts, run.frame("map.csv", kind), tuple(names[:names.index("e_n")]))


@dataclass(frozen=True, repr=False)
class Sensitivity(Page):
    """Which numbers of a case decide what its walls capture: `frame` has a row for each number and wall, the largest change
    first; `record` is sensitivity.json (docs/how-to/forecast.md)."""

    record: Dict[str, Any]
    frame: Frame

    def plot(self, wall: Optional[str] = None, most: int = 12, ax: Any = None) -> Any:
        """Draws the captured share of a wall, by default the first, at both ends of the range of each number."""
        ax = ax or axes()
        pairs = [(number, next(one for one in number["walls"] if wall in (None, one["wall"]))) for number in self.record["numbers"]]
        # A hundredth of the largest change is nothing that can be seen.
        least = 0.01 * max((float(one["change"]) for _, one in pairs), default=0.0)
        pairs = [pair for pair in pairs if pair[1]["change"] > 0 and pair[1]["change"] >= least]
        pairs = sorted(pairs, key=lambda pair: -float(pair[1]["change"]))[:most]
        for place, (_, one) in enumerate(pairs):
            for end, colour, shift in (("low", "#0072B2", -0.2), ("high", "#D55E00", 0.2)):
                ax.barh(place + shift, one[f"captured_{end}"] - one["captured"], 0.4, left=one["captured"], color=colour,
                        label=f"{end} end of the range" if place == 0 else None)
            ax.axvline(one["captured"], color="0.3", linestyle="--", linewidth=0.8)
        ax.set_yticks(range(len(pairs)), [f"{number['name']}\n{ends(number)}" for number, _ in pairs])
        ax.invert_yaxis()
        ax.set_xlabel(f"captured at {pairs[0][1]['wall']}, share of the injected mass [1]" if pairs else "captured share [1]")
        ax.legend()
        return ax

    def __repr__(self) -> str:
        return f"<nearwall.Sensitivity of {len(self.record['numbers'])} numbers>"


def ends(number: Mapping[str, Any]) -> str:
    """The range of a number of `Sensitivity` in words, small lengths in µm."""
    micro = number["unit"] == "m" and abs(number["high"]) <= 2e-3 and number["scale"] == "value"
    low, high = (1e6 * number[end] if micro else number[end] for end in ("low", "high"))
    unit = "µm" if micro else {"1": "", "J/m2": "J/m²", "kg/m3": "kg/m³"}.get(number["unit"], number["unit"])
    return {"value": f"{low:.4g} to {high:.4g} {unit}".rstrip(), "factor": f"× {low:.3g} to {high:.3g}",
            "difference": f"{low:+.4g} to {high:+.4g} {unit}"}[number["scale"]]


def sensitivity(case: AnyPath, *, settings: Optional[Mapping[str, Any]] = None, particles: int = 1000,
                clean_walls: bool = False, kind: Optional[str] = None) -> Sensitivity:
    """Moves each number of a case within its range and ranks them by what the walls capture, as `nearwall sensitivity`.

    settings: numbers of the case that are changed first, as {"gas.temperature": 358.15}.
    particles: most particles that are followed for each number; clean_walls leaves out the case's deposit.
    """
    changes = [part for name, value in (settings or {}).items() for part in ("--set", f"{name}={value}")]
    with begin() as folder:
        run = Run(folder)
        run.command("sensitivity", case, "-o", run.out, "--particles", particles, *changes,
                    *(["--clean-walls"] if clean_walls else []))
        texts = run.texts()
        return Sensitivity(texts["report.html"], texts, json.loads(texts["sensitivity.json"]), run.frame("sensitivity.csv", kind))


def report(*cases: AnyPath) -> Page:
    """The page of finished OpenFOAM cases, one or several side by side, as `nearwall report`."""
    with begin() as folder:
        run = Run(folder)
        os.mkdir(run.out)
        run.command("report", *cases, "-o", os.path.join(run.out, "report.html"))
        texts = run.texts()
        return Page(texts["report.html"], texts)


def axes() -> Any:
    """The axes of a new figure."""
    import matplotlib.pyplot
    return matplotlib.pyplot.subplots(layout="constrained")[1]
