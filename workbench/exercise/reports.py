"""What grading found, as text and as files: terminal, our JSON, Gradescope, JUnit, a Markdown summary."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import workbench
from workbench.atomic import write_atomic
from workbench.exercise.grading import Outcome, Report

SCHEMA_VERSION = 1
SCHEMA = Path(__file__).with_name("result.schema.json")
MARKS = {"pass": "✓", "partial": "◐", "fail": "✗"}


def terminal(report: Report) -> str:
    """Return a report for a person: per check its mark, points, promise and what was found, then what was run."""
    lines = [f"{report.exercise.name} · {report.file}"]
    for outcome in report.outcomes:
        points = f"{outcome.points:g}/{outcome.check.points:g}"
        lines.append(f"  {MARKS[outcome.verdict.word]} {outcome.verdict.word:<7} {points:>5}  {outcome.check.promise}")
        lines.append(f"{'':18}{outcome.verdict.message}")
    if report.mistake is not None:
        lines.append(f"  → {report.mistake.sentence}")
    if report.printed.strip():
        lines.append("  Your code printed: " + report.printed.strip().splitlines()[-1][:200])
    lines.append("  " + counted(report))
    return "\n".join(lines)


def counted(report: Report) -> str:
    """Return the last line of a report: what passed, and what was not run here. Never a sentence that reads as done."""
    parts = []
    for word, public in (("public", True), ("hidden", False)):
        run = [outcome for outcome in report.outcomes if outcome.check.public is public]
        skipped = [check for check in report.not_run if check.public is public]
        if run:
            parts.append(f"{word} {sum(o.verdict.share == 1.0 for o in run)}/{len(run)}")
        if skipped:
            parts.append(f"{word} {len(skipped)} not run here")
    return " · ".join([*parts, f"{report.points:g} of {report.possible:g} points"])


def as_dict(report: Report) -> dict[str, Any]:
    """Return a report as plain data, after `result.schema.json`."""
    return {
        "schema": SCHEMA_VERSION,
        "workbench": workbench.__version__,
        "exercise": report.exercise.name,
        "lesson": report.exercise.lesson,
        "file": report.file,
        "points": report.points,
        "possible": report.possible,
        "checks": [_check(outcome) for outcome in report.outcomes],
        "not_run": [check.name for check in report.not_run],
        "mistake": None
        if report.mistake is None
        else {"name": report.mistake.name, "sentence": report.mistake.sentence},
    }


def _check(outcome: Outcome) -> dict[str, Any]:
    return {
        "name": outcome.check.name,
        "promise": outcome.check.promise,
        "public": outcome.check.public,
        "result": outcome.verdict.word,
        "points": outcome.points,
        "possible": outcome.check.points,
        "message": outcome.verdict.message,
    }


def gradescope(reports: Sequence[Report]) -> dict[str, Any]:
    """Return the `results.json` that Gradescope reads.

    Source: Gradescope autograder specification, "Output format".
    """
    tests = [
        {
            "name": f"{report.exercise.name}: {outcome.check.promise}",
            "score": outcome.points,
            "max_score": outcome.check.points,
            "status": "passed" if outcome.verdict.share == 1.0 else "failed",
            "output": "\n".join([outcome.verdict.message, *([report.mistake.sentence] if report.mistake else [])]),
            "visibility": "visible" if outcome.check.public else "after_published",
        }
        for report in reports
        for outcome in report.outcomes
    ]
    return {"score": sum(report.points for report in reports), "tests": tests}


def junit(reports: Sequence[Report]) -> str:
    """Return JUnit XML: a suite per function, a case per check."""
    root = ElementTree.Element("testsuites")
    for report in reports:
        failures = sum(outcome.verdict.share < 1.0 for outcome in report.outcomes)
        suite = ElementTree.SubElement(
            root, "testsuite", name=report.exercise.name, tests=str(len(report.outcomes)), failures=str(failures)
        )
        for outcome in report.outcomes:
            case = ElementTree.SubElement(suite, "testcase", classname=report.file, name=outcome.check.name)
            if outcome.verdict.share < 1.0:
                ElementTree.SubElement(case, "failure", message=printable(outcome.verdict.message))
    return ElementTree.tostring(root, encoding="unicode", xml_declaration=True)


def markdown(reports: Sequence[Report]) -> str:
    """Return a summary for a job's page on GitHub."""
    lines = []
    for report in reports:
        lines += [f"### {report.exercise.name}: {report.points:g} of {report.possible:g}", ""]
        lines += ["| | check | points | found |", "|---|---|---|---|"]
        for outcome in report.outcomes:
            cells = (outcome.check.promise, f"{outcome.points:g}/{outcome.check.points:g}", outcome.verdict.message)
            lines.append("| " + " | ".join([MARKS[outcome.verdict.word], *(_cell(cell) for cell in cells)]) + " |")
        if report.mistake is not None:
            lines += ["", f"> {_cell(report.mistake.sentence)}"]
        lines += ["", counted(report), ""]
    return "\n".join(lines)


def write_files(reports: Sequence[Report], folder: Path) -> None:
    """Write result.json, Gradescope's results.json, junit.xml and summary.md into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    result = {"schema": SCHEMA_VERSION, "reports": [as_dict(report) for report in reports]}
    files = {
        "result.json": json.dumps(result, indent=1, ensure_ascii=False),
        "results.json": json.dumps(gradescope(reports), indent=1, ensure_ascii=False),
        "junit.xml": junit(reports),
        "summary.md": markdown(reports),
    }
    for name, text in files.items():
        write_atomic(folder / name, text.encode())


def printable(text: str) -> str:
    """Return text without the control characters that XML cannot hold."""
    return "".join(c for c in text if c in "\t\n" or (ord(c) >= 32 and not 0xD800 <= ord(c) <= 0xDFFF))


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")
