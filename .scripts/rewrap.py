"""Brings docstrings, comments and string literals to 100 columns. Run at the root of a checkout; safe to run again.

    .venv/bin/python /work/wt/scripts/rewrap.py [PATH ...]     (needs black in the venv)
"""

import ast
import io
import re
import subprocess
import sys
import textwrap
import tokenize
from pathlib import Path

WIDTH = 100
ROOTS = sys.argv[1:] or ["workbench", "lessons", "tests", "assets"]
LEFT = ("tests/exercise/solutions", "tests/exercise/strangers.py")
OWNERS = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
PRAGMA = re.compile(r"#\s*(type:|noqa|fmt:|pyright:|ruff:|!)")


def files():
    for root in ROOTS:
        path = Path(root)
        for file in sorted(path.rglob("*.py")) if path.is_dir() else [path]:
            if not str(file).startswith(LEFT):
                yield file


def shape(text):
    """The tree without docstrings: must stay as it is."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            for one in body:
                if isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant) and isinstance(one.value.value, str):
                    one.value.value = ""
    return re.sub(r"Constant\(value='(.*?)', kind='u'\)", r"Constant(value='\1')", ast.dump(tree))


# what only packed lines --------------------------------------------------------------------------


def is_matrix(node):
    """Three rows or more of numbers, under one another."""
    def number(one):
        return isinstance(one, ast.Constant | ast.UnaryOp) and not isinstance(getattr(one, "value", 0), str)
    for part in ast.walk(node):
        if isinstance(part, ast.List | ast.Tuple) and len(part.elts) >= 3:
            rows = [row for row in part.elts if isinstance(row, ast.List | ast.Tuple) and len(row.elts) > 1]
            if len(rows) >= 3 and all(all(number(one) for one in row.elts) for row in rows):
                return True
    return False


def unpacked(text):
    lines = text.split("\n")
    tree = ast.parse(text)
    keep = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.stmt) and not isinstance(node, OWNERS) and is_matrix(node):
            keep |= set(range(node.lineno, node.end_lineno + 1))
    out = []
    for k, line in enumerate(lines, 1):
        if k in keep:
            out.append(line)
        elif re.fullmatch(r"\s*# fmt: (off|on)", line):
            continue
        else:
            out.append(re.sub(r"  # fmt: skip\b", "", line).rstrip())
    return "\n".join(out)


# docstrings --------------------------------------------------------------------------------------

ENTRY = re.compile(r"^(\w[\w, *]*|\*{1,2}\w+): ")
BULLET = re.compile(r"^([-*]|\d+\.) ")
SECTION = re.compile(r"^(Args|Returns|Yields|Raises|References?|Attributes|Notes?|Examples?|Example):")


def refilled(lines, width):
    """Docstring lines (without their common indent), each at most `width` long."""
    if not any(len(line) > width for line in lines):
        return lines
    out, at, section = [], 0, None
    fenced = False
    while at < len(lines):
        line = lines[at]
        stripped = line.lstrip()
        indent = len(line) - len(stripped)
        if stripped.startswith("```"):
            fenced = not fenced
        head = SECTION.match(stripped)
        if indent == 0 and stripped:
            section = head[1] if head else None
        if not stripped or fenced or stripped.startswith((">>>", "... ", "|", "```", "::")) or "──" in line:
            out.append(line)
            at += 1
            if stripped.startswith(">>>"):
                while at < len(lines) and lines[at].strip():
                    out.append(lines[at])
                    at += 1
            continue
        group, at = [line], at + 1
        item = bool(BULLET.match(stripped)) or (section in ("Args", "Raises", "Attributes") and indent > 0)
        hang = indent
        while at < len(lines):
            follow = lines[at]
            text = follow.lstrip()
            deep = len(follow) - len(text)
            if not text or text.startswith((">>>", "|", "```")) or BULLET.match(text) or "──" in follow:
                break
            if item and deep <= indent:
                break
            if not item and (deep != indent and not (head and deep > indent)) or SECTION.match(text) and deep == 0:
                break
            if head and not stripped.split(":", 1)[1].strip():
                break  # a heading alone on its line
            hang = deep
            group.append(follow)
            at += 1
        if all(len(one) <= width for one in group):
            out += group
            continue
        if len(group) == 1 and item:
            bullet = BULLET.match(stripped)
            hang = indent + (len(bullet[0]) if bullet else 4)
        elif len(group) == 1 and head and stripped.split(":", 1)[1].strip():
            hang = indent
        words = " ".join(one.strip() for one in group)
        out += textwrap.wrap(
            words, width, initial_indent=" " * indent, subsequent_indent=" " * hang,
            break_long_words=False, break_on_hyphens=False,
        )
    return out


def doc_nodes(tree):
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            for one in body:
                if isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant) and isinstance(one.value.value, str):
                    yield one.value


def docs(text):
    lines = text.split("\n")
    for node in sorted(doc_nodes(ast.parse(text)), key=lambda node: -node.lineno):
        own = lines[node.lineno - 1 : node.end_lineno]
        if not any(len(line) > WIDTH for line in own) or node.end_col_offset != len(own[-1].encode()):
            continue
        indent = " " * node.col_offset
        source = "\n".join(own)[node.col_offset :]
        quote = re.match(r'[rRuU]?"""', source)
        if not quote or not source.endswith('"""'):
            continue
        inner = source[quote.end() : -3]
        bare = [part.removeprefix(indent) for part in inner.split("\n")]
        # the first line stands behind the quotes
        room = WIDTH - node.col_offset
        marked = ["\0" * quote.end() + bare[0], *bare[1:]]
        single = len(marked) == 1
        if single:
            marked[0] += "\0" * 3
            if len(marked[0]) <= room:
                continue
            marked[0] = marked[0].rstrip("\0")
        while marked and not marked[-1].strip():
            marked.pop()
        done = refilled(marked, room - 3 if single else room)
        body = "\n".join(indent + part if part.strip() else "" for part in done).replace("\0", "")
        body = indent + quote[0] + body[len(indent) :]
        lines[node.lineno - 1 : node.end_lineno] = (body + f'\n{indent}"""').split("\n")
    return "\n".join(lines)


