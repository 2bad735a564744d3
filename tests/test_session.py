import dataclasses
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fake import Params, lesson
from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import catalog
from workbench.run.session import Session, Shown
from workbench.run.timeline import Timelines
from workbench.scene import same


def settled(params=None) -> Session:
    session = Session(lesson)
    if params is not None:
        session.open(lesson, params)
    finish(session)
    return session


def seen(session: Session) -> Shown:
    look = session.look()
    assert look is not None
    return look


def finish(session: Session) -> None:
    while session.pending:
        session.compute(0.01)


def test_forward_back_and_scrub_show_the_very_same_scene_without_recomputing():
    session = settled(Params(steps=8))
    session.first()
    scenes = []
    for _ in range(8):
        scenes.append(seen(session).timeline[session.step].scene)
        session.forward()
    made = session.timeline
    session.timeline.extend = None  # type: ignore[method-assign]  # any computing from here on fails
    for k in (7, 3, 0, 5, 5, 2):
        session.seek(k)
        assert seen(session).k == k
        assert made[k].scene is scenes[k]
    session.seek(7)
    for k in range(6, -1, -1):
        session.back()
        assert seen(session).k == k
        assert made[k].scene is scenes[k]


@settings(max_examples=40)
@given(
    verbs=st.lists(
        st.sampled_from(["forward", "back", "first", "last", "seek", "compute", "change"]),
        max_size=30,
    )
)
def test_the_step_shown_is_always_one_that_is_known(verbs):
    session = Session(lesson)
    for i, verb in enumerate(verbs):
        if verb == "seek":
            session.seek(i)
        elif verb == "compute":
            session.compute(0.0)
        elif verb == "change":
            session.change(angle=i)
        else:
            getattr(session, verb)()
        look = session.look()
        if look is not None and look.known:
            assert 0 <= look.k < look.known
            assert same(look.timeline[look.k].scene["caption"], look.caption)


def test_a_new_value_abandons_the_run_in_progress():
    session = Session(lesson)
    session.open(lesson, Params(steps=5000))
    session.compute(0.0)
    slow = session.timeline
    session.change(angle=10)
    known = len(slow)
    session.compute(0.0)
    assert session.timeline is not slow
    assert len(slow) == known
    assert len(session.timeline) >= 1


def test_the_change_is_noticed_in_the_middle_of_computing():
    session = Session(lesson)
    session.open(lesson, Params(steps=5000))
    long = session.timeline
    extend = session.timeline.extend

    def extend_and_change() -> bool:
        session.change(angle=10)
        return extend()

    long.extend = extend_and_change  # type: ignore[method-assign]
    session.compute(60.0)
    assert len(long) == 1


def test_the_picture_stays_until_the_next_one_is_there():
    session = settled()
    before = seen(session)
    session.change(angle=33)
    meanwhile = seen(session)
    assert meanwhile.timeline is before.timeline
    assert meanwhile.params.angle == 33
    session.compute(0.0)
    assert seen(session).timeline is session.timeline


def test_values_from_a_browser_are_clamped_or_told_and_the_session_lives():
    session = settled()
    session.change(angle=99999)
    assert session.params.angle == 180
    session.change(colors="red")
    finish(session)
    assert seen(session).caption.tone == "wrong"
    assert "one of role" in seen(session).caption.text
    session.change(colors="role")
    finish(session)
    assert seen(session).caption.tone != "wrong" or "one of" not in seen(session).caption.text
    for value in ("x", None, float("nan"), True):
        session.seek(value)
    session.seek(10**12)
    assert session.step == len(session.timeline) - 1
    session.seek(-4)
    assert session.step == 0


@pytest.mark.parametrize("trouble", ["input", "crash"])
def test_a_run_that_fails_says_so_at_its_last_step(trouble):
    session = settled(Params(trouble=trouble))
    session.last()
    assert seen(session).caption.tone == "wrong"
    session.first()
    assert seen(session).caption.tone == "info"
    session.change(trouble="none")
    finish(session)
    session.last()
    assert "bug" not in seen(session).caption.text


def test_a_run_without_a_first_step_shows_its_reason():
    session = Session(lesson)
    session.open(lesson, Params(scan="/nowhere.npy"))  # type: ignore[arg-type]
    finish(session)
    look = seen(session)
    assert look.known == 0
    assert "not a .npy file" in look.caption.text


def test_another_version_of_the_lesson_goes_on_where_one_is_():
    session = settled(Params(angle=30.0))
    session.seek(3)
    session.go_on(dataclasses.replace(lesson), session.params)
    assert session.timeline.lesson is not lesson
    # saved again before a step was known
    session.go_on(dataclasses.replace(lesson), session.params)
    finish(session)
    look = seen(session)
    assert (look.k, look.params) == (3, Params(angle=30.0))
    session.last()
    session.go_on(lesson, Params(steps=9))
    finish(session)
    assert session.step == 8


def test_the_end_stays_the_end_when_a_knob_changes():
    session = settled()
    session.last()
    session.change(steps=9)
    finish(session)
    assert session.step == 8
    session.seek(3)
    session.change(steps=20)
    finish(session)
    assert session.step == 3


