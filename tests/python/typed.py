"""A user's program, for mypy --strict. Called by tests/python/run."""

import numpy
import pandas
from numpy.typing import NDArray

import nearwall

model: nearwall.Model = nearwall.Model.from_file("nearWall.toml")
v_n: NDArray[numpy.float64] = numpy.linspace(0.1, 1.0, 10)
out = model.resolve(v_n, seed=1)
e_n: NDArray[numpy.float64] = out.e_n
first: float = float(out.p_stick[0])
ranges: nearwall.TemperatureRanges = model.temperature_ranges()

frame: pandas.DataFrame = nearwall.predict(pandas.DataFrame({"v_n": v_n}), model, wall="default")
found: nearwall.Diagnosis = nearwall.diagnose(frame, model, seed=2)
for finding in found.findings:
    for name, parameter in finding.parameters.items():
        low: float = parameter.low
        print(finding.cause, name, low)
if found.gain is not None:
    ratio: tuple[float, float] = found.gain.ci95
extended: nearwall.Model = found.model

density: float | None = nearwall.materials("tungsten", 2000.0)["tungsten"]["density"].value
simulation: nearwall.Simulation = nearwall.simulate("rig.toml", kind="pandas")
case = nearwall.openfoam.Case("run")
clouds: list[str] = case.clouds
deposit = nearwall.Deposit(0)
source = nearwall.DepositSource()
model.add_captured(source, 1e-6, 2300.0, 900.0, d=1e-5)
deposit.add(source)
try:
    model.explain(1.0)
    model.beyond(1.0)
except nearwall.Error as error:
    status: int | None = error.status
