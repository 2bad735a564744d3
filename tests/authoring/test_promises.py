"""Every promise is seen broken once: a lesson that holds, changed in one place, is told by its
place in one line. What is changed in its page and its exercise stands here.
"""

import re
import shutil
from pathlib import Path

import pytest

from tests.authoring.broken import DECLARED, DRAW, DRAWN, LESSON, RUN, RUNS
from workbench.authoring.new import TEMPLATE
from workbench.authoring.promises import Subject
from workbench.authoring.validate import look_at
from workbench.errors import InputError
from workbench.run.loading import load

CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"
PAGE = "page.md"
TASK = "exercises/fit_circle.py"
SCAFFOLD_LINE = (TEMPLATE / "page.md").read_text(encoding="utf-8").splitlines()[2]


@pytest.fixture
def folder(tmp_path) -> Path:
    return Path(
        shutil.copytree(CIRCLE, tmp_path / "circle", ignore=shutil.ignore_patterns("__pycache__"))
    )


def wrong(folder: Path) -> list[str]:
    """What validating says, by way of the same calls as in the other process."""
    try:
        lesson = load(folder)
    except InputError as error:
        return [str(error)]
    return [line for line in look_at(Subject(lesson, seconds=3.0)) if line is not None]


def test_a_lesson_that_holds_is_told_nothing(folder):
    assert wrong(folder) == []


BROKEN = [
    *RUN,
    *DRAWN,
    *DECLARED,
    # the page
    (PAGE, "## Pitfalls", "## Traps", "page.md: the page has no part 'Pitfalls'"),
    (
        PAGE,
        "r = \\sqrt{c",
        "r = \\wurzel{c",
        "page.md, line N: \\wurzel is a TeX command that is not known",
    ),
    (
        PAGE,
        "## Pitfalls",
        "Drag the points.\n\n## Pitfalls",
        "page.md, line N: it says 'Drag the'; a published page and",
    ),
    (PAGE, "## Pitfalls", "{{live: Drag the points.}}\n\n## Pitfalls", None),
    (
        RUNS,
        "Points all around",
        "Click a point",
        "preset 'whole' says 'Click'; a published page and a notebook cannot do it",
    ),
    (
        DRAW,
        "; the points lie",
        "; click a point; they lie",
        "step 0: the caption says 'click'; a published page and",
    ),
    (
        PAGE,
        "## Pitfalls",
        "[Look](run:nopreset@0).\n\n## Pitfalls",
        "line N: a link runs 'nopreset', which is no preset",
    ),
    (
        PAGE,
        "## Pitfalls",
        "[Look](run:arc@99).\n\n## Pitfalls",
        "the link to 'arc' opens at step 99, but its run has",
    ),
    (
        PAGE,
        "## Pitfalls",
        "[Look](run:this@99).\n\n## Pitfalls",
        "the link to 'this' opens at step 99",
    ),
    (
        PAGE,
        "## Pitfalls",
        "The [[whell|wheel]].\n\n## Pitfalls",
        "line N: [[whell]] names nothing that a run of the",
    ),
    (PAGE, "## Pitfalls", "The [[Points]].\n\n## Pitfalls", "'[[Points]].' is no term"),
    (PAGE, "## Pitfalls", f"{SCAFFOLD_LINE}\n\n## Pitfalls", "line N: this line is the scaffold's"),
    (PAGE, "## Watch", "![A circle](circle.png)\n\n## Watch", "there is no picture 'circle.png'"),
    # the exercise
    (
        TASK,
        'slot="fit_circle"',
        'slot="fit_line"',
        "exercise fit_circle: run of lesson circle has no keyword 'fit_line'",
    ),
    (TASK, "[0, 0, 1]", "[0, 0, 2]", "the example says [0, 0, 2]"),
    (
        TASK,
        "return np.array([a, b, np.sqrt(c + a**2 + b**2)])\n\n\n@check",
        "return np.array([a, b, c])\n\n\n@check",
        "by_normal_equations is right, and loses",
    ),
    (
        TASK,
        "fit_circle(p) * np.array([2, 2, 1])",
        "fit_circle(p)",
        "the mistake 'doubled centre' gets full marks",
    ),
    (
        TASK,
        "** np.array([1, 1, 2])",
        "* np.array([2, 2, 1])",
        "the mistake 'doubled centre' is not recognised: no check tells it",
    ),
    (TASK, "@alternative\n", "", "it has 0 alternatives; wanted are 1 or more"),
    (
        TASK,
        "np.linalg.solve(A.T @ A, A.T @ (p**2).sum(axis=1))",
        "fit_circle(p); return fit_circle(p)",
        "by_normal_equations does not earn full marks by itself",
    ),
    (
        TASK,
        "left_alone(candidate, judged(candidate, on_circle(CIRCLE)))",
        "judged(candidate, on_circle(CIRCLE))",
        "a function that changes its input is not told so",
    ),
    (TASK, ", public=False", "", "it needs public checks and hidden ones"),
    (
        LESSON,
        "yield from refine(p, fit_circle(p))",
        "yield from refine(p, TRUE)",
        "calls its keyword 'fit_circle'",
    ),
    (
        TASK,
        "    return refused(",
        "    return full('It is a line.')\n    return refused(",
        "returns nothing earns points: points_on_a_line",
    ),
    (
        TASK,
        '"""Write the',
        '"""Fit."""\n"""Write the',
        "the task (the file's docstring) has 4 characters",
    ),
    (TASK, "** np.array([1, 1, 2])", "", "the mistake 'squared radius' gets full marks"),
    (TASK, "if rank < 3:", "if rank < 2:", "our own function loses points: points_on_a_line"),
    (TASK, 'what="Six points on a line"', "what=''", None),
    (
        TASK,
        "beside(got, right, HINT)",
        "'r is 1, right is 1.'",
        "points_on_a_circle writes both as 1",
    ),
    (TASK, "    return band(", "    return fail('No.') if off > 1 else band(", "says only 'No.'"),
    (TASK, '"[1, 1, 1.4142]"', '"[1, 1, 1.4142" + 130 * "0" + "]"', "a line of the starter has 1"),
]


@pytest.mark.parametrize(("file", "old", "new", "message"), BROKEN)
def test_what_does_not_hold_is_told_by_its_place(folder, file, old, *, new, message):
    text = (folder / file).read_text(encoding="utf-8")
    assert old in text
    text = text.replace(old, new)
    for name, module in (
        ("Axes", "scene"),
        ("Curve", "scene"),
        ("Table", "scene"),
        ("full", "exercise"),
        ("fail", "exercise"),
        ("Pick", "knobs"),
        ("Gizmo", "knobs"),
    ):
        if f"{name}(" in new:
            text = text.replace(
                "import numpy as np\n",
                f"import numpy as np\nfrom workbench.{module} import {name}\n",
                1,
            )
    (folder / file).write_text(text, encoding="utf-8")
    lines = wrong(folder)
    if message is None:
        assert lines == []
        return
    assert [
        line
        for line in lines
        if re.search(re.escape(message).replace("line\\ N", r"line \d+"), line)
    ], "\n".join(lines)
    assert all("\n" not in line for line in lines)
