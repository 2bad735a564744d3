"""Makes what follows the third argument keyword-only, and names it in calls. Safe to run again: on another
branch it names the arguments of calls to functions that are keyword-only already.

    python3 keywords.py            (at the root of a checkout; then ruff format)
"""

import ast
import collections
import re
from pathlib import Path

MOST = 3
TREES = ("workbench", "lessons", "tests", "assets")
FILES = [p for root in TREES for p in sorted(Path(root).rglob("*.py")) if "solutions" not in p.parts and p.name != "strangers.py"]
TEXT = {p: p.read_text(encoding="utf-8") for p in FILES}
TREE = {p: ast.parse(text) for p, text in TEXT.items()}
DOCS = "\n".join(p.read_text(encoding="utf-8") for p in Path("docs").rglob("*.md"))


def survey():
    """Which names are one function and nothing else, and are called only."""
    defined, other, used = collections.defaultdict(list), set(), set()
    for path, tree in TREE.items():
        top = {id(node) for node in tree.body}
        for node in ast.walk(tree):
            for child in ast.iter_child_nodes(node):
                child.parent = node
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef):
                (defined[node.name].append((path, node)) if id(node) in top and path.parts[0] == "workbench" else other.add(node.name))
            elif isinstance(node, ast.ClassDef):
                other.add(node.name)
            elif isinstance(node, ast.arg):
                other.add(node.arg)
            elif isinstance(node, ast.keyword) and node.arg:
                other.add(node.arg)
            elif isinstance(node, ast.Name | ast.Attribute):
                name = node.id if isinstance(node, ast.Name) else node.attr
                if not isinstance(node.ctx, ast.Load):
                    other.add(name)
                elif not (isinstance(node.parent, ast.Call) and node.parent.func is node):
                    used.add(name)
    starred = {called(node) for tree in TREE.values() for node in ast.walk(tree)
               if isinstance(node, ast.Call) and any(isinstance(a, ast.Starred) for a in node.args)}
    shown = set(re.findall(r"(\w+)\(", DOCS))
    return {name: found[0] for name, found in defined.items()
            if len(found) == 1 and name not in other and name not in used and name not in shown
            and name not in starred}


def called(node):
    return node.func.id if isinstance(node.func, ast.Name) else node.func.attr if isinstance(node.func, ast.Attribute) else None


def offset(text_lines, line, col):
    return sum(len(one) for one in text_lines[: line - 1]) + len(text_lines[line - 1].encode()[:col].decode())


def main():
    edits = collections.defaultdict(list)
    names = survey()
    takes = {}
    for name, (path, node) in names.items():
        arguments = node.args
        order = [one.arg for one in (*arguments.posonlyargs, *arguments.args)]
        late = [one.arg for one in arguments.kwonlyargs]
        if arguments.vararg or arguments.posonlyargs:
            continue
        lines = TEXT[path].splitlines(keepends=True)
        plain = all(isinstance(one, ast.Name) and one.id in ("jaxtyped", "cache") or isinstance(one, ast.Call) for one in node.decorator_list)
        if len(order) > MOST and (plain or not node.decorator_list or True):
            at = offset(lines, arguments.args[MOST].lineno, arguments.args[MOST].col_offset)
            edits[path].append((at, at, "*, "))
            if late:
                begin = offset(lines, arguments.args[-1].end_lineno, arguments.args[-1].end_col_offset)
                end = offset(lines, arguments.kwonlyargs[0].lineno, arguments.kwonlyargs[0].col_offset)
                gap = re.search(r"\*,\s*", TEXT[path][begin:end])
                edits[path].append((begin + gap.start(), begin + gap.end(), ""))
            takes[name] = (MOST, order + late)
        elif late:
            takes[name] = (len(order), order + late)
    for path, tree in TREE.items():
        lines = TEXT[path].splitlines(keepends=True)
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and called(node) in takes:
                most, order = takes[called(node)]
                for k, one in enumerate(node.args[most:], most):
                    at = offset(lines, one.lineno, one.col_offset)
                    if isinstance(one, ast.GeneratorExp) or TEXT[path][at - 1] == "(" and TEXT[path][:at].rstrip("( \n")[-1] == ",":
                        while TEXT[path][at - 1] in "( \n" and TEXT[path][at - 1] != ",":
                            at -= 1
                        while TEXT[path][at] in " \n":
                            at += 1
                    edits[path].append((at, at, f"{order[k]}="))
    for path, found in edits.items():
        text = TEXT[path]
        for begin, end, new in sorted(found, reverse=True):
            text = text[:begin] + new + text[end:]
        ast.parse(text)
        path.write_text(text, encoding="utf-8")
    print(len(takes), "functions,", sum(map(len, edits.values())), "edits")


main()
