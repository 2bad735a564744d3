"""A lesson's exercises on its page: the task and the contract as HTML, and what the checks found as
plain data.
"""

from collections.abc import Callable, Iterable
from html import escape
from typing import Any

from workbench.exercise.grading import Report
from workbench.exercise.model import Exercise
from workbench.exercise.reports import MARKS, counted, shown
from workbench.exercise.starter import commands, starter
from workbench.lesson import Lesson


def exercises_html(exercises: Iterable[Exercise]) -> str:
    """Return the section of a lesson's exercises; nothing where it has none."""
    tasks = "".join(_task(exercise) for exercise in exercises)
    return (
        f'<section class="s-exercise" id="exercise"><h2>Exercise</h2>{tasks}</section>'
        if tasks
        else ""
    )


def watched_html(
    exercise: Exercise, file: str, lesson: Lesson, *, address: Callable[[str], str]
) -> str:
    """Return the section of the exercise whose function is watched, in a student's file.

    It has one sentence for runs that call the function and one for those that do not; the page
    shows the one that is true.

    Args:
        exercise: What the file is for.
        file: Its name.
        lesson: The lesson that it drives.
        address: The address of a run of the lesson: of a preset by its name, or of `default`.
    """
    run = exercise.contract.preset or "default"
    title = (
        "The run this lesson opens with"
        if run == "default"
        else f"The experiment “{lesson.preset(run).title}”"
    )
    link = (
        f'<a class="run" href="{escape(address(run))}" data-run="{escape(run)}">{escape(title)}</a>'
    )
    name = escape(exercise.name)
    return (
        f'<section class="s-exercise" id="exercise"><h2>Your {name}</h2><p data-called="true"'
        f" hidden><code>{escape(file)}</code> drives this lesson; save it, and the run is new."
        ' Where the two differ, the run of the reference is the faint ghost.</p><p class="mistake"'
        f' data-called="false" hidden>This run never calls <code>{name}</code>, so it looks the'
        f' same whatever the function does. {link} calls it.</p><p><button type="button"'
        ' id="difference" disabled>Go to the first difference</button></p><div class="report"'
        f' role="status"></div>{_task(exercise, alone=True)}</section>'
    )


def report_data(report: Report | str, printed: str = "") -> dict[str, Any]:
    """Return what the checks found of a student's file, in the words of the terminal; text where
    they found nothing.

    Args:
        report: The checks' report, or one line.
        printed: What the function printed in the run that is shown.
    """
    ran = {"ran": "\n".join(shown(printed))}
    if isinstance(report, str):
        return {"said": report, **ran}
    return {
        **ran,
        "said": counted(report),
        "mistake": "" if report.mistake is None else report.mistake.sentence,
        "checks": [
            {
                "mark": MARKS[outcome.verdict.word],
                "word": outcome.verdict.word,
                "promise": outcome.check.promise,
                "points": f"{outcome.points:g}/{outcome.check.points:g}",
                "message": outcome.verdict.message,
            }
            for outcome in report.outcomes
        ],
        "printed": "\n".join(shown(report.printed)),
    }


def _task(exercise: Exercise, *, alone: bool = False) -> str:
    promises = "".join(
        f"<li>{escape(check.promise)} ({check.points:g})</li>"
        for check in exercise.checks
        if check.public
    )
    hidden = sum(not check.public for check in exercise.checks)
    more = f"<li>{hidden} more that are run where a class is graded</li>" if hidden else ""
    begin = "" if alone else f"<pre>{escape(chr(10).join(commands(exercise)))}</pre>"
    title = "The task" if alone else escape(exercise.name)
    return (
        f'<div class="task"><h3>{title}</h3><p>{escape(exercise.task)}</p>{begin}'
        f"<details><summary>The contract</summary><pre>{escape(starter(exercise))}</pre></details>"
        f"<details><summary>What is checked</summary><ul>{promises}{more}</ul></details></div>"
    )
