import json
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from tests import fake
from tests.exercise.centroid import EXERCISE, centroid
from tests.exercise.formats import GRADESCOPE, departures
from workbench.cli import main
from workbench.errors import InputError
from workbench.exercise import reports
from workbench.exercise.candidate import Candidate, held_to_contract
from workbench.exercise.driven import _Beside, driven, first_difference, gap
from workbench.exercise.grading import grade_function
from workbench.exercise.judging import beside
from workbench.exercise.model import Exercise, Verdict, against, band, check, contract, full
from workbench.exercise.naming import values_alike
from workbench.exercise.sandbox import StudentError, Wall
from workbench.exercise.starter import starter
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Points, Scalar


def test_the_reference_has_full_marks_and_each_mistake_is_named():
    assert grade_function(centroid, EXERCISE).is_full
    for mistake in EXERCISE.mistakes:
        report = grade_function(mistake.function, EXERCISE)
        assert not report.is_full
        assert report.mistake is mistake


def test_an_unknown_mistake_is_not_named():
    assert grade_function(lambda p: p[0], EXERCISE).mistake is None
    assert (
        grade_function(lambda p: p.mean(0) + 1e-4, EXERCISE).outcomes[0].verdict.word == "partial"
    )


def test_a_check_that_stumbles_costs_itself_only():
    @check(1)
    def stumbles(candidate):
        """It stumbles."""
        raise KeyError("ours")

    exercise = replace(EXERCISE, checks=(stumbles, *EXERCISE.checks), mistakes=())
    report = grade_function(centroid, exercise)
    assert [outcome.verdict.word for outcome in report.outcomes] == ["fail", "pass", "pass", "pass"]
    assert "could not be judged" in report.outcomes[0].verdict.message


@pytest.mark.parametrize(
    ("value", "word"),
    [(0.05, "pass"), (0.1, "pass"), (0.5, "partial"), (2.1, "fail"), (np.nan, "fail")],
)
def test_bands_give_partial_credit(value, word):
    assert band("error", value, "degrees", good=0.1, fair=2.0, hint="Try.").word == word


@pytest.mark.parametrize("share", [-0.1, 1.1])
def test_a_verdict_is_a_share(share):
    with pytest.raises(ValueError, match="share"):
        Verdict(share, "x")


@pytest.mark.parametrize(
    ("value", "expected", "message"),
    [
        (np.zeros(2), np.zeros(3), r"an array \(2,\).*asks for an array \(3,\)"),
        (np.zeros(3), np.zeros(3, int), "float64 values.*whole numbers"),
        (None, np.zeros(3), "nothing.*return missing"),
        (np.array([np.inf, 0, 0]), np.zeros(3), "not finite"),
        ([1, 2], (1, 2, 3), "3 values"),
        ("a", 1.0, "a text"),
        ([[1, 2], [3]], np.zeros((2, 2)), "unequal length"),
    ],
)
def test_an_answer_is_held_to_the_contract(value, expected, message):
    with pytest.raises(StudentError, match=message):
        held_to_contract(value, expected, "f")


def test_a_right_answer_becomes_plain():
    got = held_to_contract(np.ones(3, np.float32), np.zeros(3), "f")
    assert got.dtype == np.float64
    assert held_to_contract(np.int32(3), 7, "f") == 3
    assert held_to_contract([np.ones(2), 1.5], (np.zeros(2), 0.0), "f")[1] == 1.5
    assert values_alike((np.ones(2), 1.0), [np.ones(2) + 1e-9, 1])


def test_reports_say_what_was_not_run():
    report = grade_function(centroid, EXERCISE, hidden=False, file="my.py")
    assert reports.counted(report) == "public 2/2 · hidden 1 not run here · 3 of 3 points"
    text = reports.terminal(grade_function(lambda p: p.sum(0), EXERCISE, file="my.py"))
    assert "✗ fail" in text
    assert "divide by the number of points" in text
    assert "passed" not in text


