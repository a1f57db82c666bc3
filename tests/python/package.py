"""The installed Python package against the command, the golden table and itself. Called by tests/python/run.

    package.py arrays|frames|findings|pages|errors|alone ROOT COMMAND
"""

import csv
import ctypes
import html
import importlib.metadata
import json
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
import tracemalloc
import warnings

import numpy

import nearwall

part, root, command = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
assert nearwall.__version__ == importlib.metadata.version("nearwall") == nearwall.VERSION
assert root not in pathlib.Path(nearwall.__file__).parents, f"{nearwall.__file__} is not the installed package"
warnings.simplefilter("ignore")
wax = root / "tutorials/waxImpactor/measured"
impacts, model_file = root / "bindings/impacts/impacts.csv", root / "bindings/impacts/nearWall.toml"
#: Sets of real measurements with a model, a column map, and what else they need.
SETS = {name: root / "tests/real_measurements" / name for name in ("squash-ball-temperature", "ping-pong-bounces", "tennis-ball-two-methods")}


def run(*arguments):
    return subprocess.run([command, *map(str, arguments)], capture_output=True, text=True)


def refused(call, kind=nearwall.Error):
    try:
        call()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind.__name__}")


def same(one, other, what):
    one, other = numpy.asarray(one), numpy.asarray(other)
    if one.dtype.kind == "f":
        one, other = one.view(numpy.uint64), numpy.asarray(other, float).view(numpy.uint64)
    assert one.shape == other.shape and (one == other).all(), f"{what}: {one} and {other}"


def in_polars(table):
    """The same table as a polars frame, without pyarrow."""
    import pandas
    import polars
    return polars.DataFrame({name: [None if value is pandas.NA else value for value in table[name].tolist()] for name in table})


