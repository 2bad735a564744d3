"""A teacher's own seed: other hidden inputs, the same marks for the same work, nothing for a table
of answers.
"""

import json
from dataclasses import replace

import pytest

from tests.exercise.batch import write_class
from tests.exercise.centroid import EXERCISE
from workbench.cli import main
from workbench.exercise import classroom, finding
from workbench.exercise.candidate import Call, Returned
from workbench.exercise.finding import exercises
from workbench.exercise.grading import grade_function
from workbench.exercise.marking import Asked
from workbench.exercise.reports import as_dict, terminal
from workbench.exercise.sandbox import best
from workbench.exercise.seeds import MOST, HiddenSeed, drawn_from

SEED = 2
EACH = pytest.mark.parametrize("exercise", exercises().values(), ids=lambda exercise: exercise.name)


def test_the_usual_seed_holds_where_no_teacher_says_another():
    seed, other = HiddenSeed(7), HiddenSeed(8)
    with drawn_from(None):
        assert seed() == 7
    with drawn_from(SEED):
        drawn = seed()
        assert drawn == seed()
        assert 7 != drawn != other()
        assert 0 <= drawn < MOST
    with drawn_from(SEED + 1):
        assert seed() != drawn
    assert seed() == 7


@EACH
def test_right_functions_earn_full_marks_from_another_seed(exercise):
    for function in (exercise.reference, *exercise.alternatives):
        report = grade_function(function, exercise, seed=SEED)
        assert report.is_full, terminal(report)
        assert f"seed {SEED}" in terminal(report)
        assert as_dict(report)["seed"] == SEED


@EACH
def test_a_table_of_answers_is_worth_little_from_another_seed(exercise):
    table = {}

    def key(args):
        return Call(args, Returned(None, ""), Returned(None, "")).key

    def learning(*args):
        try:
            table[key(args)] = exercise.reference(*args)
        except Exception as error:
            table[key(args)] = error
            raise
        return table[key(args)]

    def learnt(*args):
        value = table[key(args)]
        if isinstance(value, Exception):
            raise value
        return value

    assert grade_function(learning, exercise).is_full
    assert grade_function(learnt, exercise).is_full
    hidden = [
        outcome
        for outcome in grade_function(learnt, exercise, seed=SEED).outcomes
        if not outcome.check.public
    ]
    asked = sum(outcome.check.points for outcome in hidden)
    earned = sum(outcome.points for outcome in hidden)
    # what is at the ends, such as no point at all, is the same for everybody
    assert earned <= 0.6 * asked
    drawn = [outcome for outcome in hidden if outcome.verdict.share == 0]
    assert drawn


def of_the_centroid(monkeypatch):
    quick = replace(EXERCISE, contract=replace(EXERCISE.contract, seconds=0.4))
    monkeypatch.setattr(finding, "exercises", lambda: {"centroid": quick})


def test_the_same_seed_gives_equal_bytes_and_every_report_names_it(tmp_path, monkeypatch):
    of_the_centroid(monkeypatch)
    write_class(tmp_path / "in", 6)
    for out in ("one", "two"):
        results = classroom.grade_class(tmp_path / "in", tmp_path / out, asked=Asked(seed=SEED))
    assert {result["seed"] for result in results} == {SEED}
    assert {report["seed"] for result in results for report in result["reports"]} == {SEED}
    assert f"seed {SEED}." in (tmp_path / "one" / "summary.md").read_text()
    for path in sorted((tmp_path / "one").rglob("*.*")):
        assert (
            path.read_bytes()
            == (tmp_path / "two" / path.relative_to(tmp_path / "one")).read_bytes()
        )


def test_marks_of_another_seed_are_not_kept(tmp_path, monkeypatch):
    of_the_centroid(monkeypatch)
    write_class(tmp_path / "in", 3)
    graded = []
    for seed in (None, 1, 2):
        classroom.grade_class(
            tmp_path / "in",
            tmp_path / "out",
            asked=Asked(seed=seed),
            progress=lambda name, *_: graded.append(name),
        )
    assert len(graded) == 3 * 3
    assert json.loads(next((tmp_path / "out" / "students").iterdir()).read_text())["seed"] == 2


@pytest.mark.skipif(not best().holds, reason="nothing shuts submissions in here")
def test_the_command_takes_a_seed(tmp_path, monkeypatch, capsys):
    of_the_centroid(monkeypatch)
    (tmp_path / "ada.py").write_text("def centroid(p):\n    return p.mean(axis=0)\n")
    assert main(["grade", str(tmp_path), "--seed", "5"]) == 0
    assert "drawn from seed 5." in capsys.readouterr().out
    assert main(["grade", str(tmp_path), "--seed", "-1"]) == 2
    assert capsys.readouterr().err == "workbench: --seed -1: a seed is 0 or more\n"