def held_to_schemas(folder):
    jsonschema = pytest.importorskip("jsonschema")
    result = json.loads((folder / "result.json").read_text())
    jsonschema.validate(result, json.loads(reports.SCHEMA.read_text()))
    root = ET.parse(folder / "junit.xml").getroot()
    assert list(departures(root)) == []
    scope = json.loads((folder / "results.json").read_text())
    jsonschema.validate(scope, GRADESCOPE)
    assert scope["score"] == sum(test["score"] for test in scope["tests"])
    return result, scope, root


def test_junit_that_jenkins_would_refuse_is_found():
    text = (
        '<testsuite name="a" tests="2" failures="0" errors="0"><testcase/><failure'
        ' x="1"/>text</testsuite>'
    )
    complaints = "; ".join(departures(ET.fromstring(text.replace("/>text", "/>"))))
    for complaint in ("testsuite holds", "testcase has []", "failure has ['x']", "tests of a is 2"):
        assert complaint in complaints


def test_files_for_machines_agree_with_the_report(tmp_path):
    report = grade_function(lambda p: p.sum(0), EXERCISE, file="<my>.py")
    reports.write_files([report], tmp_path)
    result, scope, suites = held_to_schemas(tmp_path)
    assert result["reports"][0]["points"] == report.points == scope["score"] == 1
    assert [suite.get("failures") for suite in suites] == ["2"]
    assert "| ✗ |" in (tmp_path / "summary.md").read_text()
    told = {test["name"]: "divide by the number" in test["output"] for test in scope["tests"]}
    assert [told[f"centroid: {outcome.check.promise}"] for outcome in report.outcomes] == [
        True,
        False,
        True,
    ]


def test_what_cannot_be_graded_has_files_too(tmp_path, capsys):
    file = tmp_path / "my_align_rigid.py"
    file.write_text("def align_rigid(a, b:\n\x1b[2J")
    assert main(["check", str(file), "-o", str(tmp_path / "out")]) == 2
    assert "line 2" in capsys.readouterr().err
    result, scope, suites = held_to_schemas(tmp_path / "out")
    assert result["reports"] == []
    assert scope["score"] == 0
    assert scope["tests"][0]["max_score"] == 10
    assert "my_align_rigid.py, line 2" in scope["output"]
    assert suites[0].get("errors") == "1"
    assert "could not be graded" in (tmp_path / "out" / "summary.md").read_text()


def test_marks_without_a_wall_say_so_in_every_report(tmp_path, monkeypatch, capsys):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "ada.py").write_text(
        "import numpy as np\ndef invert_rigid(T):\n    return np.linalg.inv(T)\n"
    )
    monkeypatch.setattr(
        "workbench.exercise.classroom.best", lambda: Wall("none", "nothing is installed")
    )
    assert main(["grade", str(tmp_path / "in")]) == 2
    assert "nothing is installed" in capsys.readouterr().err
    assert not (tmp_path / "in" / "graded").exists()
    assert main(["grade", str(tmp_path / "in"), "--sandbox", "none"]) in (0, 1)
    summary = (tmp_path / "in" / "graded" / "summary.md").read_text()
    assert reports.UNSAFE in summary
    assert (
        json.loads((tmp_path / "in" / "graded" / "students" / "ada.json").read_text())["sandbox"]
        == "none"
    )
    out = tmp_path / "one"
    main(["check", str(tmp_path / "in" / "ada.py"), "--sandbox", "none", "-o", str(out)])
    printed = capsys.readouterr()
    assert "runs without a sandbox" in printed.err
    assert reports.UNSAFE in printed.out
    for name in ("results.json", "junit.xml", "summary.md"):
        assert reports.UNSAFE in (out / name).read_text(), name


def test_the_starter_is_python_that_is_not_written_yet():
    text = starter(EXERCISE)
    scope: dict = {}
    exec(compile(text, "starter", "exec"), scope)
    with pytest.raises(NotImplementedError):
        scope["centroid"](np.ones((2, 3)))
    assert "numpy and scipy" in text
    assert "1 s and 2 GB" in text
    for part in (
        "centroid(np.array([[0, 0, 0], [2, 4, 6]]))",
        "workbench check my_centroid.py",
        "metres",
    ):
        assert part in text