def arrays():
    """The golden table of 40 digits; arrays are read in place; many threads share a model."""
    compare = (root / "tests/bindings/compare.py").read_text()
    golden_model = re.search(r'GOLDEN_MODEL = """(.*?)"""', compare, re.DOTALL).group(1)
    with open(root / "tests/data/thornton_ning.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    worst = 0.0
    for row in rows:
        model = nearwall.Model.from_toml(golden_model.format(**row))
        v_n, d, expected = float(row["v_n"]), float(row["d"]), float(row["e_n"])
        out = model.resolve(v_n, d=d)
        table = nearwall.predict({"v_n": [v_n], "d": [d]}, model)
        same(table["e_n"], out.e_n, "predict and resolve")
        assert abs(out.e_n[0] - expected) <= max(1e-11 * expected, 1e-9), row
        worst = max(worst, abs(out.e_n[0] / expected - 1) if expected > 0.01 else 0)

    model = nearwall.Model.from_file(model_file)
    count = 2_000_000
    v_n, d = numpy.linspace(0.1, 10, count), numpy.full(count, 5e-5)
    fixed = dict(T_p=1300.0, T_w=1100.0)
    reference = model.resolve(v_n, d=d, **fixed)
    # In place: the function is given the address of the caller's memory, and nothing of the size of an input is allocated
    # beside the outcomes and the two inputs that are numbers.
    seen = []
    function = nearwall.library._library.nw_resolve_batch

    class Spy:
        def __getattr__(self, name):
            return spy if name == "nw_resolve_batch" else getattr(library, name)

    def spy(handle, batch, *others):
        seen.append((batch._obj.v_n, batch._obj.d))
        return function(handle, batch, *others)

    library, nearwall.library._library = nearwall.library._library, Spy()
    try:
        model.resolve(v_n, d=d, **fixed)
    finally:
        nearwall.library._library = library
    assert seen == [(v_n.ctypes.data, d.ctypes.data)], seen
    tracemalloc.start()
    model.resolve(v_n, d=d, **fixed)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    outcomes = sum(column.nbytes for column in reference)
    assert peak < outcomes + 2 * v_n.nbytes + 1e6, f"{peak} bytes for outcomes of {outcomes}"
    before = v_n.copy()
    same(model.resolve(v_n[::2], d=d[:count // 2], **fixed).e_n, reference.e_n[::2], "with gaps")

    again = pickle.loads(pickle.dumps(model))
    found = [None] * 4
    threads = [threading.Thread(target=lambda i=i: found.__setitem__(i, again.resolve(v_n, d=d, **fixed))) for i in range(4)]
    [thread.start() for thread in threads], [thread.join() for thread in threads]
    for outcome in found:
        same(outcome.e_n, reference.e_n, "threads")
    same(v_n, before, "the inputs")
    print(f"400 golden cases to {worst:.1e}; {count} impacts without a copy, from 4 threads the same bits")


def frames():
    """pandas, polars, dict and file give the command's numbers, bit for bit."""
    import pandas
    import polars

    done = run("predict", "--model", model_file, impacts)
    expected = list(csv.DictReader(done.stdout.splitlines()))
    table = pandas.read_csv(impacts)
    tables = {"pandas": table, "polars": in_polars(table), "dict": {name: table[name].to_numpy() for name in table},
              "file": impacts}
    for name, given in tables.items():
        found = nearwall.predict(given, model_file)
        assert type(found) is (pandas.DataFrame if name == "file" else type(given)), name
        for column in ("v_n", "T_w", "e_n", "e_t", "p_stick"):
            same(numpy.asarray(found[column], float), [float(row[column]) for row in expected], f"{name}, {column}")
        assert list(found["regime"]) == [row["regime"] for row in expected], name
    assert list(table.columns) == ["v_n", "v_t", "d", "T_p", "T_w"], "the frame that was handed over has changed"
    assert isinstance(nearwall.predict(impacts, model_file, kind="polars"), polars.DataFrame)

    # Rows that cannot be used keep their places; blanks take the default; a column of a frame keeps its name.
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        gaps = nearwall.predict(pandas.DataFrame({"v_n": [1.0, None, -2.0], "d": [None, 1e-5, 1e-5], "e_n": [0.1, 0.2, 0.3]},
                                                 index=[7, 8, 9]), model_file)
    assert list(gaps.index) == [7, 8, 9] and list(gaps.e_n) == [0.1, 0.2, 0.3]
    assert gaps.e_n_predicted.notna().tolist() == [True, False, False] and gaps.regime.isna().tolist() == [False, True, True]
    text = "\n".join(str(warning.message) for warning in said)
    assert "2 rows left out: line 3: v_n is blank; line 4: v_n = -2" in text, text
    default = nearwall.Model.from_file(model_file).resolve(1.0)
    same(gaps.e_n_predicted.iloc[:1], default.e_n, "a blank diameter")

    # Kinds of columns: integers, nullable numbers, categories, words of a declared input, numbers as text.
    plain = nearwall.Model.from_toml((root / "tests/bindings/module.py").read_text().split('PLAIN = """')[1].split('"""')[0])
    kinds = pandas.DataFrame({"v_n": pandas.array([1, None, 3], "Int64"), "v_t": ["1", "1.0", "1e0"],
                              "plate": pandas.Categorical(["glass", "steel", "glass"]), "humidity": pandas.Series([0, 1, 1], dtype="int8")})
    for given in (kinds, in_polars(kinds)):
        found = nearwall.predict(given, plain)
        numbers = [numpy.asarray(found[name], float) for name in ("e_n", "e_t")]
        assert numpy.allclose(numbers[0], [0.5, numpy.nan, 0.7], atol=1e-15, equal_nan=True), numbers
        assert numpy.allclose(numbers[1], [0.66, numpy.nan, 0.66], atol=1e-15, equal_nan=True), numbers

    # Blanks of every kind in a column of words.
    blank = pandas.DataFrame({"v_n": 1.0, "v_t": 1.0, "plate": ["glass", None, float("nan"), pandas.NA, pandas.NaT, ""]})
    for given in (blank, {name: blank[name].to_numpy() for name in blank}):
        e_t = numpy.asarray(nearwall.predict(given, plain)["e_t"])
        assert numpy.allclose(e_t, [0.66, 0.76, 0.76, 0.76, 0.76, 0.76], atol=1e-15), e_t

    # A whole case: the files of the command, and the same impacts as a frame.
    case = root / "tutorials/standalone/waxRig.toml"
    simulation = nearwall.simulate(case)
    simulation.save("simulated")
    assert run("simulate", case, "-o", "commanded").returncode == 0
    for file in ("summary.json", "impacts.csv", "report.html"):
        assert pathlib.Path("simulated", file).read_bytes() == pathlib.Path("commanded", file).read_bytes(), file
    rows = pandas.read_csv("commanded/impacts.csv")
    same(simulation.impacts.v_n, rows.v_n, "impacts of a case")
    assert "<iframe" in simulation._repr_html_()

    # Tungsten at room temperature has 19250 kg/m3 in any handbook.
    tungsten = nearwall.materials("tungsten")["tungsten"]
    assert abs(tungsten["density"].value / 19250 - 1) < 0.01 and tungsten["density"].source
    printed = run("materials").stdout.split("\n")
    assert [line.split()[0] for line in printed if line] == list(nearwall.materials())
    print(f"{len(expected)} rows from {len(tables)} kinds of table with the command's bits; a case with its files")


def findings():
    """The files of `nearwall diagnose`, byte for byte from the same file; the same findings from frames."""
    import pandas
    import polars

    count = 0
    for name, folder in SETS.items():
        out = pathlib.Path(f"commanded-{name}")
        arguments = ["--columns", folder / "columns.toml", "--draws", 3, "--out", out]
        done = run("diagnose", folder / "data.csv", "--model", folder / "base.toml", *arguments)
        assert done.returncode == 0, done.stderr
        found = nearwall.diagnose(folder / "data.csv", folder / "base.toml", columns=folder / "columns.toml", draws=3)
        found.save(f"found-{name}")
        files = sorted(path.relative_to(out) for path in out.rglob("*") if path.is_file())
        assert {pathlib.Path(file) for file in ("diagnosis.json", "extended.toml", "report.html")} <= set(files)
        for file in files:
            assert (out / file).read_bytes() == pathlib.Path(f"found-{name}", file).read_bytes(), f"{name}: {file}"
        assert sum(path.is_file() for path in pathlib.Path(f"found-{name}").rglob("*")) == len(files)

        # Lines of a frame count from its header; those of the file have comments before them. All else is equal.
        lines = ("rows", "fit", "verdict")
        table = pandas.read_csv(folder / "data.csv", comment="#")
        record = {key: value for key, value in found.record.items() if key not in lines}
        for given in (table, in_polars(table), {column: table[column].to_numpy() for column in table}):
            again = nearwall.diagnose(given, nearwall.Model.from_file(folder / "base.toml"), columns=folder / "columns.toml", draws=3)
            assert {key: value for key, value in again.record.items() if key not in lines} == record, name
            assert (again.extended_toml, again.draws) == (found.extended_toml, found.draws), name
        count += len(found.findings)
        for finding in found.findings:
            assert finding.cause in found._repr_html_() and finding.cause in finding._repr_html_()
        if found.gain:
            assert found.gain.rmse_before == found.record["gain"]["rmse_before"] and str(found.gain.held_out_rows) in found.gain._repr_html_()

    # The extended model is a model: its gain is what anyone computes from predictions.
    folder = SETS["squash-ball-temperature"]
    found = nearwall.diagnose(folder / "data.csv", folder / "base.toml", columns=folder / "columns.toml")
    table = pandas.read_csv(folder / "data.csv", comment="#").assign(T_p=lambda rows: rows.T_C + 273.15)
    rms = [((nearwall.predict(table, model).e_n_predicted - table.e_n) ** 2).mean() ** 0.5
           for model in (folder / "base.toml", found.model)]
    assert abs(rms[0] / found.record["base"]["rmse_e_n"] - 1) < 1e-9, (rms, found.record["base"])
    assert rms[1] < 0.1 * rms[0], rms

    # A planted effect comes back, and pure noise has no finding: numbers of NumPy, not of this library.
    generator = numpy.random.default_rng(18)
    rows = 300
    speed, humidity = generator.uniform(1, 5, rows), generator.uniform(0, 1, rows)
    noise = generator.normal(0, 0.02, rows)
    for effect, causes in ((0.0, []), (0.2, ["unknown:humidity"])):
        measured = {"v_n": speed, "d": numpy.full(rows, 0.04), "humidity": humidity, "e_n": 0.43 + effect * (humidity - 0.5) + noise}
        planted = nearwall.diagnose(measured, folder / "base.toml")
        assert [finding.cause for finding in planted.findings] == causes, planted
    drop = numpy.interp([0.2, 0.8], [0, 1], [-0.1, 0.1])
    out = planted.model.resolve(numpy.full(2, 3.0), d=0.04, humidity=numpy.array([0.2, 0.8]))
    assert abs(out.e_n - (0.43 + drop)).max() < 0.01, out.e_n
    wax_found = nearwall.diagnose(wax / "troiano.csv", wax / "base.toml")
    temperature = wax_found.findings[0].parameters["temperature"]
    assert temperature.low < temperature.value < temperature.high and temperature.unit == "K" and "K" in str(temperature)
    print(f"{len(SETS)} sets with the command's bytes, {count} findings; a planted effect found, noise left alone")


def pages():
    """Columns of frames go into `resolve`; comparison, map, sensitivity, report, check and rigs give the command's files."""
    import pandas
    import polars

    model = nearwall.Model.from_file(model_file)
    fixed = dict(d=5e-5, T_p=1300.0, T_w=1100.0)
    expected = model.resolve(numpy.array([1.0, 2.0, 3.0]), **fixed)
    kinds = [pandas.Series([1, 2, 3]), pandas.Series([1, 2, 3], dtype="Int64"), pandas.DataFrame({"a": [1.0, 2, 3], "b": 0.0})["a"],
             polars.Series([1, 2, 3])]
    for given in kinds:
        same(model.resolve(given, **fixed).e_n, expected.e_n, str(type(given)))
    refused(lambda: model.resolve(pandas.Series([1, None], dtype="Int64"), **fixed))

    folder = SETS["squash-ball-temperature"]
    base, softer = folder / "base.toml", pathlib.Path("softer.toml")
    softer.write_text(base.read_text().replace("e_n = 0.", "e_n = 0.1"))
    case = root / "tutorials/standalone/waxRig.toml"
    rig = root / "validation/rigs/wax"
    calls = [
        (("compare", folder / "data.csv", "--models", base, softer, "--columns", folder / "columns.toml", "--out"),
         lambda: nearwall.compare(folder / "data.csv", [base, softer], columns=folder / "columns.toml")),
        (("map", model_file, "--x", "v_n=0.1:30:9", "--y", "T_p=1000:2000:7", "--set", "T_w=1200", "-o"),
         lambda: nearwall.map(model_file, ("v_n", 0.1, 30, 9), ("T_p", 1000, 2000, 7), fixed={"T_w": 1200})),
        (("map", model_file, "--x", "v_n=0.1:30:9", "--y", "T_p=1000:2000:7", "--slider", "d=1e-5:1e-4:3", "-o"),
         lambda: nearwall.map(model_file, ("v_n", 0.1, 30, 9), ("T_p", 1000, 2000, 7), slider=("d", 1e-5, 1e-4, 3))),
        (("sensitivity", case, "--particles", 20, "-o"), lambda: nearwall.sensitivity(case, particles=20)),
        (("diagnose", rig / "measured.csv", "--case", rig / "case.toml", "--out"),
         lambda: nearwall.diagnose(rig / "measured.csv", case=rig / "case.toml")),
    ]
    for arguments, call in calls:
        name = arguments[0] + ("-slider" if "--slider" in arguments else "")
        done = run(*arguments, f"commanded-{name}")
        assert done.returncode == 0, done.stderr
        found = call()
        found.save(f"found-{name}")
        files = sorted(path.relative_to(f"commanded-{name}") for path in pathlib.Path(f"commanded-{name}").rglob("*") if path.is_file())
        assert files
        for file in files:
            assert pathlib.Path(f"commanded-{name}", file).read_bytes() == pathlib.Path(f"found-{name}", file).read_bytes(), file
        shown = html.escape(found.verdict) if name == "diagnose" else "<iframe"
        assert shown in found._repr_html_(), name

    # Frames and models that are no files; the pages draw themselves.
    table = pandas.read_csv(folder / "data.csv", comment="#")
    ranked = nearwall.compare(table, [nearwall.Model.from_file(base), nearwall.Model.from_file(softer)], columns=folder / "columns.toml")
    assert ranked.ranking == ["base.toml", "softer.toml"], ranked.ranking
    # A first cell that begins like a comment is a row, and a label stays one.
    odd = {"series": ["#1", "b"] * 12, "v_n": numpy.linspace(1, 3, 24), "d": numpy.full(24, 0.04), "e_n": numpy.linspace(0.4, 0.5, 24)}
    assert nearwall.compare(odd, [base, softer]).record["rows"]["read"] == 24
    assert "nearwall-" not in ranked.html and len(ranked.plot("rmse_e_n").lines) > 0
    drawn = calls[1][1]()
    assert len(drawn.frame) == 63 and drawn.plot().collections
    # The cube has the values of the frame at their places, and the units are those of the command.
    series = calls[2][1]()
    cube = series.to_xarray()
    assert dict(cube.sizes) == {"d": 3, "T_p": 7, "v_n": 9}
    for row in series.frame.sample(20, random_state=1).itertuples():
        cell = cube.sel(v_n=row.v_n, T_p=row.T_p, d=row.d)
        assert float(cell.p_stick) == row.p_stick and cell.regime.item() == row.regime
    axes = series.plot(at=1e-5)
    assert axes.get_title() == "d = 1e-05 m" and axes.get_xlabel() == "v_n [m/s]"
    units = dict(re.findall(r"(\w+) \[([^\]]+)\][,.]", run("map", "--help").stdout))
    assert units == nearwall.pages.UNITS, units
    axes = calls[3][1]().plot()
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert axes.patches and any("of the particles" in name and " to " in name for name in names), names

    done = run("check", model_file)
    assert nearwall.check(model_file) == done.stdout.rstrip() and nearwall.check(model).split("\n")[1:] == done.stdout.rstrip().split("\n")[1:]
    assert "no such folder" in refused(lambda: nearwall.report("nowhere"))
    assert "unknown input `v_m`" in refused(lambda: nearwall.map(model_file, ("v_m", 1, 2)))
    assert "nowhere.toml" in refused(lambda: nearwall.compare(table, [base, "nowhere.toml"]))
    script = subprocess.run([pathlib.Path(sys.executable).parent / "nearwall", "--version"], capture_output=True, text=True)
    assert script.stdout == run("--version").stdout and script.returncode == 0, script
    usage = subprocess.run([pathlib.Path(sys.executable).parent / "nearwall", "map"], capture_output=True, text=True)
    assert usage.returncode == run("map").returncode == 2 and usage.stderr == run("map").stderr
    print(f"{len(calls)} pages with the command's bytes; columns of {len(kinds)} kinds")


def errors():
    """The command's words; Ctrl-C; no crash on nonsense."""
    pathlib.Path("bad.toml").write_text(model_file.read_text().replace("[normal]", "[normal]\nyield_ration = 1"))
    pathlib.Path("few.csv").write_text("v_n,e_n\n1,0.5\n2,oops\n")
    pathlib.Path("speed.csv").write_text("speed,d\n1,1e-5\n")
    pathlib.Path("broken.csv").write_bytes(b"PK\x03\x04 v_n,e_n\n1,\x00\xfe\n")
    pathlib.Path("west.csv").write_bytes("v_n,e_n,Prüfer\n1,0.5,Jörg\n".encode("latin-1"))
    pathlib.Path("map.toml").write_text("[columns]\nvn = 3\n")
    base = SETS["squash-ball-temperature"]
    data, model = base / "data.csv", base / "base.toml"
    pairs = [
        (("predict", "--model", "bad.toml", impacts), lambda: nearwall.predict(impacts, "bad.toml")),
        (("predict", "--model", "nowhere.toml", impacts), lambda: nearwall.predict(impacts, "nowhere.toml")),
        (("predict", "--model", model_file, "nowhere.csv"), lambda: nearwall.predict("nowhere.csv", model_file)),
        (("predict", "--model", model_file, "speed.csv"), lambda: nearwall.predict("speed.csv", model_file)),
        (("predict", "--model", model_file, impacts, "--wall", "flor"), lambda: nearwall.predict(impacts, model_file, wall="flor")),
        (("predict", "--model", model_file, impacts, "--draws", "nowhere"), lambda: nearwall.predict(impacts, model_file, draws="nowhere")),
        (("diagnose", "few.csv", "--model", model, "--out", "x"), lambda: nearwall.diagnose("few.csv", model)),
        (("diagnose", data, "--model", "bad.toml", "--out", "x"), lambda: nearwall.diagnose(data, "bad.toml")),
        (("diagnose", data, "--model", model, "--columns", "map.toml", "--out", "x"), lambda: nearwall.diagnose(data, model, columns="map.toml")),
        (("diagnose", data, "--model", model, "--group", "batch", "--out", "x"), lambda: nearwall.diagnose(data, model, group="batch")),
        (("simulate", "nowhere.toml"), lambda: nearwall.simulate("nowhere.toml")),
        (("simulate", model_file), lambda: nearwall.simulate(model_file)),
        (("materials", "tungstn"), lambda: nearwall.materials("tungstn")),
    ]
    for arguments, call in pairs:
        done = run(*arguments)
        printed = done.stderr.strip().split("\n")[-1].removeprefix("nearwall: ")
        text = refused(call)
        assert done.returncode == 1 and text.split("\n")[-1] == printed, f"{arguments}: {text} and {printed}"

    assert "frame:1: there is no column `v_n`" in refused(lambda: nearwall.predict({"speed": [1.0]}, model_file))
    text = refused(lambda: nearwall.diagnose({"v_n": [1.0, 2.0], "e_n": ["0.5", "oops"]}, model))
    assert text.startswith("frame: 1 of 2 rows can be used") and "Line 3: e_n `oops` is not a number" in text, text
    assert "different lengths: 1, 2" in refused(lambda: nearwall.predict({"v_n": [1.0, 2.0], "d": [1e-5]}, model_file), ValueError)
    assert "has shape (1, 2)" in refused(lambda: nearwall.predict({"v_n": [[1.0, 2.0]]}, model_file), ValueError)
    assert "not builtins.list" in refused(lambda: nearwall.predict([1.0], model_file), TypeError)
    assert "between 0 and 0.5" in refused(lambda: nearwall.diagnose(data, model, level=0.7), ValueError)
    assert "5.0 to 2.0 is no range" in refused(lambda: nearwall.diagnose(data, model, reach={"v_n": (5, 2)}), ValueError)
    assert "cannot vary `speed`" in refused(lambda: nearwall.diagnose(data, model, reach={"speed": (2, 5)}))
    assert "positive number of kelvin" in refused(lambda: nearwall.materials(temperature=float("nan")))
    assert "is no text; save it as CSV" in refused(lambda: nearwall.predict("broken.csv", model_file))
    assert numpy.isfinite(nearwall.predict("west.csv", model_file)["e_n"]).tolist() == [True]
    for nonsense in ({}, {"v_n": []}, {"v_n": [""]}, {"": [1.0]}, {"v_n": [1.0], " v_n": [2.0]}, {"#v_n": ["#1"]}):
        assert refused(lambda nonsense=nonsense: nearwall.predict(nonsense, model_file)), nonsense
    # Cells that would break a CSV file stay what they are.
    odd = {"note": ["#1, \"a\"\nb", ""], "v_n": [1.0, 1e-300], "é": [None, "x"]}
    assert numpy.isfinite(nearwall.predict(odd, model_file)["e_n"]).all()

    # Ctrl-C ends a call long before its end, and the package works afterwards.
    start = time.monotonic()
    nearwall.predict({"v_n": numpy.linspace(0.1, 10, 500_000)}, model_file)
    whole = 16 * (time.monotonic() - start)
    table = {"v_n": numpy.linspace(0.1, 10, 8_000_000)}
    # The caller of the tests may ignore the signal, as a shell does for its background jobs. Python then leaves it ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    start = time.monotonic()
    refused(lambda: nearwall.predict(table, model_file), KeyboardInterrupt)
    taken = time.monotonic() - start
    assert taken < 0.5 + 0.6 * whole, f"{taken:.1f} s of {whole:.1f} s"
    assert nearwall.predict({"v_n": [1.0]}, model_file)["p_stick"][0] >= 0
    # Who ignores the signal gets the whole answer, as from any call of Python.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
    assert len(nearwall.predict({"v_n": table["v_n"][:500_000]}, model_file)["p_stick"]) == 500_000
    print(f"{len(pairs)} errors with the command's words; Ctrl-C after {taken:.1f} s of {whole:.1f} s")


def alone():
    """NumPy is all that is installed."""
    refused(lambda: __import__("pandas"), ImportError)
    found = nearwall.predict(impacts, model_file)
    done = run("predict", "--model", model_file, impacts)
    expected = [float(row["e_n"]) for row in csv.DictReader(done.stdout.splitlines())]
    assert isinstance(found, dict)
    same(found["e_n"], expected, "file")
    base = SETS["squash-ball-temperature"]
    diagnosis = nearwall.diagnose(base / "data.csv", base / "base.toml", columns=base / "columns.toml")
    assert diagnosis.findings[0].cause == "unknown:T_p" and diagnosis.model.resolve(1.0, d=0.04).e_n[0] > 0
    assert json.loads(json.dumps(diagnosis.record)) == diagnosis.record
    assert ctypes.sizeof(nearwall.library.nw_impact) > 0 and isinstance(nearwall.simulate(root / "tutorials/standalone/waxRig.toml").impacts, dict)
    print(f"Python {sys.version.split()[0]}, NumPy {numpy.__version__}")


{"arrays": arrays, "frames": frames, "findings": findings, "pages": pages, "errors": errors, "alone": alone}[part]()
