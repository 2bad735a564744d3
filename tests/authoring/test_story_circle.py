"""A lesson as somebody outside writes it, after the guide: small, a story, recorded, published
and graded.
"""

import ast
from pathlib import Path

from workbench import open_recording
from workbench.authoring.promises import Subject
from workbench.authoring.validate import look_at
from workbench.cli import main
from workbench.exercise.finding import exercises_of
from workbench.exercise.grading import grade_function
from workbench.lesson import Lesson
from workbench.publish.site import publish
from workbench.run.loading import load
from workbench.run.questions import answer
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import caption_of
from workbench.story import story_of

CIRCLE = Path(__file__).with_name("circle")
GUIDE = Path(__file__).resolve().parents[2] / "docs" / "lessons.md"
MOST_LINES = 200


def lesson() -> Lesson:
    return load(CIRCLE)


def test_it_is_small():
    lines = [path.read_text(encoding="utf-8").splitlines() for path in CIRCLE.rglob("*.py")]
    assert sum(map(len, lines)) <= MOST_LINES
    assert max(len(line) for file in lines for line in file) <= 100


def test_the_guide_names_all_that_it_takes_from_the_workbench():
    guide = GUIDE.read_text(encoding="utf-8")
    for path in CIRCLE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("workbench"):
                for alias in node.names:
                    module = node.module or ""
                    written = (f"`{alias.name}`", f"`@{alias.name}`", f"{alias.name}(")
                    known = any(form in guide for form in written)
                    assert known or f"{module}.{alias.name}" in guide, f"{module}.{alias.name}"


def test_it_holds_what_is_promised():
    circle = lesson()
    (exercise,) = exercises_of(circle)
    counts = (len(circle.presets), len(circle.questions), len(exercise.mistakes))
    assert counts == (3, 2, 3)
    assert [line for line in look_at(Subject(circle)) if line is not None] == []


def test_its_story_has_three_scenes_and_the_turn():
    story = story_of(lesson(), "live")
    assert story is not None
    assert [scene.name for scene in story.scenes] == ["by-hand", "quick", "steps", "turn"]
    assert [scene.questions for scene in story.scenes] == [(), ("radius",), ("refined",), ()]


def test_its_numbers_are_those_of_its_runs():
    circle = lesson()
    run = Timeline(circle, circle.params()).complete()
    radii = [caption_of(step.scene).values["r"] for step in run.known()]
    assert [round(radius, 2) for radius in (radii[0], radii[-1])] == [0.77, 1.05]
    assert radii == sorted(radii)
    assert answer(circle, circle.questions[0], 0.75, timelines=Timelines()).right
    by_hand = Timeline(circle, circle.preset("hand").params).complete()
    offs = [caption_of(step.scene).values["off"] for step in by_hand.known()]
    best = offs.index(min(offs))
    assert abs(caption_of(by_hand[best].scene).values["r"] - radii[-1]) < 0.02
    assert by_hand.idle() == ()


def test_its_exercise_tells_right_from_wrong():
    (exercise,) = exercises_of(lesson())
    reports = [grade_function(item.function, exercise) for item in exercise.mistakes]
    assert [report.mistake for report in reports] == list(exercise.mistakes)
    assert grade_function(exercise.alternatives[0], exercise).is_full


def test_it_is_recorded_and_published(tmp_path):
    assert main(["record", str(CIRCLE), "-o", str(tmp_path / "circle.rrd")]) == 0
    assert open_recording(tmp_path / "circle.rrd").captions[0].startswith("Radius 0.767 m")
    publish(tmp_path / "site", [lesson()])
    page = (tmp_path / "site" / "circle" / "index.html").read_text(encoding="utf-8")
    assert 'id="quick"' in page
    assert 'data-question="radius"' in page