def test_a_preset_opens_where_it_says():
    session = settled()
    session.use_preset("short")
    finish(session)
    assert session.params == Params(steps=2)
    assert session.step == 1
    with pytest.raises(InputError, match="there are: half, short"):
        session.use_preset("nothing")


def test_two_sessions_share_runs_but_not_places():
    shared = Timelines()
    first, second = Session(lesson, shared), Session(lesson, shared)
    finish(first)
    first.seek(3)
    second.seek(1)
    assert first.timeline is second.timeline
    assert (first.step, second.step) == (3, 1)


def test_a_session_with_a_students_function_does_not_share_its_run():
    shared = Timelines()
    ours = Session(lesson, shared)
    theirs = Session(lesson, shared, {"turn": lambda angle: 1 / 0})
    finish(ours)
    finish(theirs)
    assert len(ours.timeline) == 6
    assert "ZeroDivisionError" in seen(theirs).caption.text


OWN_FILES = [
    (
        "icp",
        {
            "target": Path("a.ply"),
            "source": Path("b.ply"),
            "truth": Path("T.txt"),
            "unit": "mm",
            "up": "y",
        },
    ),
    ("curvature", {"mesh": Path("cow.obj")}),
    ("disparity", {"left": Path("l.png"), "right": Path("r.png")}),
    ("ransac", {"cloud": Path("room.xyz")}),
]


@pytest.mark.parametrize(("name", "files"), OWN_FILES, ids=[name for name, _ in OWN_FILES])
def test_reset_and_presets_keep_own_files_and_how_to_read_them(name, files):
    lesson = catalog()[name]
    session = Session(lesson)
    mine = dataclasses.replace(lesson.params(), **files)
    for preset in lesson.presets:
        session.open(lesson, mine)
        session.use_preset(preset.name)
        assert session.params == dataclasses.replace(preset.params, **files)
    session.change(seed=7)
    session.reset()
    assert session.params == mine
    session.change(
        **(
            dict.fromkeys(files, None)
            if name != "icp"
            else {"target": None, "source": None, "truth": None}
        )
    )
    session.reset()
    # without files nothing is kept, also not how to read them
    assert session.params == lesson.params()


@pytest.mark.parametrize(("name", "files"), OWN_FILES, ids=[name for name, _ in OWN_FILES])
@pytest.mark.parametrize("back", ["reset", "preset"])
def test_a_run_of_the_lesson_s_own_data_puts_own_files_aside_and_reset_and_presets_bring_them_back(
    name, files, back
):
    lesson = catalog()[name]
    session = Session(lesson)
    mine = dataclasses.replace(lesson.params(), **files)
    session.open(lesson, mine)
    for question in lesson.questions:
        session.open(lesson, question.params, 0)
        session.change(seed=7)
        session.open(lesson, session.params, 1)  # a link to a step of the run that is open
        assert session.params == dataclasses.replace(question.params, seed=7)
        assert session.own == mine
    preset = lesson.presets[-1]
    session.reset() if back == "reset" else session.use_preset(preset.name)
    assert session.params == dataclasses.replace(
        lesson.params() if back == "reset" else preset.params, **files
    )
    assert session.own is session.params


def test_files_that_are_put_aside_are_forgotten_one_by_one_or_come_back_with_another():
    lesson = catalog()["icp"]
    made = lesson.params()
    mine = dataclasses.replace(made, target=Path("a.ply"), source=Path("b.ply"), unit="mm")
    session = Session(lesson)
    session.open(lesson, mine)
    session.open(lesson, made)
    session.change(target=Path("c.ply"), start_angle=40)
    assert (
        session.params
        == session.own
        == dataclasses.replace(mine, target=Path("c.ply"), start_angle=40)
    )
    session.open(lesson, made)
    session.change(target=7)
    assert session.message
    assert session.own.target == Path("c.ply")  # what cannot be used changes nothing
    session.change(target=None)
    assert (session.params, session.own.target, session.own.source) == (made, None, Path("b.ply"))
    session.change(source=None)
    assert session.own is session.params
    session.reset()
    assert session.params == made


def test_another_lesson_lets_own_files_go_and_another_version_keeps_what_is_put_aside():
    icp, other = catalog()["icp"], catalog()["curvature"]
    mine = dataclasses.replace(icp.params(), target=Path("a.ply"), source=Path("b.ply"))
    session = Session(icp)
    session.open(icp, mine)
    session.open(icp, icp.params())
    session.go_on(dataclasses.replace(icp), session.params, session.own)
    assert session.own == mine
    session.open(other)
    session.open(icp)
    session.reset()
    assert session.params == session.own == icp.params()


def test_params_that_name_files_themselves_keep_theirs():
    params = catalog()["icp"].params
    theirs = params(target=Path("theirs.ply"), source=Path("too.ply"))
    assert knobs.with_own_files(theirs, params(target=Path("mine.ply"), unit="mm")) == theirs
