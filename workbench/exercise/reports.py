"""What grading found, as text and files: terminal, JSON, Gradescope, JUnit, Markdown."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from workbench.errors import InputError, one_line
from workbench.exercise.grading import Outcome, Report
from workbench.exercise.model import Exercise
from workbench.machinery.atomic import write_atomic
from workbench.machinery.version import __version__

SCHEMA_VERSION = 2
SCHEMA = Path(__file__).with_name("result.schema.json")
UNSAFE = (
    "Marks are not safe: nothing but limits stood between this code and the machine that graded it"
    " (--sandbox none)."
)
PRINTED_LINES, PRINTED_SIGNS = 5, 160
MARKS = {"pass": "✓", "partial": "◐", "fail": "✗"}


def terminal(report: Report) -> str:
    """Return a report for a person: per check its mark, points, promise and what was found."""
    lines = [f"{report.exercise.name} · {one_line(report.file)}"]
    for outcome in report.outcomes:
        points = f"{outcome.points:g}/{outcome.check.points:g}"
        lines.append(
            f"  {MARKS[outcome.verdict.word]} {outcome.verdict.word:<7} {points:>5} "
            f" {outcome.check.promise}"
        )
        lines += [] if report.said_once else [f"{'':18}{outcome.verdict.message}"]
    lines += [f"  {report.said_once}"] if report.said_once else []
    if report.mistake is not None:
        lines.append(f"  → {report.mistake.sentence}")
    printed = shown(report.printed)
    if printed:
        lines += ["  Your code printed:", *(f"    {line}" for line in printed)]
    if _is_unsafe(report):
        lines.append(f"  {UNSAFE}")
    lines.append("  " + counted(report))
    return "\n".join(lines)


def counted(report: Report) -> str:
    """Return the last line of a report: what passed, and what was not run here."""
    parts = []
    for word, public in (("public", True), ("hidden", False)):
        run = [outcome for outcome in report.outcomes if outcome.check.public is public]
        skipped = [check for check in report.not_run if check.public is public]
        if run:
            parts.append(f"{word} {sum(o.verdict.share == 1.0 for o in run)}/{len(run)}")
        if skipped:
            parts.append(f"{word} {len(skipped)} not run here")
    drawn = [] if report.seed is None else [f"seed {report.seed}"]
    return " · ".join([*parts, f"{report.points:g} of {report.possible:g} points", *drawn])


def shown(printed: str) -> list[str]:
    """Return the first lines of what was printed, signs for a terminal written out."""
    lines = [one_line(line)[:PRINTED_SIGNS] for line in printed.split("\n") if line.strip()]
    return [*lines[:PRINTED_LINES], *(["..."] if len(lines) > PRINTED_LINES else [])]


def _is_unsafe(report: Report) -> bool:
    return report.wall is not None and not report.wall.holds


def ungraded(file: str, exercise: Exercise | None, error: str) -> dict[str, Any]:
    """Return what could not be graded as plain data: no points out of all there were."""
    return {
        "file": one_line(file),
        "exercise": None if exercise is None else exercise.name,
        "points": 0,
        "possible": 0 if exercise is None else exercise.points,
        "error": one_line(error),
    }


def as_dict(report: Report) -> dict[str, Any]:
    """Return a report as plain data, after `result.schema.json`."""
    return {
        "schema": SCHEMA_VERSION,
        "workbench": __version__,
        "exercise": report.exercise.name,
        "lesson": report.exercise.lesson,
        "file": report.file,
        "points": report.points,
        "possible": report.possible,
        "checks": [_check(outcome) for outcome in report.outcomes],
        "not_run": [check.name for check in report.not_run],
        "mistake": (
            None
            if report.mistake is None
            else {
                "name": report.mistake.name,
                "sentence": report.mistake.sentence,
                "checks": [
                    outcome.check.name
                    for outcome in report.outcomes
                    if outcome.check.name in report.concerned
                ],
            }
        ),
        "printed": shown(report.printed),
        "sandbox": None if report.wall is None else report.wall.name,
        "seed": report.seed,
    }


def _check(outcome: Outcome) -> dict[str, Any]:
    return {
        "name": outcome.check.name,
        "promise": outcome.check.promise,
        "public": outcome.check.public,
        "result": outcome.verdict.word,
        "kind": outcome.kind,
        "points": outcome.points,
        "possible": outcome.check.points,
        "message": outcome.verdict.message,
    }


def gradescope(
    reports: Sequence[Report],
    failed: Sequence[dict[str, Any]] = (),
    *,
    factors: Mapping[str, float] | None = None,
    hidden: str = "after_published",
    notes: Sequence[str] = (),
) -> dict[str, Any]:
    """Return the `results.json` that Gradescope reads.

    Args:
        failed: What could not be graded, as `ungraded` says it.
        factors: What a point of an exercise is worth, by name; 1 where nothing is said.
        hidden: When hidden checks are shown: `after_published` or `after_due_date`.
        notes: What else is to be said.

    Source: Gradescope autograder specification, "Output format".
    """
    worth = dict(factors or {})
    tests = [
        _said_once(report, worth.get(report.exercise.name, 1.0))
        for report in reports
        if report.said_once
    ]
    tests += [
        {
            "name": f"{report.exercise.name}: {outcome.check.promise}",
            "score": outcome.points * worth.get(report.exercise.name, 1.0),
            "max_score": outcome.check.points * worth.get(report.exercise.name, 1.0),
            "status": "passed" if outcome.verdict.share == 1.0 else "failed",
            "output": "\n".join([outcome.verdict.message, *_named(report, outcome)]),
            "visibility": "visible" if outcome.check.public else hidden,
        }
        for report in reports
        if not report.said_once
        for outcome in report.outcomes
    ]
    tests += [
        {
            "name": item["exercise"] or item["file"] or "The file",
            "score": 0,
            "max_score": item["possible"] * worth.get(item["exercise"], 1.0),
            "status": "failed",
            "output": "",  # a sentence is read once: it stands above all tests
            "visibility": "visible",
        }
        for item in failed
    ]
    lines = [*dict.fromkeys(item["error"] for item in failed), *notes]
    lines += [
        f"{report.exercise.name} printed:\n" + "\n".join(shown(report.printed))
        for report in reports
        if report.printed
    ]
    lines += [UNSAFE] if any(map(_is_unsafe, reports)) else []
    return {
        "score": sum(test["score"] for test in tests),
        "output": "\n".join(lines),
        "tests": tests,
    }


def _said_once(report: Report, factor: float) -> dict[str, Any]:
    """Return one test for all checks of a report that say the same: a sentence is read once."""
    return {
        "name": report.exercise.name,
        "score": report.points * factor,
        "max_score": report.possible * factor,
        "status": "passed" if report.is_full else "failed",
        "output": "\n".join(
            [report.said_once, *([report.mistake.sentence] if report.mistake else [])]
        ),
        "visibility": "visible",
    }


def _named(report: Report, outcome: Outcome) -> list[str]:
    return (
        [report.mistake.sentence]
        if report.mistake and outcome.check.name in report.concerned
        else []
    )


def junit(reports: Sequence[Report], failed: Sequence[dict[str, Any]] = ()) -> str:
    """Return JUnit XML: a suite per function, a case per check; an error where none was run."""
    root = ElementTree.Element("testsuites")
    for report in reports:
        failures = sum(outcome.verdict.share < 1.0 for outcome in report.outcomes)
        suite = _suite(
            root, report.exercise.name, tests=len(report.outcomes), failures=failures, errors=0
        )
        for outcome in report.outcomes:
            case = ElementTree.SubElement(
                suite,
                "testcase",
                classname=printable(report.file) or report.exercise.name,
                name=outcome.check.name,
            )
            if outcome.verdict.share < 1.0:
                ElementTree.SubElement(
                    case,
                    "failure",
                    message=printable(outcome.verdict.message),
                    type=outcome.kind or outcome.verdict.word,
                )
        if _is_unsafe(report):
            ElementTree.SubElement(suite, "system-err").text = UNSAFE
    for item in failed:
        name = printable(item["exercise"] or item["file"] or "file")
        case = ElementTree.SubElement(
            _suite(root, name, tests=1, failures=0, errors=1),
            "testcase",
            classname=name,
            name="can be graded",
        )
        ElementTree.SubElement(case, "error", message=printable(item["error"]), type="ungraded")
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True)


def _suite(root: ElementTree.Element, name: str, **counts: int) -> ElementTree.Element:
    return ElementTree.SubElement(
        root, "testsuite", {"name": name, **{kind: str(count) for kind, count in counts.items()}}
    )


def markdown(reports: Sequence[Report], failed: Sequence[dict[str, Any]] = ()) -> str:
    """Return a summary for a job's page on GitHub."""
    lines = [f"**{UNSAFE}**", ""] if any(map(_is_unsafe, reports)) else []
    for item in failed:
        lines += [
            f"### {_cell(item['exercise'] or item['file'])}: could not be graded",
            "",
            f"> {_cell(item['error'])}",
            "",
        ]
    for report in reports:
        lines += [f"### {report.exercise.name}: {report.points:g} of {report.possible:g}", ""]
        lines += ["| | check | points | found |", "|---|---|---|---|"]
        for outcome in report.outcomes:
            message = "" if report.said_once else outcome.verdict.message
            cells = (outcome.check.promise, f"{outcome.points:g}/{outcome.check.points:g}", message)
            lines.append(
                "| "
                + " | ".join([MARKS[outcome.verdict.word], *(_cell(cell) for cell in cells)])
                + " |"
            )
        lines += ["", _cell(report.said_once)] if report.said_once else []
        if report.mistake is not None:
            lines += ["", f"> {_cell(report.mistake.sentence)}"]
        lines += ["", counted(report), ""]
    return "\n".join(lines)


