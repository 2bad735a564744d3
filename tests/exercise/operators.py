"""Small changes that make a right function wrong: an operator looks at one place of its source and
says what could be there.

A mutant is the source of a function with one change. The operators are the slips of students: a
transpose, a sign, an axis, an order, one more or less, no normalisation, a minimum for a maximum, a
case that is left out, an argument that is not used.
"""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

Changed = Iterator[tuple[str, ast.AST]]

OTHER_NAMES = (
    ("argmin", "argmax"),
    ("min", "max"),
    ("minimum", "maximum"),
    ("sin", "cos"),
    ("any", "all"),
    ("sum", "mean"),
    ("mean", "median"),
    ("floor", "ceil"),
    ("hstack", "vstack"),
    ("searchsorted", "digitize"),
    ("zeros", "ones"),
)
SWAPPED = (
    dict(OTHER_NAMES)
    | {new: old for old, new in reversed(OTHER_NAMES)}
    | {"sum": "mean", "mean": "median"}
)
DROPPED = {
    "sqrt",
    "abs",
    "square",
    "radians",
    "degrees",
    "exp",
    "log",
    "sort",
    "cumsum",
    "unique",
    "inv",
    "clip",
    "maximum",
    "minimum",
    "where",
    "cross",
    "sign",
    "asarray",
    "copy",
    "max",
    "min",
    "round",
    "ceil",
}
OTHER_OPERATORS: dict[type, tuple[type, ...]] = {
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div,),
    ast.Div: (ast.Mult,),
    ast.FloorDiv: (ast.Mult,),
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.GtE),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.LtE),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.And: (ast.Or,),
    ast.Or: (ast.And,),
    ast.BitAnd: (ast.BitOr,),
    ast.BitOr: (ast.BitAnd,),
}
NEAR_ZERO, TOLERANCE = 0.1, 1e-3  # what a bound of 0 becomes; below this a number is a tolerance


@dataclass(frozen=True)
class Mutant:
    """A function with one change.

    Attributes:
        function: The name of the function that is changed; that of a helper, where it is one.
        operator: What kind of change it is.
        change: What stood there, and what stands there now.
        source: The changed function.
    """

    function: str
    operator: str
    change: str
    source: str

    def __str__(self) -> str:
        return f"{self.function}: {self.operator}: {self.change}"


def mutants(function: ast.FunctionDef, *, arguments: bool) -> Iterator[Mutant]:
    """Yield a function with one change each; with `arguments` also with those of what comes in."""
    for parent in list(ast.walk(function)):
        if parent in (function.args, *ast.walk(function.args)):
            continue
        for field, value in list(ast.iter_fields(parent)):
            if parent is function and field != "body":
                continue
            for k, node in list(enumerate(value if isinstance(value, list) else [value])):
                if isinstance(node, ast.AST):
                    yield from _at(
                        function, parent, field, k=k if isinstance(value, list) else None, node=node
                    )
    for operator, line in (
        _of_arguments([arg.arg for arg in function.args.args]) if arguments else ()
    ):
        body = list(function.body)
        function.body[:0] = ast.parse(line).body
        yield Mutant(function.name, operator, line, ast.unparse(function))
        function.body = body


def _at(
    function: ast.FunctionDef, parent: ast.AST, field: str, *, k: int | None, node: ast.AST
) -> Iterator[Mutant]:
    """Yield the function with each change of one node."""
    for operator, new in changes(node):
        old = ast.unparse(node)
        _put(parent, field, k, node=new)
        source = ast.unparse(ast.fix_missing_locations(function))
        change = f"{_short(old)} → {_short(ast.unparse(new))}"
        _put(parent, field, k, node=node)
        if ast.unparse(new) != old:
            yield Mutant(function.name, operator, change, source)


def _put(parent: ast.AST, field: str, k: int | None, *, node: ast.AST) -> None:
    if k is None:
        setattr(parent, field, node)
    else:
        getattr(parent, field)[k] = node


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= 60 else f"{text[:40]}…{text[-19:]}"


