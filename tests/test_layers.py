"""Keeps imports pointing one way, by reading the source: DESIGN's house, as a table."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
BASE = {"workbench", "workbench.apart", "workbench.axis", "workbench.errors", "workbench.tracing", "workbench.authors"}
DRAWING = BASE | {"workbench.scene", "workbench.knobs"}
FORM = DRAWING | {"workbench.cached", "workbench.captions", "workbench.form", "workbench.view"}
LESSON = FORM | {
    "workbench.lesson",
    "workbench.presets",
    "workbench.loading",
    "workbench.timeline",
    "workbench.picking",
    "workbench.questions",
}
MATHS = BASE | {"workbench.geometry"}

# what a part may import of the workbench; longer names win
ALLOWED = {
    "workbench.apart": {"workbench.errors", "workbench.threads"},
    "workbench.axis": {"workbench.numerals"},
    "workbench.errors": set(),
    "workbench.hosts": {"workbench.errors"},
    "workbench.tracing": set(),
    "workbench.authors": {"workbench", "workbench.errors"},
    "workbench.questions": LESSON,
    "workbench.scene": {"workbench.scene", "workbench.numerals"},
    "workbench.knobs": {"workbench.errors"},
    "workbench.numerals": set(),
    "workbench.certain": set(),
    "workbench.geometry": MATHS,
    "workbench.algorithms": MATHS | {"workbench.algorithms"},
    "workbench.data": MATHS | {"workbench.data", "workbench.numerals"},
    "workbench.cached": {"workbench.errors", "workbench.scene"},
    "workbench.captions": {"workbench.scene", "workbench.numerals"},
    "workbench.form": FORM,
    "workbench.form1": FORM,
    "workbench.presets": {"workbench.view"},
    "workbench.view": set(),
    "workbench.lesson": FORM | {"workbench.form1", "workbench.presets"},
    "workbench.timeline": LESSON,
    "workbench.loading": LESSON,
    "workbench.listing": {"workbench.lesson"},
    "workbench.links": LESSON | {"workbench.moved"},
    "workbench.moved": set(),
    "workbench.picking": DRAWING,
    "workbench.typeset": BASE | {"workbench.atomic"},
    "workbench.images": set(),
    "workbench.workers": set(),
    "workbench.threads": set(),
    "workbench.wire": LESSON | {"workbench.wire"},
    "workbench.progress": set(),
    "workbench.atomic": set(),
    "workbench.session": LESSON | {"workbench.session"},
    "workbench.recording": LESSON | {"workbench.recording", "workbench.session", "workbench.typeset", "workbench.links",
                                     "workbench.moved", "workbench.images", "workbench.progress", "workbench.atomic",
                                     "workbench.hosts"},
    "workbench.exercise": LESSON | {"workbench.exercise", "workbench.recording", "workbench.progress", "workbench.atomic",
                           "workbench.workers", "workbench.threads", "workbench.numerals"},
    "workbench.handout": LESSON | {"workbench.handout", "workbench.exercise", "workbench.page.thumbnail",
                                   "workbench.atomic"},
    "workbench.story": LESSON | {"workbench.story", "workbench.typeset"},
    "workbench.page": LESSON | {"workbench.page", "workbench.story", "workbench.moved", "workbench.images",
                                "workbench.typeset", "workbench.numerals"},
    "workbench.page.exercise": LESSON | {"workbench.exercise"},
    "workbench.publish": LESSON | {
        "workbench.publish", "workbench.page", "workbench.story", "workbench.exercise",
        "workbench.recording", "workbench.wire", "workbench.typeset",
        "workbench.session",
        "workbench.links", "workbench.moved", "workbench.images", "workbench.progress", "workbench.atomic",
        "workbench.workers",
    },
    "workbench.viewer": LESSON | {
        "workbench.viewer", "workbench.page", "workbench.story", "workbench.session", "workbench.wire", "workbench.links",
        "workbench.picking", "workbench.typeset", "workbench.recording", "workbench.exercise",
        "workbench.authoring.reloading", "workbench.hosts",
    },
    "workbench.authoring": LESSON | {"workbench.authoring", "workbench.exercise", "workbench.flags", "workbench.typeset",
                                     "workbench.page.article", "workbench.page.charts", "workbench.story"},
    "workbench.flags": LESSON | {"workbench.flags", "workbench.moved"},
    "workbench.notebook": None,  # a top of its own, as the commands are
    "workbench.cli": None,  # the top: it may import everything
    "workbench.__main__": None,
    "workbench": None,
    "lessons": DRAWING | {"workbench.geometry", "workbench.algorithms", "workbench.data", "workbench.lesson", "lessons",
                          "workbench.exercise", "workbench.numerals", "workbench.certain",
                          "workbench.captions", "workbench.cached", "workbench.form", "workbench.presets",
                          "workbench.view"},
}  # fmt: skip

OUTSIDE = {"viser": ("workbench.wire", "workbench.publish.site"), "rerun": ("workbench.recording",)}

FILES = [*(ROOT / "workbench").rglob("*.py"), *(ROOT / "lessons").rglob("*.py")]
MODULES = sorted(path for path in FILES if "template" not in path.parts)  # a lesson to be copied to anywhere


def name_of(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports(path: Path) -> set[str]:
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path.name}: write imports in full"
            module = node.module or ""
            found |= {f"{module}.{alias.name}" if (ROOT / module.replace(".", "/") / f"{alias.name}.py").exists() else module
                      for alias in node.names}  # fmt: skip
    return found


def inside(name: str, roots) -> bool:
    return any(name == root or (root != "workbench" and name.startswith(root + ".")) for root in roots)


def rule(name: str):
    return ALLOWED[max((part for part in ALLOWED if name == part or name.startswith(part + ".")), key=len)]


@pytest.mark.parametrize("path", MODULES, ids=name_of)
def test_imports_point_one_way(path):
    name, allowed = name_of(path), rule(name_of(path))
    for imported in imports(path):
        top = imported.split(".")[0]
        if top in ("workbench", "lessons") and allowed is not None:
            assert inside(imported, allowed), f"{name} imports {imported}"
        if top in OUTSIDE:
            assert inside(name, OUTSIDE[top]), f"{name} imports {imported}"
        if name.startswith("lessons."):
            assert top != "lessons" or imported.split(".")[1] == name.split(".")[1], f"{name} imports another lesson"


TOPS = ("workbench", "workbench.cli", "workbench.__main__", "workbench.notebook")


def test_every_part_has_a_rule_of_its_own():
    for path in MODULES:
        name = name_of(path)
        assert rule(name) is not None or name in TOPS, f"{name}: no rule"


@pytest.mark.parametrize("code", ["import workbench", "from workbench.lesson import catalog; catalog()"])
def test_the_catalogue_needs_no_viewer(code):
    check = f"import sys; {code}; print([m for m in ('viser', 'rerun', 'trimesh', 'skimage') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", check], capture_output=True, text=True, cwd=ROOT, check=True)
    assert done.stdout.strip() == "[]"
