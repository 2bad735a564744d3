"""Reads the names of motions: in a product frames must meet, and a name must say what is assigned
to it.

`T_a_b @ T_b_c` is a motion from c to a; `T_a_b @ p_b` is a point in a; `R_a_b.T` and
`inverse(T_a_b)` turn the frames round. Only names made of known frame words are read, so that other
matrices are left alone.
"""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
FRAMES = {
    "world",
    "camera",
    "source",
    "target",
    "object",
    "node",
    "left",
    "right",
    "image",
    "body",
    "start",
    "end",
    "truth",
}
FILES = sorted([*(ROOT / "workbench").rglob("*.py"), *(ROOT / "lessons").rglob("*.py")])


def frames_of(node: ast.expr) -> tuple[str, ...] | None:
    """Return (to, from) of a motion, (frame,) of a point or vector, None where the expression says
    nothing.
    """
    if isinstance(node, ast.Name):
        kind, *words = (
            node.id.rstrip("s").split("_")
            if node.id.startswith(("Ts_", "Rs_"))
            else node.id.split("_")
        )
        words = words[:2] if kind in ("T", "R", "Ts", "Rs") else words[:1]
        if (
            kind in ("T", "R", "Ts", "Rs", "p", "v", "n")
            and words
            and all(word in FRAMES for word in words)
        ):
            wanted = 2 if kind in ("T", "R", "Ts", "Rs") else 1
            return tuple(words) if len(words) == wanted else None
        return None
    if isinstance(node, ast.Attribute) and node.attr == "T":
        inner = frames_of(node.value)
        return inner[::-1] if inner is not None and len(inner) == 2 else None
    if isinstance(node, ast.Subscript):  # T[:3, :3] turns as T does
        inner = frames_of(node.value)
        return (
            inner
            if inner is not None
            and len(inner) == 2
            and isinstance(node.slice, ast.Tuple)
            and all(isinstance(part, ast.Slice) for part in node.slice.elts)
            else None
        )
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        if node.func.id == "inverse" and node.args:
            inner = frames_of(node.args[0])
            return inner[::-1] if inner is not None and len(inner) == 2 else None
        if node.func.id == "apply" and len(node.args) == 2:
            return product(node, frames_of(node.args[0]), frames_of(node.args[1]))
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult):
        return product(node, frames_of(node.left), frames_of(node.right))
    return None


class FrameError(Exception):
    pass


def product(node: ast.expr, left, right):
    if left is None or right is None:
        return None
    if len(left) == 2 and len(right) == 2:
        if left[1] != right[0]:
            raise FrameError(f"line {node.lineno}: {left} @ {right}")
        return (left[0], right[1])
    if len(left) == 2 and len(right) == 1:
        if left[1] != right[0]:
            raise FrameError(
                f"line {node.lineno}: a motion from {left[1]} meets a point in {right[0]}"
            )
        return (left[0],)
    if len(left) == 1 and len(right) == 2:  # rows: p_b @ R_a_b.T is a point in a
        if left[0] != right[0]:
            raise FrameError(f"line {node.lineno}: rows in {left[0]} meet {right}")
        return (right[1],)
    return None


def check(source: str) -> None:
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.expr):
            frames_of(node)
        if isinstance(node, ast.Assign) and len(node.targets) == 1:
            declared = frames_of(node.targets[0])
            is_ = frames_of(node.value)
            if declared is not None and is_ is not None and declared != is_:
                raise FrameError(f"line {node.lineno}: {declared} is assigned what is {is_}")


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_frames_meet(path):
    check(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    "wrong",
    [
        "T_world_camera @ T_world_source",
        "T_world_camera @ p_world",
        "T_source_target = T_target_source @ T_source_source",
        "p_world @ R_world_camera.T",
        "T_camera_world = T_world_camera",
        "apply(inverse(T_world_camera), p_camera)",
        "p_world = apply(T_world_camera, p_camera) if 0 else T_camera_world[:3, :3] @ p_camera",
    ],
)
def test_a_wrong_product_is_found(wrong):
    with pytest.raises(FrameError):
        check(wrong)


@pytest.mark.parametrize(
    "right",
    [
        "T_world_source = T_world_camera @ inverse(T_source_camera)",
        "p_world = apply(T_world_camera, p_camera)",
        "p_world = p_camera @ R_world_camera.T",
        "R_camera_world = T_world_camera[:3, :3].T",
        "x = T_world_camera @ anything",
    ],
)
def test_a_right_product_passes(right):
    check(right)
