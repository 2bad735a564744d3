"""Moves modules into groups, and rewrites all that names them. Run at the root of a checkout; safe to run again."""

import ast
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from move_table import ALGORITHMS, DATA, GEOMETRY, KEPT, LESSONS, TOP

ROOT = Path.cwd()
PARTS = {"workbench.geometry": GEOMETRY, "workbench.algorithms": ALGORITHMS, "workbench.data": DATA, "workbench": TOP}
MOVED = {f"{part}.{old}": f"{part}.{group}.{new}"
         for part, groups in PARTS.items() for group, (_, names) in groups.items() for new, old in names.items()}
MOVED |= {f"workbench.{old}": f"lessons.{lesson}.{new}" for lesson, names in LESSONS.items() for new, old in names.items()}
# a package that has the name of an old module hands on its names
SAME = {old: new for old, new in MOVED.items() if new.startswith(old + ".")}
ONLY = MOVED.keys() - SAME.keys()


def git(*words):
    return subprocess.run(["git", *words], check=True, capture_output=True, text=True).stdout


def path_of(name):
    return Path(*name.split(".")).with_suffix(".py")


def move():
    for old, new in MOVED.items():
        here, there = path_of(old), path_of(new)
        if here.exists() and not (old in {f"workbench.{kept}" for kept in KEPT} and there.exists()):
            there.parent.mkdir(exist_ok=True)
            git("mv", str(here), str(there))
    for part, groups in PARTS.items():
        for group, (line, names) in groups.items():
            init(part, group, line, names)
    for kept in KEPT:
        old = f"workbench.{kept}"
        text = f'"""The name that lessons of before import: see `{MOVED[old]}`."""\n\nfrom {MOVED[old]} import *  # noqa: F403\n'
        path_of(old).write_text(text)
        git("add", str(path_of(old)))


def init(part, group, line, names):
    folder = Path(*part.split("."), group)
    rows = []
    others = sorted(path.stem for path in folder.glob("[!_]*.py") if path.stem not in names)
    for stem in [*names, *others]:
        doc = ast.get_docstring(ast.parse((folder / f"{stem}.py").read_text())).split("\n")[0]
        rows.append(f"- `{stem}`: {doc[0].lower() + doc[1:] if doc[1:2].islower() else doc}")
    text = f'"""{line}\n\n' + "\n".join(wrapped(row) for row in rows) + '\n"""\n'
    old = f"{part}.{group}"
    if old in SAME:
        tree = ast.parse(path_of(SAME[old]).read_text())
        public = []
        for node in tree.body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef):
                public.append(node.name)
            elif isinstance(node, ast.Assign | ast.AnnAssign):
                targets = node.targets if isinstance(node, ast.Assign) else [node.target]
                parts = [part for target in targets for part in (target.elts if isinstance(target, ast.Tuple) else [target])]
                public += [part.id for part in parts if isinstance(part, ast.Name)]
        public = sorted({name for name in public if not name.startswith("_")})
        text += f"\nfrom {SAME[old]} import (\n" + "".join(f"    {name},\n" for name in public) + ")\n"
        text += "\n__all__ = [\n" + "".join(f'    "{name}",\n' for name in public) + "]\n"
    (folder / "__init__.py").write_text(text)
    git("add", str(folder / "__init__.py"))


def wrapped(row, width=98):
    import textwrap
    return "\n".join(textwrap.wrap(row, width, subsequent_indent="  "))


def alternation(names):
    return "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True))


DOTTED = re.compile(rf"(?<![\w.])({alternation(ONLY)})(?![\w(]|\.(?:py|md)\b)")
PATHS = re.compile(rf"(?<![\w/])({alternation(str(path_of(old)) for old in MOVED)})(?!\w)")
REFERENCE = re.compile(rf"(?m)^(::: )({alternation(SAME)})$")


def rewritten(path, text):
    if path.suffix == ".py":
        text = split_imports(text)
        inside = ".".join(path.parts[:-1])
        for old, new in SAME.items():
            if inside == old:  # a sibling
                if path.name != "__init__.py":
                    text = re.sub(rf"(?m)^(\s*from ){re.escape(old)}(?= import (?!{new.rpartition('.')[2]}\b))", rf"\g<1>{new}", text)
    text = PATHS.sub(lambda found: str(path_of(MOVED[found[1].removesuffix(".py").replace("/", ".")])), text)
    text = REFERENCE.sub(lambda found: found[1] + SAME[found[2]], text)
    text = QUOTED.sub(quoted, text)
    text = PATCHED.sub(patched, text)
    return DOTTED.sub(lambda found: MOVED[found[1]], text)


PATCHED = re.compile(rf"""(?<=["'])({alternation(SAME)})\.(\w+)(?=["'])""")


def patched(found):
    """A name of a module that is put in another's place, as tests do."""
    sub = f"{found[1]}.{found[2]}"
    return sub if path_of(sub).exists() else f"{SAME[found[1]]}.{found[2]}"


QUOTED = re.compile(r"from (workbench(?:\.\w+)?) import (\w+)(?=[;\n\\])")


def quoted(found):
    """One import that stands in a string."""
    new = MOVED.get(f"{found[1]}.{found[2]}")
    return f"from {new.rpartition('.')[0]} import {new.rpartition('.')[2]}" if new and f"{found[1]}.{found[2]}" in ONLY else found[0]


PARENTS = {old.rpartition(".")[0] for old in MOVED}


def split_imports(text):
    try:
        tree = ast.parse(text)
    except SyntaxError:
        return text
    lines = text.splitlines(keepends=True)
    for node in sorted((n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)), key=lambda n: -n.lineno):
        if node.level or node.module not in PARENTS:
            continue
        names = [(f"{node.module}.{alias.name}", alias) for alias in node.names]
        if not any(name in MOVED for name, _ in names):
            continue
        by = {}
        for name, alias in names:
            new = MOVED.get(name, name)
            parent, _, stem = new.rpartition(".")
            known = alias.asname or alias.name
            by.setdefault(parent, []).append(stem if stem == known else f"{stem} as {known}")
        indent = " " * node.col_offset
        lines[node.lineno - 1 : node.end_lineno] = [f"{indent}from {parent} import {', '.join(said)}\n" for parent, said in by.items()]
    return "".join(lines)


def main():
    move()
    for name in git("ls-files").split("\n"):
        path = Path(name)
        if not name or not path.is_file() or path.is_symlink():
            continue
        if str(path) in {str(path_of(f"workbench.{kept}")) for kept in KEPT}:
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue
        new = rewritten(path, text)
        if new != text:
            path.write_text(new, encoding="utf-8")


main()
