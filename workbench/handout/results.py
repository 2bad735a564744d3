"""What grading found, as PrairieLearn's external grading reads it."""

from collections.abc import Sequence
from typing import Any

from workbench.exercise.grading import Outcome, Report
from workbench.exercise.reports import UNSAFE, shown

MOST_BYTES = 1_000_000
"""PrairieLearn takes 1 MB."""


def prairielearn(
    reports: Sequence[Report],
    failed: Sequence[dict[str, Any]],
    images: Sequence[dict[str, str]] = (),
    *,
    notes: Sequence[str] = (),
) -> dict[str, Any]:
    """Return the `results.json` of a question: its score is a share; what cannot be graded costs no
    attempt.

    Everything in it is shown at once, so hidden checks are one line with their points and no
    feedback.

    Args:
        reports: What was graded, of one exercise.
        failed: What could not be, as `ungraded` says it.
        images: Pictures, each a label and a data URL.
        notes: What else is to be said.

    Source: PrairieLearn documentation, "External grading", "Grading results".
    """
    if failed or not reports:
        errors = [*(item["error"] for item in failed), *notes]
        return {"gradable": False, "message": "This could not be graded.", "format_errors": errors}
    possible = sum(report.possible for report in reports)
    results: dict[str, Any] = {
        "gradable": True,
        "score": sum(report.points for report in reports) / possible,
        "tests": [test for report in reports for test in _tests(report)],
    }
    sentences = [report.said_once for report in reports if report.said_once]
    sentences += [
        report.mistake.sentence for report in reports if report.mistake and _is_seen(report)
    ]
    sentences += notes
    sentences += (
        [UNSAFE]
        if any(report.wall is not None and not report.wall.holds for report in reports)
        else []
    )
    if sentences:
        results["message"] = "\n".join(sentences)
    printed = [line for report in reports for line in shown(report.printed)]
    if printed:
        results["output"] = "\n".join(["Your code printed:", *printed])
    if images and sum(len(image["url"]) for image in images) < MOST_BYTES // 2:
        results["images"] = list(images)
    return results


def _tests(report: Report) -> list[dict[str, Any]]:
    tests = [
        {
            "name": outcome.check.promise,
            "points": outcome.points,
            "max_points": outcome.check.points,
            "message": "" if report.said_once else outcome.verdict.message,
        }
        for outcome in report.outcomes
        if outcome.check.public
    ]
    hidden = [outcome for outcome in report.outcomes if not outcome.check.public]
    if hidden:
        tests.append(
            {
                "name": "Hidden checks",
                "points": sum(outcome.points for outcome in hidden),
                "max_points": sum(outcome.check.points for outcome in hidden),
                "message": f"{sum(map(_passes, hidden))} of {len(hidden)} pass",
            }
        )
    return tests


def _passes(outcome: Outcome) -> bool:
    return outcome.verdict.share == 1.0


def _is_seen(report: Report) -> bool:
    """Whether a mistake concerns a public check: of hidden ones nothing is told."""
    return any(
        outcome.check.public and outcome.check.name in report.concerned
        for outcome in report.outcomes
    )