def turning(angle: float) -> np.ndarray:
    return fake.turn_about_z(angle)


TURN = Exercise(
    name="turn",
    lesson="fake",
    task="Turn.",
    contract=contract(slot="turn")(turning),
    checks=EXERCISE.checks,
)


def test_the_right_function_never_differs():
    timeline = Timeline(driven(fake.lesson, TURN, turning), fake.Params()).complete()
    assert len(timeline) == 6
    assert first_difference(timeline.known()) is None
    assert not any(path.startswith("ghost/") for step in timeline.known() for path in step.scene)


@pytest.mark.parametrize("turned", [turning, lambda angle: fake.turn_about_z(-angle)])
def test_every_scene_beside_a_students_function_is_drawn_once(turned):
    drawn = []

    def draw(state):
        drawn.append(state)
        return fake.draw(state)

    Timeline(driven(replace(fake.lesson, draw=draw), TURN, turned), fake.Params(steps=4)).complete()
    assert len(drawn) == len({id(state) for state in drawn}) == 8


def test_a_wrong_function_differs_from_a_step_on_with_the_reference_as_ghost():
    timeline = Timeline(
        driven(fake.lesson, TURN, lambda angle: fake.turn_about_z(-angle)), fake.Params()
    ).complete()
    assert first_difference(timeline.known()) == 1  # at step 0 both turn by nothing
    assert "ghost/source" in timeline[1].scene
    assert timeline[1].caption.tone == "wrong"
    begins = [
        step.caption.text.startswith("Here your run first differs") for step in timeline.known()
    ]
    assert begins == [False, True, False, False, False, False]
    told: object = fake.draw(timeline[1].state.theirs)["caption"]
    assert isinstance(told, Caption)
    assert timeline[1].caption.text.endswith(told.text)
    assert "ghost/source" not in timeline[0].scene
    pair = timeline[1].state
    right = Timeline(fake.lesson, fake.Params()).complete()[1].state
    np.testing.assert_array_equal(pair.ours.T_world_source, right.T_world_source)
    assert not np.array_equal(pair.theirs.T_world_source, right.T_world_source)


def test_a_function_that_fails_becomes_the_caption_and_the_run_ends():
    def late(angle):
        if angle > 0.7:
            raise ValueError("too far")
        return fake.turn_about_z(angle)

    timeline = Timeline(driven(fake.lesson, TURN, late), fake.Params()).complete()
    assert timeline.stopped is None
    assert "too far" in timeline[-1].caption.text
    assert timeline[-1].caption.tone == "wrong"
    assert len(timeline) == 4


@pytest.mark.parametrize("where", ["run", "draw"])
def test_a_lesson_that_cannot_use_what_came_back_says_so_and_ends(where):
    def run(params, **slots):
        for state in fake.run(params, **slots):
            if where == "run" and state.T_world_source[2, 2] == 0:
                raise IndexError("index 9 is out of bounds")
            yield state

    def draw(state):
        return fake.draw(replace(state, error=state.error / state.T_world_source[2, 2].item()))

    lesson = replace(fake.lesson, run=run, draw=draw if where == "draw" else fake.draw)
    timeline = Timeline(
        driven(lesson, TURN, lambda angle: np.zeros((4, 4))), fake.Params()
    ).complete()
    assert timeline.stopped is None
    assert "cannot go on with what turn returned" in timeline[-1].caption.text
    assert ("ZeroDivisionError" if where == "draw" else "index 9") in timeline[-1].caption.text
    assert len(timeline) == 1


def test_a_run_that_is_watched_keeps_no_call_and_takes_any_right_answer():
    """A turn by the other right angle is no difference; its calls would fill the memory."""
    either = replace(TURN, contract=replace(TURN.contract, either=lambda T: T.T))
    for function in (turning, lambda angle: turning(-angle)):
        beside = _Beside(function, either)
        np.testing.assert_array_equal(beside(0.5), function(0.5))
        assert beside.called
        assert not beside.differed
        assert beside._candidate.calls == []
    beside = _Beside(lambda angle: turning(angle + 1.0), either)
    beside(0.5)
    assert beside.differed
    beside._candidate.function = turning
    beside(0.5)
    assert beside.differed  # once is enough


