"""Keeps imports pointing one way, by reading the source: DESIGN's house, as a table."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MACHINERY = {"workbench.machinery"}
BASE = MACHINERY | {
    "workbench.errors",
    "workbench.apart",
    "workbench.words.axis",
    "workbench.tracing",
}
DRAWING = BASE | {"workbench.scene", "workbench.knobs"}
FORM = DRAWING | {"workbench.cached", "workbench.captions", "workbench.form", "workbench.view"}
RUN = {"timeline", "series", "loading", "questions", "picking", "links", "session"}
LESSON = FORM | {
    "workbench.chapters",
    "workbench.lesson",
    "workbench.presets",
    "workbench.moved",
    *(f"workbench.run.{name}" for name in RUN),
}
MATHS = BASE | {"workbench.geometry"}

# what a part may import of the workbench; longer names win
ALLOWED = {
    "workbench.errors": set(),
    "workbench.tracing": set(),
    "workbench.numerals": set(),
    "workbench.certain": set(),
    "workbench.machinery": MACHINERY | {"workbench.errors"},
    "workbench.apart": MACHINERY | {"workbench.errors"},
    "workbench.words": MACHINERY | {"workbench.errors", "workbench.numerals", "workbench.tracing"},
    "workbench.scene": {"workbench.scene", "workbench.numerals"},
    "workbench.knobs": {"workbench.errors", "workbench.knobs"},
    "workbench.chapters": set(),
    "workbench.geometry": MATHS,
    "workbench.algorithms": MATHS | {"workbench.algorithms"},
    "workbench.data": MATHS | {"workbench.data", "workbench.numerals"},
    "workbench.cached": {"workbench.errors", "workbench.scene", "workbench.tracing"},
    "workbench.captions": {"workbench.scene", "workbench.numerals"},
    "workbench.form": FORM,
    "workbench.form1": FORM,
    "workbench.presets": {"workbench.view"},
    "workbench.view": set(),
    "workbench.run.listing": {"workbench.lesson", "workbench.chapters"},
    "workbench.moved": set(),
    "workbench.lesson": (
        FORM | {"workbench.form1", "workbench.presets", "workbench.chapters", "workbench.moved"}
    ),
    "workbench.run": LESSON,
    "workbench.run.picking": DRAWING,
    "workbench.wire": LESSON | {"workbench.wire"},
    "workbench.rendering": {"workbench.rendering", "workbench.scene", "workbench.view"},
    "workbench.picture": (
        LESSON
        | {
            "workbench.picture",
            "workbench.rendering",
            "workbench.page",
            "workbench.story",
        }
    ),
    "workbench.recording": (LESSON | {"workbench.recording", "workbench.words", "workbench.story"}),
    "workbench.exercise": (
        LESSON | {"workbench.exercise", "workbench.recording", "workbench.numerals"}
    ),
    "workbench.handout": (
        LESSON | {"workbench.handout", "workbench.exercise", "workbench.page.thumbnail"}
    ),
    "workbench.story": LESSON | {"workbench.story", "workbench.words"},
    "workbench.page": (
        LESSON
        | {
            "workbench.page",
            "workbench.rendering",
            "workbench.story",
            "workbench.words",
            "workbench.numerals",
        }
    ),
    "workbench.page.toy": {"workbench.data.rabbit_outline"},
    "workbench.page.exercise": LESSON | {"workbench.exercise"},
    "workbench.computed": (
        LESSON
        | {
            "workbench.computed",
            "workbench.page",
            "workbench.wire",
            "workbench.exercise",
            "workbench.data.files.samples",
        }
    ),
    "workbench.publish": (
        LESSON
        | {
            "workbench.publish",
            "workbench.computed",
            "workbench.page",
            "workbench.picture",
            "workbench.story",
            "workbench.exercise",
            "workbench.recording",
            "workbench.wire",
            "workbench.words",
        }
    ),
    "workbench.viewer": (
        LESSON
        | {
            "workbench.viewer",
            "workbench.story",
            "workbench.page",
            "workbench.wire",
            "workbench.words",
            "workbench.recording",
            "workbench.exercise",
            "workbench.authoring.reloading",
        }
    ),
    "workbench.authoring": (
        LESSON
        | {
            "workbench.authoring",
            "workbench.exercise",
            "workbench.run.flags",
            "workbench.words",
            "workbench.page.article",
            "workbench.page.charts",
            "workbench.story",
        }
    ),
    "workbench.notebook": None,  # a top of its own, as the commands are
    "workbench.commands": None,  # they too
    "workbench.cli": None,  # the top: it may import everything
    "workbench.__main__": None,
    "workbench": None,
    "lessons": (
        DRAWING
        | {
            "workbench.geometry",
            "workbench.algorithms",
            "workbench.data",
            "workbench.lesson",
            "lessons",
            "workbench.exercise",
            "workbench.numerals",
            "workbench.certain",
            "workbench.captions",
            "workbench.cached",
            "workbench.form",
            "workbench.presets",
            "workbench.view",
        }
    ),
}

OUTSIDE = {"viser": ("workbench.wire",), "rerun": ("workbench.recording",)}

FILES = [*(ROOT / "workbench").rglob("*.py"), *(ROOT / "lessons").rglob("*.py")]
# a lesson to be copied to anywhere
MODULES = sorted(path for path in FILES if "template" not in path.parts)


def name_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports(path: Path) -> set[str]:
    modules = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            modules |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}: write imports in full"
            module = node.module or ""
            folder = ROOT / module.replace(".", "/")
            for alias in node.names:
                is_module = (folder / f"{alias.name}.py").exists() or (
                    folder / alias.name / "__init__.py"
                ).exists()
                modules.add(f"{module}.{alias.name}" if is_module else module)
    return modules


def inside(name: str, roots) -> bool:
    return any(
        name == root or (root != "workbench" and name.startswith(root + ".")) for root in roots
    )


def rule(name: str):
    return ALLOWED[
        max((part for part in ALLOWED if name == part or name.startswith(part + ".")), key=len)
    ]


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_point_one_way(path):
    name = name_of(path)
    allowed = rule(name_of(path))
    for imported in imports(path):
        top = imported.split(".")[0]
        if top in ("workbench", "lessons") and allowed is not None:
            assert inside(imported, allowed), f"{name} imports {imported}"
        if top in OUTSIDE:
            assert inside(name, OUTSIDE[top]), f"{name} imports {imported}"
        if name.startswith("lessons."):
            assert top != "lessons" or imported.split(".")[1] == name.split(".")[1], (
                f"{name} imports another lesson"
            )


TOPS = (
    "workbench",
    "workbench.cli",
    "workbench.commands",
    "workbench.__main__",
    "workbench.notebook",
)


def test_every_part_has_a_rule_of_its_own():
    for path in MODULES:
        name = name_of(path)
        assert rule(name) is not None or inside(name, TOPS), f"{name}: no rule"


def part_of(name: str) -> str:
    """The room that a module is in: its group in the maths, its folder elsewhere."""
    parts = name.split(".")
    return ".".join(
        parts[: 3 if parts[1:2] and parts[1] in ("geometry", "algorithms", "data") else 2]
    )


def arrows() -> dict[str, set[str]]:
    """What each room imports; what a function imports when it is called counts too."""
    drawn: dict[str, set[str]] = {}
    for path in MODULES:
        name = name_of(path)
        if name not in ("workbench", "workbench.__main__"):  # the package hands on what is above it
            mine = {
                part_of(other)
                for other in imports(path)
                if other.startswith(("workbench.", "lessons."))
            }
            drawn.setdefault(part_of(name), set()).update(mine - {part_of(name)})
    return drawn


def test_no_arrow_goes_in_a_circle():
    left = arrows()
    while ends := [room for room, others in left.items() if not others & left.keys()]:
        left = {room: others for room, others in left.items() if room not in ends}
    assert left == {}, f"these import each other: {sorted(left)}"


def test_nothing_imports_the_package_itself():
    for path in MODULES:
        assert name_of(path) == "workbench" or "workbench" not in imports(path), (
            f"{name_of(path)} imports workbench: that is above it"
        )


@pytest.mark.parametrize(
    "code", ["import workbench", "from workbench.lesson import catalog; catalog()"]
)
def test_the_catalogue_needs_no_viewer(code):
    check = (
        f"import sys; {code}; print([m for m in ('viser', 'rerun', 'trimesh', 'skimage') if m in"
        " sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", check], capture_output=True, text=True, cwd=ROOT, check=True
    )
    assert done.stdout.strip() == "[]"
