"""The pages of the book that the program and its sources state: keys, commands, materials, functions."""
import ast
import re
import subprocess

import reference_keys

FUNCTION = re.compile(r"((?:^//[^\n]*\n)+)^([a-z_0-9 ]+\*?nw_\w+\([^;]*\));", re.M)
STRUCT = re.compile(r"((?:^//[^\n]*\n)*)^typedef struct (nw_\w+) \{\n(.*?)^\} nw_\w+;", re.M | re.S)
FIELD = re.compile(r"((?:^  //[^\n]*\n)+)^  ([^/\n]+);", re.M)


def pages(command, root):
    """The text of each page by its path, with its name in the list of pages."""
    header = (root / "cpp_shim/nearwall.h").read_text(encoding="utf-8")
    return {
        "docs/reference/keys.md": ("Keys and their ranges", reference_keys.page(command)),
        "docs/reference/commands.md": ("Commands", commands(command)),
        "docs/reference/materials.md": ("Materials", materials(command)),
        "docs/reference/c-functions.md": ("C functions", c_functions(header)),
        "docs/reference/python-functions.md": ("Python functions", python_functions(root / "bindings/python/nearwall")),
    }


def said(command, *arguments):
    """What the command prints."""
    return subprocess.run([command, *arguments], check=True, capture_output=True, text=True).stdout


def block(text):
    return f"```text\n{text.rstrip()}\n```\n"


def commands(command):
    """The help of every command."""
    overview = said(command, "--help")
    names = re.findall(r"^  ([a-z]+) ", overview.split("Commands:\n")[1].split("\n\n")[0], re.M)
    helps = [f"## {name}\n\n{block(said(command, name, '--help'))}" for name in names if name != "help"]
    return f"# Commands\n\n{block(overview)}\n" + "\n".join(helps)


def materials(command):
    """Every built-in material with the source of each number."""
    names = [line.split()[0] for line in said(command, "materials").splitlines() if re.match(r"[a-z0-9-]+\s", line)]
    texts = [f"## {name}\n\n{block(said(command, 'materials', name))}" for name in names]
    return "# Materials\n\nWhat `nearwall materials NAME` prints.\n\n" + "\n".join(texts)


def comment(text):
    """A comment of C without its slashes, fit for a cell."""
    return re.sub(r"\s+", " ", re.sub(r"^\s*// ?", "", text, flags=re.M)).strip().replace("|", "\\|")


def c_functions(header):
    """Structs and functions of nearwall.h."""
    lines = ["# C functions", "", "From `nearwall.h`, which is the reference."]
    for about, signature in FUNCTION.findall(header):
        name = re.search(r"nw_\w+(?=\()", signature)[0]
        lines += ["", f"## {name}", "", f"```c\n{signature};\n```", "", comment(about)]
    for about, name, body in STRUCT.findall(header):
        lines += ["", f"## {name}", "", comment(about), "", "| field | |", "|---|---|"]
        lines += [f"| `{field}` | {comment(text)} |" for text, field in FIELD.findall(body)]
    return "\n".join(lines) + "\n"


def python_functions(folder):
    """Public functions and classes with their signatures and docstrings."""
    public = {name.id if isinstance(name, ast.Name) else name.value for name in next(
        node for node in ast.parse((folder / "__init__.py").read_text(encoding="utf-8")).body
        if isinstance(node, ast.Assign) and node.targets[0].id == "__all__").value.elts}
    lines = ["# Python functions", "", "What `help(nearwall.NAME)` prints."]
    for path in sorted(folder.glob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            shown = node.name in public if hasattr(node, "name") else False
            if shown and ast.get_docstring(node):
                lines += ["", f"## {node.name}", "", block(described(node))]
                members = [part for part in getattr(node, "body", []) if isinstance(part, ast.FunctionDef)]
                lines += [block(described(part)) for part in members
                          if not part.name.startswith("_") and ast.get_docstring(part)]
    return "\n".join(lines) + "\n"


def described(node):
    """Signature and docstring of a function, name and docstring of a class."""
    if isinstance(node, ast.ClassDef):
        return f"class {node.name}\n\n{ast.get_docstring(node)}"
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{node.name}({ast.unparse(node.args)}){returns}\n\n{ast.get_docstring(node)}"
