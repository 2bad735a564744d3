"""A student's file drives a lesson: what is said of it while it is edited, and when its function is
called.
"""

import dataclasses

import pytest

from workbench.cli import main
from workbench.errors import InputError
from workbench.exercise import finding
from workbench.exercise.driven import DIFFERENCE, calls_it, driven, first_difference, gap
from workbench.exercise.finding import exercises
from workbench.exercise.starter import write_starter
from workbench.exercise.watching import GONE_AFTER, WatchedFile
from workbench.lesson import catalog
from workbench.run.session import Session
from workbench.run.timeline import Timeline

SUMS = exercises()["sad_cost_volume"]
RIGHT = """import numpy as np


def align_rigid(p_target, p_source):
    print("called with", len(p_source))
    q, p = p_target.mean(0), p_source.mean(0)
    U, _, Vt = np.linalg.svd((p_source - p).T @ (p_target - q))
    R = Vt.T @ np.diag([1, 1, np.sign(np.linalg.det(U @ Vt))]) @ U.T
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, q - R @ p
    return T
"""
BROKEN = RIGHT.replace("q, p =", "q, p = 1 / 0,")


@pytest.fixture
def watched(tmp_path):
    file = tmp_path / "my_align_rigid.py"
    file.write_text(RIGHT)
    made = WatchedFile(catalog()["icp"], file)
    yield made
    made.close()


def calls(watched: WatchedFile) -> int:
    return watched.printed().count("called with")


def to_the_end(session: Session) -> int:
    while session.pending:
        session.compute(10.0)
    return len(session.timeline)


def test_going_back_never_calls_the_function_again(watched):
    session = Session(watched.lesson)
    steps = to_the_end(session)
    called = calls(watched)
    assert called > 3
    session.last()
    for _ in range(steps + 2):
        session.back()
        assert session.look() is not None
    assert session.step == 0
    session.last()
    session.look()
    assert calls(watched) == called


def test_what_it_prints_in_the_run_is_kept_apart_for_each_save(watched):
    to_the_end(Session(watched.lesson))
    assert watched.printed().startswith("called with ")
    watched.path.write_text(RIGHT.replace("called with", "asked for"))
    assert watched.changed()
    assert watched.printed() == ""
    to_the_end(Session(watched.lesson))
    assert watched.printed().startswith("asked for ")


def test_a_file_that_is_gone_is_said_and_what_ran_stays(watched):
    watched.check()
    report, lesson = watched.said, watched.lesson
    text = watched.path.read_text()
    watched.path.unlink()
    assert not watched.changed()
    assert watched.said is report  # an editor may be replacing it
    for _ in range(GONE_AFTER):
        assert not watched.changed()
    assert str(watched.said).startswith("my_align_rigid.py is gone")
    assert watched.lesson is lesson
    watched.path.write_text(text)
    assert watched.changed()
    watched.check()
    assert watched.said == report


def test_a_file_is_gone_after_four_looks_and_not_before(tmp_path, watched):
    text = watched.path.read_text()
    for _ in range(2):
        watched.path.unlink()
        for missing in range(GONE_AFTER):
            assert "is gone" not in str(watched.said), missing
            assert not watched.changed()
        assert "is gone" in str(watched.said)
        watched.path.write_text(text)
        assert watched.changed()


def test_a_file_that_is_no_text_is_said_and_what_ran_stays(watched):
    lesson = watched.lesson
    watched.path.write_bytes(b"\xff\xfe\x00" * 9)
    assert not watched.changed()
    assert "cannot be read as text" in str(watched.said)
    assert watched.lesson is lesson
    assert to_the_end(Session(lesson)) > 3


def test_after_an_error_is_mended_the_step_is_kept(watched):
    session = Session(watched.lesson)
    steps = to_the_end(session)
    session.seek(5)
    for text in (BROKEN, RIGHT):
        before = watched.lesson
        watched.path.write_text(text)
        assert watched.changed()
        assert watched.lesson is not before
        session.go_on(watched.lesson, session.params)
        known = to_the_end(session)
        assert (session.step, known) == ((known - 1, known) if text is BROKEN else (5, steps))
        assert (known < 5) == (text is BROKEN)


