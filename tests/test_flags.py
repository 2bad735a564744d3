"""Commands that are printed for a run open that run: each goes through a shell's words and the real
parser.
"""

import functools
import shlex
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests import fake
from workbench.commands.watching import show
from workbench.errors import InputError
from workbench.knobs import fields_of
from workbench.lesson import Lesson, catalog
from workbench.run.flags import RunChoice, parse
from workbench.run.links import command_line, show_command

LESSONS = list(catalog().values())


def opened(command: str) -> RunChoice:
    """What a command opens, read as a shell and then `workbench show` read it."""
    program, verb, *words = shlex.split(command)
    assert (program, verb) == ("workbench", "show")
    seen: list[RunChoice] = []

    @functools.wraps(show)
    def seeing(run, serving, step=None, *, with_=None):
        seen.append(run)

    parse(seeing, words, "workbench show", description="")()
    return seen[0]


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda lesson: lesson.name)
def test_the_command_of_every_preset_and_question_opens_its_run(lesson: Lesson):
    for params in (
        lesson.params(),
        *(named.params for named in (*lesson.presets, *lesson.questions)),
    ):
        command = show_command(lesson, params)
        run = opened(command)
        assert (run.lesson, run.params) == (lesson, params), command


def values_of(field) -> st.SearchStrategy:
    knob = field.knob
    if field.kind == "bool":
        return st.booleans()
    if field.kind == "choice":
        return st.sampled_from(field.choices)
    if field.kind == "path":
        return st.none()
    whole = field.kind in ("int", "ints")
    number = st.integers(int(knob.low), int(knob.high)) if whole else st.floats(knob.low, knob.high)
    return st.tuples(*[number] * field.length) if field.length else number


@settings(max_examples=40, derandomize=True, deadline=None)
@given(chosen=st.data())
def test_the_command_of_any_params_opens_them(chosen):
    lesson = chosen.draw(st.sampled_from(LESSONS))
    values = {
        field.name: chosen.draw(values_of(field), field.name) for field in fields_of(lesson.params)
    }
    try:
        params = lesson.validated(lesson.params(**values))
    except ValueError:
        return  # what the lesson itself refuses together
    assert opened(show_command(lesson, params)).params == params


def test_a_command_can_be_read_by_a_shell_and_by_a_person(monkeypatch):
    monkeypatch.setitem(catalog().asked, "fake", fake.lesson)
    params = fake.Params(angle=30.0, wobble=True, place=(-1.0, 0.25, 0.0), pixel=(1, 2))
    assert (
        show_command(fake.lesson, params)
        == "workbench show fake --angle=30 --wobble --place=-1,0.25,0 --pixel=1,2"
    )
    assert command_line("replay", Path("my runs/a$b.rrd")) == "workbench replay 'my runs/a$b.rrd'"


def test_a_command_names_no_file_of_the_machine_it_was_printed_on(monkeypatch):
    monkeypatch.setitem(catalog().asked, "fake", fake.lesson)
    assert (
        show_command(fake.lesson, fake.Params(scan=Path("/home/ann/secret/scan.npy")))
        == "workbench show fake --scan=FILE"
    )


def test_a_single_file_lesson_is_named_by_its_file(monkeypatch):
    monkeypatch.chdir(Path(fake.__file__).parent)
    mine = replace(fake.lesson, name="mine")
    command = show_command(mine, fake.Params(steps=2))
    assert command == "workbench show fake.py --steps=2"
    assert opened(command).params.steps == 2


def test_a_student_s_file_behind_a_flag_is_not_taken_for_the_lesson(tmp_path):
    evil = tmp_path / "my_align_rigid.py"
    evil.write_text(f"open({str(tmp_path / 'was-run')!r}, 'w')\n")
    (tmp_path / "mine.py").write_text("from tests.fake import lesson\n")
    assert opened(command_line("show", "--with", evil, "icp")).lesson.name == "icp"
    with pytest.raises(InputError, match="which lesson"):
        opened(command_line("show", "--with", evil))
    with pytest.raises(InputError, match="which lesson"):
        opened(command_line("show", "--scan", evil))  # a flag of whatever lesson it might be
    with pytest.raises(InputError, match="--scan"):
        opened(command_line("show", "--scan", evil, "icp"))
    assert opened(command_line("show", "--no-browser", tmp_path / "mine.py")).lesson is fake.lesson
    assert not (tmp_path / "was-run").exists()


def test_flags_stand_where_people_put_them(monkeypatch):
    monkeypatch.setitem(catalog().asked, "fake", fake.lesson)
    for words in (
        "fake --place -1,0.25,0 --no-wobble --step -1",
        "--place=-1,0.25,0 fake --step=-1 --no-wobble",
        "--no-browser --no-wobble fake --place -1,.25,-0 --port 0",
    ):
        assert opened(f"workbench show {words}").params == fake.Params(
            place=(-1.0, 0.25, 0.0), wobble=False
        )
    assert (
        opened("workbench show icp --start_angle 120").params
        == opened("workbench show --start-angle=120 icp").params
    )