def write_files(
    reports: Sequence[Report], folder: Path, failed: Sequence[dict[str, Any]] = ()
) -> None:
    """Write result.json, Gradescope's results.json, junit.xml and summary.md into a folder.

    Raises:
        InputError: If one of them cannot be written; names it.
    """
    result = {
        "schema": SCHEMA_VERSION,
        "reports": [as_dict(report) for report in reports],
        "ungraded": list(failed),
    }
    files = {
        "result.json": json.dumps(result, indent=1, ensure_ascii=False),
        "results.json": json.dumps(gradescope(reports, failed), indent=1, ensure_ascii=False),
        "junit.xml": junit(reports, failed),
        "summary.md": markdown(reports, failed),
    }
    for name, text in files.items():
        try:
            folder.mkdir(parents=True, exist_ok=True)
            write_atomic(folder / name, text.encode("utf-8", "backslashreplace"))
        except OSError as error:
            raise InputError(f"{folder / name}: {error.strerror or 'cannot be written'}") from None


def printable(text: str) -> str:
    """Return text without the control characters that XML cannot hold."""
    return "".join(
        c for c in text if c in "\t\n" or (ord(c) >= 32 and not 0xD800 <= ord(c) <= 0xDFFF)
    )


def _cell(text: str) -> str:
    return one_line(text).replace("|", "\\|").replace("<", "&lt;").replace("`", "\\`")
