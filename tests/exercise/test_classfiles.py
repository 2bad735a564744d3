"""The tables and the summary that a teacher reads of a class, down to the last cell."""

from typing import Any

from workbench.exercise.classfiles import class_csv, is_full, matrix_csv, summary
from workbench.exercise.reports import UNSAFE


def check(name: str, points: float, kind: str = "", *, message: str = "") -> dict[str, Any]:
    return {"name": name, "points": points, "possible": 2.0, "kind": kind, "message": message}


def report(exercise: str, *checks: dict[str, Any], mistake: str = "") -> dict[str, Any]:
    wrong = [entry["name"] for entry in checks if entry["points"] < 2.0]
    return {
        "exercise": exercise,
        "points": sum(entry["points"] for entry in checks),
        "possible": 2.0 * len(checks),
        "checks": list(checks),
        "mistake": {"name": mistake, "sentence": f"You {mistake}.", "checks": wrong[:1]}
        if mistake
        else None,
    }


def handed(student: str, *reports: dict[str, Any], **more: Any) -> dict[str, Any]:
    plain = {"ungraded": [], "handed": [], "note": "", "seed": None, "sandbox": "bubblewrap"}
    return {"student": student, "reports": list(reports)} | plain | more


def lost(exercise: str | None, possible: float, error: str) -> dict[str, Any]:
    return {"exercise": exercise, "points": 0, "possible": possible, "error": error}


FULL = report("a", check("one", 2.0), check("two", 2.0))
CLASS = [
    handed("ada", FULL, report("b", check("one", 2.0))),
    handed("bob", report("a", check("one", 1.0), check("two", 0.0, "timeout"), mistake="summed")),
    handed("eve", report("a", check("one", 0.0, "died"), check("two", 0.0, "died"))),
    handed("kim", ungraded=[lost("a", 4.0, "no Python"), lost(None, 0, "no *text*")], note="late"),
    handed("=lea", report("a", check("one", 0.0, "raised"), check("two", 2.0), mistake="summed")),
]
FORBIDDEN = [check(name, 0.0, "forbidden", message="uses scipy") for name in ("one", "two")]


def test_a_row_is_a_student_s_points():
    assert class_csv(CLASS).splitlines() == [
        "student,points,possible,a,b,trouble",
        "ada,6,6,4,2,",
        "bob,1,4,1,,a hangs in 1 check",
        "eve,0,4,0,,a crashes in 2 checks",
        "kim,0,4,0,,no Python; no *text*; late",
        "'=lea,2,4,2,,",
    ]


def test_an_assignment_counts_its_exercises_and_nothing_else():
    worth = {"b": 10.0, "a": 1.0}
    lines = class_csv(CLASS, worth).splitlines()
    assert lines[0] == "student,points,possible,b,a,trouble"
    assert lines[1:3] == ["ada,11,11,10,1,", "bob,0.25,11,,0.25,a hangs in 1 check"]
    assert class_csv(CLASS[:1], {"a": 1.0}).splitlines()[1] == "ada,1,1,1,b is not asked for"
    assert [is_full(result, {"a": 1.0}) for result in CLASS] == [True, False, False, False, False]
    assert not is_full(handed("max", FULL), {"a": 1.0, "c": 1.0})
    assert not is_full(handed("max", FULL, ungraded=[lost("c", 1, "no")]))
    assert not is_full(handed("max"))


def test_what_is_there_of_a_lesson_is_told_where_nobody_asked_for_all():
    some = [handed("ada", FULL, handed=["fake 1 of 2", "icp 1 of 9"]), handed("bob", FULL)]
    assert class_csv(some).splitlines() == [
        "student,points,possible,a,handed in,trouble",
        'ada,4,4,4,"fake 1 of 2, icp 1 of 9",',
        "bob,4,4,4,,",
    ]
    assert "handed in" not in class_csv(some, {"a": 4.0})
    assert summary([*some, some[0]]).splitlines()[4:] == [
        "Of these lessons not all exercises were handed in:",
        "",
        "- fake 1 of 2: 2 students",
        "- icp 1 of 9: 2 students",
    ]
    assert "with full marks in what they handed in," in summary(some)
    assert "handed in" not in summary(some, {"a": 4.0})


def test_a_column_is_a_check_and_what_went_wrong_in_it():
    assert matrix_csv(CLASS).splitlines() == [
        "student,a.one,a.two,b.one",
        "ada,1,1,1",
        "bob,0.5,hangs,",
        "eve,crashes,crashes,",
        "kim,,,",
        "'=lea,raises,1,",
        "graded,4,4,1",
        "full marks,1,2,1",
        "mean share,0.375,0.5,1",
        "most frequent mistake,summed (2),,",
    ]


def test_a_summary_says_what_a_teacher_looks_for_first():
    refused = handed("max", report("a", *FORBIDDEN), seed=7, sandbox="none")
    assert summary([*CLASS, refused]).splitlines() == [
        "# 6 submissions",
        "",
        "5 graded, 1 with full marks, 1 could not be graded.",
        "",
        "Hidden checks are drawn from seed 7.",
        "",
        f"**{UNSAFE}**",
        "",
        "Most frequent mistakes:",
        "",
        "- 2 × You summed.",
        "",
        "To look at:",
        "",
        "- bob: a hangs in 1 check",
        "- eve: a crashes in 2 checks",
        "- kim: no Python; no \\*text\\*; late",
        "- max: uses scipy",
    ]
    assert summary([handed("ada", FULL)]) == (
        "# 1 submission\n\n1 graded, 1 with full marks, 0 could not be graded.\n"
    )
