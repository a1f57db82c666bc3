"""Asks the command which keys each table of a model file or a case takes, in which unit and range.

The reader of files knows all of it and states it in its errors: an unknown key lists the known ones, an absurd value the
range and the unit, a wrong word the known words.
"""
import re
import subprocess
import tempfile
from pathlib import Path

PARTICLE = '[particle]\nmaterial = "coal-slag"\n'
WALL = '[walls.default]\nmaterial = "coal-slag"\n'
NORMAL = '[normal]\nmodel = "constant"\ne_n = 0.5\n'
TANGENTIAL = '[tangential]\nmodel = "constant"\ne_t = 1\n'
IMPACT = PARTICLE + WALL + NORMAL + TANGENTIAL
ROUND = 'shape = "plane"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\n'
MODEL = IMPACT.replace("[", "[model.")
AIR = "temperature = 300\ndensity = 1.2\nviscosity = 1.8e-5\nconductivity = 0.026\nheat_capacity = 1000\n"
RUN = "[run]\ntime_limit = 1\n"
GAS = '[gas]\nfield = "uniform"\nvelocity = [0, 0, 0]\n' + AIR
POINT = ('[particles]\ncount = 1\nposition = { shape = "point", at = [0, 0, 1] }\ndirection = [0, 0, -1]\n'
         "diameter = 1e-4\nspeed = 1\ntemperature = 300\n")
FLOOR = '[[walls]]\nname = "floor"\ntemperature = 300\n' + ROUND

GUESSES = {"expected a text": '"?"', "expected a list": "[1, 2]", "Celsius": "1000"}


def titled(head, lines, rest, title=None):
    return (title or head, head, lines, rest)


def model_tables(ask):
    """Title, head, lines and rest of the file for each table of a model file."""
    wall = PARTICLE + NORMAL + TANGENTIAL
    yield titled("[particle]", 'material = "coal-slag"\n', WALL + NORMAL + TANGENTIAL)
    yield titled("[walls.default]", 'material = "coal-slag"\n', wall, "[walls.NAME]")
    for part in ("shedding", "resuspension", "condensation"):
        yield titled(f"[walls.default.{part}]", "", IMPACT, f"[walls.NAME.{part}]")
    for table, key in (("normal", "model"), ("tangential", "model"), ("capture", "model"), ("erosion", "law")):
        for word in ask(f'[{table}]\n{key} = "?"\n', table):
            rest = re.sub(rf"\[{table}\]\n[^\[]*", "", IMPACT)
            yield titled(f"[{table}]", f'{key} = "{word}"\n', rest, f"[{table}] {key} = {word}")
    for kind in ask('[[effects]]\nkind = "?"\n', "effects"):
        yield titled("[[effects]]", f'kind = "{kind}"\n', IMPACT, f"[[effects]] kind = {kind}")
    yield titled("[materials.own]", 'like = "coal-slag"\n', IMPACT, "[materials.NAME]")
    yield titled("[inputs.own]", "", IMPACT, "[inputs.NAME]")


def case_tables():
    """The same for each table of a case."""
    yield titled("", 'title = "t"\n', MODEL + RUN + GAS + POINT + FLOOR, "top of the file")
    yield titled("[run]", "time_limit = 1\n", MODEL + GAS + POINT + FLOOR)
    for field, own in (("uniform", "velocity = [0, 0, 0]\n"), ("stagnation-jet", "speed = 1\nheight = 1\n"),
                       ("swirling-pipe", "axial_speed = 1\nswirl = 1\n"),
                       ("duct", 'speed = 1\nflow = "laminar"\ndirection = [1, 0, 0]\ndiameter = 1\n')):
        yield titled("[gas]", f'field = "{field}"\n{own}{AIR}', MODEL + RUN + POINT + FLOOR, f"[gas] field = {field}")
    yield titled("[particles]", POINT.partition("\n")[2], MODEL + RUN + GAS + FLOOR)
    for law in ("first-order", "fixed-rate"):
        yield titled("[conversion]", f'law = "{law}"\n', MODEL + RUN + GAS + POINT + FLOOR, f"[conversion] law = {law}")
    yield titled("[deposit]", "duration = 1\n", MODEL + RUN + GAS + POINT + FLOOR)
    yield titled("[[walls]]", FLOOR.partition("\n")[2], MODEL + RUN + GAS + POINT)
    yield titled("[walls.cooling]", "coolant_temperature = 300\n",
                 MODEL + RUN + GAS + POINT + FLOOR.replace("temperature = 300\n", ""), "cooling of a wall")
    yield titled("[sweep]", 'key = "speed"\nvalues = [1, 2]\n', MODEL + RUN + GAS + POINT + FLOOR)