# comments ----------------------------------------------------------------------------------------


def comments(text):
    """Own lines of comments are filled; a comment behind a line that is too long goes above it."""
    lines = text.split("\n")
    marks = {}
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            marks[token.start[0]] = token.start[1]
    out, k = [], 1
    while k <= len(lines):
        line = lines[k - 1]
        at = marks.get(k)
        if at is None:
            out.append(line)
            k += 1
            continue
        if line[:at].strip():
            if len(line) > WIDTH and not PRAGMA.match(line[at:]):
                indent = line[: len(line) - len(line.lstrip())]
                said, pragma = line[at:], ""
                found = re.search(r"\s+#\s*(type:|noqa|fmt:|pyright:).*$", said)
                if found:
                    said, pragma = said[: found.start()], found[0]
                code = line[:at].rstrip()
                if code.lstrip()[:1] in ")]}" or code.lstrip().startswith(("elif", "else", "except", "finally")):
                    out.append(line)  # there is no place above
                else:
                    out += filled(said[1:].strip(), indent)
                    out.append(code + ("  " + pragma.strip() if pragma else ""))
            else:
                out.append(line)
            k += 1
            continue
        block = [line]
        while k + len(block) <= len(lines) and marks.get(k + len(block)) == at and not lines[k + len(block) - 1][:at].strip():
            block.append(lines[k + len(block) - 1])
        k += len(block)
        out += whole(block, " " * at)
    return "\n".join(out)


def filled(said, indent):
    return textwrap.wrap(said, WIDTH, initial_indent=f"{indent}# ", subsequent_indent=f"{indent}# ",
                         break_long_words=False, break_on_hyphens=False)


def whole(block, indent):
    if all(len(line) <= WIDTH for line in block):
        return block
    out, group = [], []

    def flush():
        if group:
            out.extend(group if all(len(line) <= WIDTH for line in group) else filled(" ".join(one.strip().removeprefix("#").strip() for one in group), indent))
            group.clear()

    for line in block:
        said = line.strip()
        ruler = re.match(r"^(# .*?)(-{8,}|─{8,})$", said)
        if ruler:
            flush()
            out.append((indent + said)[:WIDTH])
        elif PRAGMA.match(said) or said == "#" or BULLET.match(said[1:].strip()) or said.startswith("#  "):
            flush()
            out.append(line)
        else:
            group.append(line)
    flush()
    return out


def main():
    paths = list(files())
    before = {path: path.read_text(encoding="utf-8") for path in paths}
    for path, text in before.items():
        path.write_text(comments(docs(unpacked(text))), encoding="utf-8")
        if shape(path.read_text()) != shape(text):
            print("changed:", path)
    ruff = [".venv/bin/ruff", "format", "-q", *map(str, paths)]
    subprocess.run(ruff, check=True)
    # string literals: only files that have one beyond the margin
    long = [p for p in paths if any(len(line) > WIDTH for line in p.read_text().split("\n"))]
    subprocess.run([".venv/bin/black", "-q", "--preview", "--enable-unstable-feature", "string_processing",
                    "-l", str(WIDTH), *map(str, long)], check=False)
    subprocess.run(ruff, check=True)
    for path in long:
        text = path.read_text()
        path.write_text(comments(docs(text)), encoding="utf-8")
    subprocess.run(ruff, check=True)
    for path, text in before.items():
        if shape(path.read_text()) != shape(text):
            print("changed:", path)


main()