def test_a_driven_run_is_drawn_with_the_steps_before():
    seen = []

    def draw(look):
        seen.append([state.k for state in look.past])
        return fake.draw(look.now)

    def run(params, subject, *, turn=turning):
        yield from fake.run(params, turn=turn)

    lesson = replace(fake.lesson, setup=lambda params: None, run=run, draw=draw)
    Timeline(driven(lesson, TURN, turning), fake.Params(steps=3)).complete()
    assert seen == [past for past in ([], [0], [0, 1]) for _ in ("ours", "theirs")]


def dots(*p: tuple[float, float, float], T: np.ndarray | None = None) -> Points:
    return Points(np.array(p, dtype=float), T_world_object=T)


@pytest.mark.parametrize(
    ("a", "b", "apart"),
    [
        ({"p": dots((0, 0, 0), (1, 0, 0))}, {"p": dots((0, 0, 0), (1, 0, 0.5))}, 0.5),
        ({"p": dots((10, 0, 0))}, {"p": dots((5, 0, 0))}, 0.5),
        ({"p": dots((0.1, 0, 0))}, {"p": dots((0.2, 0, 0))}, 0.1),
        ({"p": dots((1, 0, 0))}, {"p": dots((0, 1, 0), T=turning(-np.pi / 2))}, 0.0),
        ({"p": dots((1, 0, 0))}, {"p": dots((1, 0, 0), (1, 0, 0))}, np.inf),
        ({"p": dots((1, 0, 0))}, {}, np.inf),
        ({"s": Scalar(4.0, "a", "A")}, {"s": Scalar(5.0, "a", "A")}, 0.25),
        ({"s": Scalar(0.5, "a", "A")}, {"s": Scalar(0.7, "a", "A")}, 0.2),
        ({"s": Scalar(np.nan, "a", "A")}, {"s": Scalar(np.nan, "a", "A")}, 0.0),
        ({"s": Scalar(np.nan, "a", "A")}, {"s": Scalar(1.0, "a", "A")}, np.inf),
        ({"caption": Caption("a")}, {"caption": Caption("b")}, 0.0),
        ({"caption": Caption("a")}, {}, 0.0),
    ],
)
def test_two_scenes_are_apart_by_what_is_farthest(a, b, apart):
    assert gap(a, b) == pytest.approx(apart, abs=1e-12)


def test_the_gap_is_what_can_be_seen():
    scene = Timeline(fake.lesson, fake.Params()).complete()
    assert gap(scene[1].scene, scene[1].scene) == 0
    assert gap(scene[1].scene, scene[2].scene) > 1e-3


def test_the_candidate_remembers_what_it_was_given():
    candidate = Candidate(lambda p: p.sum(0), centroid)
    p = np.ones((2, 3))
    candidate(p)
    assert candidate.calls[0].args[0] is p
    watched = Candidate(lambda p: p.sum(0), centroid, remember=False)
    watched(p)
    assert watched.calls == []


def test_an_exercise_needs_checks_with_names():
    with pytest.raises(ValueError, match="checks"):
        replace(EXERCISE, checks=())
    with pytest.raises(TypeError, match="docstring"):
        check(1)(lambda candidate: full("x"))


def test_errors_are_input_errors():
    assert issubclass(StudentError, InputError)


@pytest.mark.parametrize(
    ("got", "right", "message"),
    [
        (0.64, -0.64, "0.64, right is −0.64"),
        (1.00001, 1.0, "1.00001, right is 1"),
        (np.array([1.0, 2.0000001]), np.array([1.0, 2.0]), "(1, 2.0000001), right is (1, 2)"),
        (1e-19, 0.0, "0, right is 0 (off by 1e-19)"),
        (np.nan, 1.0, "nan, right is 1"),
    ],
)
def test_numbers_that_differ_are_written_so_that_they_differ(got, right, message):
    assert against(got, right) == message
    assert f"{message}. Look." in beside(got, right, "Look.")
