"""Runs a notebook in its own folder and looks at what it made. Called by tests/python/run.

    notebook.py NOTEBOOK
"""

import json
import pathlib
import struct
import sys

import nbclient
import nbformat

path = pathlib.Path(sys.argv[1])
notebook = nbformat.read(path, as_version=4)
nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}).execute()

# The frame of a diagnosis is shown as HTML; a figure is shown and written.
shown = [output.get("data", {}) for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
assert any("melting-transition" in data.get("text/html", "") for data in shown), "the diagnosis is not shown"
assert any("image/png" in data for data in shown), "no figure is shown"
picture = (path.parent / "out/figure.png").read_bytes()
width, height = struct.unpack(">II", picture[16:24])
assert width > 1000 and height > 400, (width, height)

# The temperature of the sticking transition that the authors state for this wax lies between 70 and 105 C.
record = json.loads((path.parent / "out/diagnosis/diagnosis.json").read_text())
melting = next(finding for finding in record["findings"] if finding["cause"] == "melting-transition")
temperature = melting["parameters"]["temperature"]
assert 343.15 < temperature["low"] < temperature["high"] < 378.15, temperature
print(f"figure of {width} x {height} pixels; transition at {temperature['value']:.1f} K, between the paper's 343 and 378 K")