@pytest.mark.parametrize(
    "function",
    [*SUMS.alternatives, SUMS.mistakes[0].function],
    ids=lambda function: function.__name__,
)
def test_rounding_that_decides_between_equal_costs_is_no_first_difference(function):
    lesson = catalog()[SUMS.lesson]
    timeline = Timeline(driven(lesson, SUMS, function), lesson.params())
    while len(timeline) < 10 and timeline.extend():
        pass
    assert (first_difference(timeline.known()) is None) == (function in SUMS.alternatives)


# the run that is opened calls the function --------------------------------------------------------


@pytest.fixture
def opened(monkeypatch):
    """Carries out `show`, and returns the lesson, the params and the step that the page begins
    at.
    """
    seen = []
    monkeypatch.setattr(
        "workbench.viewer.serving.serve", lambda *place, **options: seen.append((place, options))
    )

    def carry_out(*words: object):
        assert main(["show", *map(str, words)]) == 0
        place, options = seen.pop()
        if options["watched"] is not None:
            options["watched"].close()
        return place

    return carry_out


@pytest.mark.parametrize("exercise", exercises().values(), ids=lambda exercise: exercise.name)
def test_the_run_that_is_opened_calls_the_function(exercise, opened, tmp_path):
    _, params, step = opened(exercise.lesson, "--with", write_starter(exercise, tmp_path))
    lesson = catalog()[exercise.lesson]
    calls = []

    def counting(*args):
        calls.append(args)
        return exercise.reference(*args)

    run = lesson.form.states(params, {exercise.contract.slot: counting})
    assert next((True for _ in run if calls), False)
    preset = exercise.contract.preset
    assert step == (None if preset is None else lesson.preset(preset).step)
    if preset is not None:  # or else the default run would do
        calls.clear()
        for _ in lesson.form.states(lesson.params(), {exercise.contract.slot: counting}):
            assert not calls


@pytest.mark.parametrize("words", [("--preset", "home"), ("--start-angle", "50")])
def test_who_chooses_a_run_gets_that_one(opened, tmp_path, words):
    file = write_starter(exercises()["point_to_plane_step"], tmp_path)
    assert opened("icp", "--with", file, *words)[1:] == opened("icp", *words)[1:]


def test_an_unknown_preset_is_refused_in_one_line(monkeypatch):
    lesson = catalog()["icp"]
    wrong = dataclasses.replace(exercises()["match"].contract, preset="hoem")
    monkeypatch.setattr("lessons.icp.exercises.match.match", wrong)
    with pytest.raises(
        InputError, match=r"^exercise match: lesson icp has no preset 'hoem'; did you mean home"
    ):
        finding.exercises_in_folder(lesson)


def test_a_run_that_does_not_call_the_function_says_so():
    exercise = exercises()["point_to_plane_step"]
    lesson = catalog()["icp"]
    paired = driven(lesson, exercise, exercise.reference)
    idle = Timeline(paired, lesson.params())
    calling = Timeline(paired, lesson.preset("plane").params)
    assert calls_it(idle) is None  # nobody knows yet
    idle.extend()
    assert calls_it(idle) is None
    plain = Timeline(lesson, lesson.params())
    plain.extend()
    assert calls_it(plain) is None  # a run of ours calls ours
    assert calls_it(idle.complete()) is False
    assert DIFFERENCE not in idle.series()  # nothing is compared
    while len(calling) < 3:
        calling.extend()
    assert calls_it(calling) is True
    assert DIFFERENCE in calling.series()


def test_how_far_a_step_is_off_is_measured_by_the_reference():
    exercise = exercises()["point_to_plane_step"]
    lesson = catalog()["icp"]
    params = lesson.preset("plane").params

    def doubled(p_target, p_source, n_target):
        return exercise.reference(p_target, 2 * p_source, n_target)

    ours = Timeline(lesson, params)
    theirs = Timeline(driven(lesson, exercise, doubled), params)
    for _ in range(3):
        ours.extend()
        theirs.extend()
    pairs = list(zip(ours.known(), theirs.known(), strict=True))
    for right, wrong in pairs:
        assert wrong.state.difference == gap(right.scene, wrong.state.scene)
    right, wrong = pairs[-1]
    assert wrong.state.difference != gap(wrong.state.scene, right.scene)