class Asker:
    """Runs the command on files with one fault."""

    def __init__(self, command, folder):
        self.command = command
        self.folder = Path(folder)

    def fault(self, text, case=False):
        """The error for a file; empty where it is accepted."""
        path = self.folder / "asked.toml"
        path.write_text(text, encoding="utf-8")
        arguments = ["simulate", path, "-o", self.folder / "out"] if case else ["check", path]
        try:
            done = subprocess.run([self.command, *arguments], capture_output=True, text=True, timeout=5)
        except subprocess.TimeoutExpired:
            return ""
        return done.stderr

    def words(self, text):
        """The words known in the place of `?`."""
        known = re.search(r"\(known here: ([^)]*)\)", text)
        return known[1].split(", ") if known else []

    def asked_words(self, lines, table):
        """The words known for a table's key `?`."""
        return self.words(self.fault(re.sub(rf"\[{table}\]\n[^\[]*", "", IMPACT) + lines))

    def completed(self, head, lines, rest, case):
        """The lines with the keys that the table requires, and the known keys."""
        guesses = {}
        for _ in range(40):
            own = lines + "".join(f"{key} = {value}\n" for key, value in guesses.items())
            said = self.fault(joined(head, own + "zz_unknown = 1\n", rest), case)
            if "unknown key `zz_unknown`" in said:
                return own, self.words(said)
            missing = re.search(r"missing; add .* named `(\w+)`", said)
            at = re.search(r":\d+: (?:[\w.\[\]]+\.)?(\w+): ", said)
            if missing:
                guesses[missing[1]] = "1"
            elif at and at[1] in guesses and self.words(said):
                guesses[at[1]] = f'"{self.words(said)[0]}"'
            elif at and at[1] in guesses:
                guesses[at[1]] = next_guess(said)
            else:
                break
        raise SystemExit(f"docs/build: no keys of {head}: {said}")

    def row(self, key, head, lines, rest, case):
        """What a key takes and its range."""
        others = re.sub(rf"^{re.escape(key)} = .*\n", "", lines, flags=re.M)
        said = self.fault(joined(head, f"{others}{key} = -1e301\n", rest), case)
        limits = re.search(r"is outside (?:the allowed range )?\(?([^;()]*[^;() ])", said)
        if limits:
            unit = re.search(r"check the exponent and the unit, (.*)", said)
            return f"| `{key}` | number | {limits[1].strip()} | {unit[1] if unit else ''} |"
        kind = re.search(r"expected (.*?), found", said)
        if kind and "text" in kind[1] and "list" not in kind[1]:
            words = self.words(self.fault(joined(head, f'{others}{key} = "?"\n', rest), case))
            return f"| `{key}` | {one_of(words)} | | |"
        return f"| `{key}` | {kind[1] if kind else ''} | | |"


def next_guess(said):
    """A value of the kind that an error asks for."""
    limits = re.search(r"allowed range (\S+) to (\S+)", said)
    if limits:
        return limits[1] if float(limits[1]) else limits[2]
    return next((value for word, value in GUESSES.items() if word in said), "0.5")


def one_of(words):
    """How a cell states the words that a key takes."""
    if "tungsten" in words:
        return "a [material](materials.md)"
    return "one of " + ", ".join(f"`{word}`" for word in words) if words else "text"


def joined(head, lines, rest):
    """A file with the table in it; a table of a wall follows its wall."""
    return f"{lines}{rest}" if not head else f"{rest}{head}\n{lines}"


def page(command):
    """The page with a table of keys for each table of both files."""
    lines = ["# Keys and their ranges", "", "What the program accepts, asked from it. Meaning and defaults: "
             "[model file](model-file.md), [case file](case-file.md)."]
    with tempfile.TemporaryDirectory() as folder:
        asker = Asker(command, folder)
        for name, tables, case in (("Model file", model_tables(asker.asked_words), False),
                                   ("Case file", case_tables(), True)):
            lines += ["", f"## {name}"]
            for title, head, own, rest in tables:
                own, keys = asker.completed(head, own, rest, case)
                lines += ["", f"### {title}", "", "| key | takes | range | unit |", "|---|---|---|---|"]
                lines += [asker.row(key, head, own, rest, case) for key in keys
                          if f" {key} = " not in title]
    return "\n".join(lines) + "\n"
