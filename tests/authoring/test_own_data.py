"""Own files in all lessons: each knob shows one and refuses a bad one; a stage that shows it opens;
messages name knobs.
"""

from dataclasses import replace

import pytest

from tests import fake
from workbench.authoring.own_data import made_files, own_files_are_read
from workbench.authoring.promises import Subject
from workbench.cli import main
from workbench.errors import InputError
from workbench.knobs import called, called_by_flags, fields_of, in_words, paths_of, showing
from workbench.lesson import course
from workbench.run.session import Session
from workbench.run.timeline import Timeline

WITH_FILES = [
    (name, field.name)
    for name, lesson in course().items()
    for field in fields_of(lesson.params)
    if field.kind == "path"
]
BOUND = [
    (name, field)
    for name, field in WITH_FILES
    if next(param for param in fields_of(course()[name].params) if param.name == field).knob.needs
]


def test_a_file_that_is_not_read_is_found():
    def run(params):
        yield from fake.lesson.run(replace(params, scan=None))

    wrong = [line for line in own_files_are_read(Subject(replace(fake.lesson, run=run))) if line]
    assert any("scan = bad.zzz shows the lesson all the same" in line for line in wrong)


def test_a_file_that_no_made_one_is_like_is_found():
    def run(params):
        if params.scan is not None:
            raise InputError("only files of mine")
        yield from fake.lesson.run(params)

    wrong = [line for line in own_files_are_read(Subject(replace(fake.lesson, run=run))) if line]
    assert any("scan took none of" in line for line in wrong)


@pytest.mark.parametrize(("name", "field"), BOUND)
def test_a_file_opens_a_stage_that_shows_it(tmp_path, name, field):
    lesson = course()[name]
    needs = next(param for param in fields_of(lesson.params) if param.name == field).knob.needs
    for preset in (None, *lesson.presets):
        session = Session(lesson)
        if preset is not None:
            session.use_preset(preset.name)
        before = session.params
        session.change(**{field: tmp_path / "mine.xyz"})
        assert getattr(session.params, field) == tmp_path / "mine.xyz"
        for other, wanted in needs.items():
            assert getattr(session.params, other) in wanted
            if getattr(before, other) in wanted:
                assert getattr(session.params, other) == getattr(before, other)


@pytest.mark.parametrize(("name", "field"), WITH_FILES)
def test_what_is_wrong_with_a_file_names_knobs_as_the_page_does(tmp_path, name, field):
    lesson = course()[name]
    path = made_files(tmp_path)["bad.zzz"]
    params = showing(replace(lesson.params(), **{field: path}), [field])
    timeline = Timeline(lesson, params)
    timeline.extend()
    assert timeline.stopped is not None
    assert "--" not in timeline.stopped
    assert timeline.stopped.isprintable()
    with called_by_flags():
        again = Timeline(lesson, params)
        again.extend()
    if "“" in timeline.stopped:
        assert "--" in (again.stopped or "")


def test_a_pair_of_pictures_can_be_handed_over_one_after_the_other(tmp_path):
    files = made_files(tmp_path)
    lesson = course()["disparity"]
    session = Session(lesson)
    session.change(left=files["photo.png"])
    session.compute(0.0)
    look = session.look()
    assert look is not None
    assert "give both “Left” and “Right”" in look.caption.text
    session.change(right=files["photo.png"])
    session.compute(0.0)
    assert session.timeline.stopped is None or "give both" not in session.timeline.stopped


def test_a_command_names_flags_and_keeps_the_choice_that_was_made(tmp_path, capsys):
    files = made_files(tmp_path)
    words = [
        "record",
        "distances",
        "--mesh",
        str(files["mesh.off"]),
        "--out",
        str(tmp_path / "a.rrd"),
    ]
    assert main([*words, "--stage", "balls"]) == 2
    assert "--mesh is read where --stage is surface" in capsys.readouterr().err
    words = [
        "record",
        "disparity",
        "--left",
        str(files["photo.png"]),
        "--out",
        str(tmp_path / "b.rrd"),
    ]
    assert main(words) == 2
    assert "give both --left and --right" in capsys.readouterr().err


def test_a_name_that_is_no_param_stays_a_word():
    message = f"give {called('scan')} or {called('nothing')}"
    assert in_words(message, fake.Params) == "give “Scan” or “nothing”"
    assert paths_of(fake.Params) == ["scan"]