def _of_arguments(names: list[str]) -> Iterator[tuple[str, str]]:
    """Yield first lines that spoil what comes in."""
    for name in names:
        yield "ignored", f"{name} = _ones({name})"
        yield "rows", f"{name} = _reversed({name})"
        yield "in place", f"{name} = _spoilt({name})"
        for other in names:
            if other != name:
                yield "twice", f"{name} = {other}"
    yield "float32", "; ".join(f"{name} = _single({name})" for name in names)


def changes(node: ast.AST) -> Changed:
    """Yield what could stand at a place by mistake."""
    match node:
        case ast.BinOp(left, op, right):
            if isinstance(op, ast.MatMult):
                yield "order", ast.BinOp(right, op, left)
            elif not isinstance(op, ast.Pow):
                yield "missing", left
            if isinstance(op, (ast.Mult, ast.Add)):
                yield "missing", right
            yield from (("sign", ast.BinOp(left, new(), right)) for new in _others(op))
        case ast.UnaryOp(ast.USub() | ast.Not() | ast.Invert(), operand):
            yield "sign", operand
        case ast.Attribute(value, "T" | "mT"):
            yield "transpose", value
        case ast.Compare(left, [op], [right]):
            yield from (("bound", ast.Compare(left, [new()], [right])) for new in _others(op))
            if (
                isinstance(right, ast.Constant)
                and right.value == 0
                and isinstance(op, (ast.Lt, ast.LtE, ast.Gt, ast.GtE))
            ):
                yield "bound", ast.Compare(left, [op], [ast.Constant(NEAR_ZERO)])
        case ast.BoolOp(op, values):
            yield "case", ast.BoolOp(_others(op)[0](), values)
            yield from (("case", value) for value in values)
        case ast.IfExp(_, body, orelse):
            yield from (("case", part) for part in (body, orelse))
        case ast.If(_, body, orelse):
            yield "case", ast.Pass()
            if not orelse:
                yield "case", ast.If(ast.Constant(True), body, [])
        case (
            ast.Assign([ast.Subscript()], _)
            | ast.AugAssign()
            | ast.Expr(ast.Call())
            | ast.Continue()
            | ast.Break()
        ):
            yield "statement", ast.Pass()
        case ast.Return(ast.Tuple(values)):
            yield "order", ast.Return(ast.Tuple(values[::-1], ast.Load()))
        case ast.Constant(value) if isinstance(value, (int, float)) and not isinstance(value, bool):
            yield from (("number", ast.Constant(new)) for new in _numbers(value))
        case ast.Subscript(value, ast.Slice(None, None, ast.UnaryOp())):
            yield "order", value
        case ast.Call():
            yield from _calls(node)


def _others(op: ast.AST) -> tuple[Any, ...]:
    return OTHER_OPERATORS.get(type(op), ())


def _numbers(value: float) -> Iterator[float]:
    if isinstance(value, int):
        yield from (value + 1, value - 1)
    elif value == 0.0:
        yield 1.0
    elif abs(value) < TOLERANCE:
        yield 0.05
    else:
        yield 1.5 * value


def _calls(node: ast.Call) -> Changed:
    """Yield other calls: of another function, with other arguments, on another axis, or the
    argument alone.
    """
    name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    if name in SWAPPED:
        func = node.func
        other = (
            ast.Attribute(func.value, SWAPPED[name])
            if isinstance(func, ast.Attribute)
            else ast.Name(SWAPPED[name])
        )
        yield "function", ast.Call(other, node.args, node.keywords)
    if name in DROPPED and node.args:
        yield "function", node.args[-1 if name == "where" else 0]
    if name == "norm" and node.args:
        yield "function", ast.Call(ast.Name("_ones_of"), [node.args[0]], node.keywords)
    if len(node.args) > 1 and not any(isinstance(arg, ast.Starred) for arg in node.args):
        yield (
            "order",
            ast.Call(node.func, [node.args[1], node.args[0], *node.args[2:]], node.keywords),
        )
    for k, keyword in enumerate(node.keywords):
        rest = [*node.keywords[:k], *node.keywords[k + 1 :]]
        if keyword.arg:
            yield (
                ("axis" if keyword.arg == "axis" else "keyword"),
                ast.Call(node.func, node.args, rest),
            )
