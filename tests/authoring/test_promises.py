"""Every promise is seen broken once: a lesson that holds, changed in one place, is told by its
place in one line.
"""

import re
import shutil
from pathlib import Path

import pytest

from workbench.authoring.new import TEMPLATE
from workbench.authoring.promises import Subject
from workbench.authoring.validate import look_at
from workbench.errors import InputError
from workbench.run.loading import load

CIRCLE = Path(__file__).resolve().parents[1] / "authors" / "circle"
LESSON, DRAW, STATE, RUNS, PAGE = "lesson.py", "draw.py", "state.py", "presets.py", "page.md"
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
    # the default run
    (
        LESSON,
        "    yield State(0, p, circle)\n",
        "    yield State(0, p, circle)\n    yield 1 / 0\n",
        "line N: ZeroDivisionError",
    ),
    (
        LESSON,
        "    rng = np",
        "    return\n    rng = np",
        "circle/lesson.py, line N: run ended without a step",
    ),
    (
        LESSON,
        "    rng = np",
        "    yield State(0, np.ones((2, 2)), np.ones(3))\n    return\n    rng = np",
        "has 1 step",
    ),
    (
        LESSON,
        "order=900",
        "order=900, first_step=70",
        "lesson circle opens at step 70, but its run has 5 steps",
    ),
    (
        LESSON,
        "default_rng(params.seed)",
        "default_rng()",
        "; take all chance from np.random.default_rng(params.seed)",
    ),
    (
        LESSON,
        "run=run,",
        "run=lambda params, **slots: [1],",
        "run returned a list; it is a generator",
    ),
    (
        LESSON,
        "run=run,",
        "run=lambda params, **slots: None,",
        "run returned None; it is a generator",
    ),
    (LESSON, "params: Params, *, fit", "params: Params, points, *, fit", "line N: run(params: "),
    (
        LESSON,
        "params: Params, *, fit",
        "params: Params, fit",
        "line N: run takes 'fit_circle'; beside params",
    ),
    (
        LESSON,
        "run=run,",
        "run=lambda p, fit_circle=fit_circle: run(p, fit_circle=fit_circle),",
        "calls its first argument 'p'",
    ),
    (LESSON, 'name="circle"', 'name="a circle"', "a lesson's name is letters, digits"),
    (LESSON, 'Path(__file__).with_name("page.md")', '"page.md"', "page is a Path, not 'page.md'"),
    # what is drawn
    (
        DRAW,
        "    return {",
        "    return None\n    return {",
        "draw.py, line N: draw returned None; it returns a",
    ),
    (
        DRAW,
        "    return {",
        "    return [1]\n    return {",
        "draw.py, line N: draw returned a list",
    ),
    (
        DRAW,
        '"caption": Caption(',
        '"a/b": "text", "caption": Caption(',
        "the scene holds a str at 'a/b'",
    ),
    (
        DRAW,
        '"caption": Caption(',
        '"a/b": state.p, "caption": Caption(',
        "the scene holds a ndarray at 'a/b'",
    ),
    (DRAW, "Points(in_space(state.p)", "Points([[0, 0, 0]]", "Points.p is an array"),
    (
        DRAW,
        "Scalar(state.rms",
        "Scalar('0.5'",
        "draw.py, line N: ValueError: Scalar.value is one real number",
    ),
    (
        DRAW,
        '"points": Points(',
        '"points": Axes() if state.k == 2 else Points(',
        "step 2: 'points' is of the kind Axes now, and was of the kind Points",
    ),
    (
        DRAW,
        'Caption(f"{said};',
        "Caption('Short.') if state.k == 1 else Caption(f\"{said};",
        "step 1: the caption 'Short.' has 6",
    ),
    (
        DRAW,
        '"rms": Scalar(',
        '"c": Curve(np.arange(3.0), np.arange(4.0), "a", "b", "c"), "rms": Scalar(',
        "Curve.x and y",
    ),
    (
        DRAW,
        '"rms": Scalar(',
        '"t": Table("Map", ("a",), ((0.5,),)), "rms": Scalar(',
        "each cell of the Table 'Map' is a text",
    ),
    (
        DRAW,
        "    return {",
        '    return {"caption": Caption("A long caption")}\n    return {',
        "step 0 shows nothing in space",
    ),
    (
        DRAW,
        "    return {",
        '    return {"points": Points(in_space(state.p))}\n    return {',
        "needs a Caption",
    ),
    (
        DRAW,
        'Caption(f"{said};',
        'Caption("Something") or Caption(f"{said};',
        "every step has the caption 'Something'",
    ),
    (
        LESSON,
        "run=run,",
        (
            "run=lambda params, *, fit_circle=fit_circle: iter([State(k, np.eye(2), TRUE) for k in"
            " (0, 1)]),"
        ),
        "step 0 has no line to show",
    ),
    # knobs, presets, questions
    (
        STATE,
        'points: Annotated[int, Knob("How many points are measured", 5, 200)]',
        'points: Annotated[int, Knob("How many points are measured", 0, 200)]',
        "(at points = 0)",
    ),
    (
        STATE,
        "seed: Annotated",
        "step: Annotated[int, Knob('Steps', 0, 9)] = 1\n    seed: Annotated",
        "Params.step: commands use",
    ),
    (
        STATE,
        'Knob("Which noise is drawn", 0, 99)',
        'Knob("Which noise", 0, 99, by=Pick("cloud"))',
        "Params.seed is picked at 'cloud'",
    ),
    (
        STATE,
        'seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0',
        "seed: Annotated[tuple[int, int], Knob('A', 0, 9, by=Gizmo())] = (0, 0)",
        "Params.seed: a Gizmo sets 2 floats",
    ),
    (
        STATE,
        'seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0',
        (
            'seed: Annotated[int, Knob("Which", 0, 99, needs={"b": (True,)})] = 0\n    b:'
            ' Annotated[bool, Knob("B")] = True'
        ),
        "seed = 99 changes 'points' although its needs are not met, at {'b': 'False'}",
    ),
    (
        STATE,
        'Knob("Which noise is drawn", 0, 99)',
        'Knob("Which noise", 0, 99, needs={"mood": ("calm",)})',
        "seed needs 'mood', which is no choice or switch of this lesson",
    ),
    (
        RUNS,
        "Params(arc=60.0)",
        "Params(arc=400.0)",
        "preset 'arc': arc = 400: a number from 20 to 360 deg",
    ),
    (
        RUNS,
        "        Params(),\n",
        "        Params(),\n        step=99,\n",
        "preset 'whole' opens at step 99, but its run has 5 steps",
    ),
    (RUNS, '"exact"', '"no noise"', "preset 'no noise': a name is letters"),
    (
        RUNS,
        "Points all around: both fits agree to a few millimetres.",
        "Short.",
        "preset 'whole': its line has 6 characters",
    ),
    (
        LESSON,
        "view=View(",
        "view=View(eye=(90, 0, 0), target=(99, 0, 0)) if True else View(",
        "step 0: out of its frame are",
    ),
    (
        RUNS,
        "states[0].circle[2],",
        "states[99].circle[2],",
        "question 'radius': circle/presets.py, line N",
    ),
    (RUNS, "states[0].circle[2],", "float('nan'),", "its answer is nan"),
    (RUNS, "tolerance=0.05", "tolerance=0.0", "question 'radius': its tolerance is 0"),
    (
        RUNS,
        "tolerance=0.05",
        "tolerance=0.05, wrong=((2.0, 1.0, 'The other way round.'),)",
        "wants a lowest number",
    ),
    (
        RUNS,
        "tolerance=0.05",
        "tolerance=0.05, wrong=((0.0, 9.0, 'All of them.'),)",
        "meets the right one",
    ),
    (RUNS, "states[0].error else 2", "states[0].error else 3", None),
    (
        RUNS,
        "lambda states: 0 if",
        "lambda states: 7 if",
        "question 'refined': circle/presets.py, line N: its answer is 7",
    ),
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
