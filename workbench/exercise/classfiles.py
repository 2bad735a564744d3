"""A class in files for teachers: a row per student, a matrix of students and checks, a summary."""

import csv
import io
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from workbench.errors import one_line
from workbench.exercise.reports import UNSAFE
from workbench.numerals import counted

Result = dict[str, Any]
HOW = {
    "timeout": "hangs",
    "died": "crashes",
    "raised": "raises",
    "result": "returns no result",
    "forbidden": "is refused",
}


def is_full(result: Result, worth: Mapping[str, float] | None = None) -> bool:
    """Whether all that was handed in, and all of an assignment, has full marks."""
    full = all(report["points"] == report["possible"] for report in result["reports"])
    whole = set(worth or ()) <= {report["exercise"] for report in result["reports"]}
    return bool(result["reports"]) and not result["ungraded"] and full and whole


def class_csv(results: Sequence[Result], worth: Mapping[str, float] | None = None) -> str:
    """Return one row per student: points in all and per exercise, and what else went wrong.

    What could not be graded counts out of its full points; what was not handed in is empty. `worth`
    has the points of an assignment's exercises, in its order: other exercises count nothing. None
    counts the points of the checks, out of what was handed in.
    """
    names = list(
        worth
        or dict.fromkeys(
            i["exercise"] for result in results for i in _items(result) if i["exercise"]
        )
    )
    counted = ["handed in"] if worth is None and any(result["handed"] for result in results) else []
    rows = [["student", "points", "possible", *names, *counted, "trouble"]]
    for result in results:
        points: dict[str, float] = {}
        for item in _items(result):
            if item["exercise"] in names:
                factor = 1.0 if worth is None else worth[item["exercise"]] / item["possible"]
                points[item["exercise"]] = (
                    points.get(item["exercise"], 0.0) + factor * item["points"]
                )
        possible = (
            sum(item["possible"] for item in _items(result))
            if worth is None
            else sum(worth.values())
        )
        cells = [f"{points[name]:g}" if name in points else "" for name in names]
        other = dict.fromkeys(
            item["exercise"] for item in _items(result) if item["exercise"] not in (None, *names)
        )
        trouble = "; ".join(
            filter(None, [_trouble(result), *(f"{name} is not asked for" for name in other)])
        )
        rows.append(
            [
                result["student"],
                f"{sum(points.values()):g}",
                f"{possible:g}",
                *cells,
                *(", ".join(result["handed"]) for _ in counted),
                trouble,
            ]
        )
    return _csv(rows)


def matrix_csv(results: Sequence[Result]) -> str:
    """Return students by checks: shares or failures; below, sums and the most frequent mistake."""
    checks = list(
        dict.fromkeys(
            (r["exercise"], c["name"])
            for result in results
            for r in result["reports"]
            for c in r["checks"]
        )
    )
    rows = [["student", *(f"{exercise}.{name}" for exercise, name in checks)]]
    mistakes: dict[tuple[str, str], Counter] = {check: Counter() for check in checks}
    shares: dict[tuple[str, str], list[float]] = {check: [] for check in checks}
    for result in results:
        cells = {}
        for report in result["reports"]:
            for outcome in report["checks"]:
                key = (report["exercise"], outcome["name"])
                shares[key].append(
                    outcome["points"] / outcome["possible"] if outcome["possible"] else 0.0
                )
                cells[key] = HOW.get(outcome["kind"], f"{shares[key][-1]:g}")
                if report["mistake"] and outcome["name"] in report["mistake"]["checks"]:
                    mistakes[key][report["mistake"]["name"]] += 1
        rows.append([result["student"], *(cells.get(key, "") for key in checks)])
    rows.append(["graded", *(str(len(shares[key])) for key in checks)])
    rows.append(["full marks", *(str(sum(share == 1 for share in shares[key])) for key in checks)])
    rows.append(["mean share", *(f"{sum(shares[key]) / len(shares[key]):.3g}" for key in checks)])
    frequent = [
        next((f"{name} ({n})" for name, n in mistakes[key].most_common(1)), "") for key in checks
    ]
    return _csv([*rows, ["most frequent mistake", *frequent]])


def summary(results: Sequence[Result], worth: Mapping[str, float] | None = None) -> str:
    """Return the class, or an assignment's exercises, in a few lines of Markdown."""
    graded = [result for result in results if result["reports"]]
    perfect = sum(is_full(result, worth) for result in results)
    lines = [f"# {counted(len(results), 'submission')}", ""]
    perfectly = f"{perfect} with full marks{_of_what(results, worth)}"
    lines.append(
        f"{len(graded)} graded, {perfectly}, {len(results) - len(graded)} could not be graded."
    )
    seeds = dict.fromkeys(result["seed"] for result in results if result["seed"] is not None)
    if seeds:
        lines += ["", f"Hidden checks are drawn from seed {', '.join(map(str, seeds))}."]
    if any(result["sandbox"] == "none" for result in results):
        lines += ["", f"**{UNSAFE}**"]
    parts = (
        Counter(part for result in results for part in result["handed"])
        if worth is None
        else Counter()
    )
    if parts:
        lines += ["", "Of these lessons not all exercises were handed in:", ""]
        lines += [f"- {part}: {_students(count)}" for part, count in sorted(parts.items())]
    mistakes = Counter(
        r["mistake"]["sentence"] for result in graded for r in result["reports"] if r["mistake"]
    )
    if mistakes:
        told = (f"- {count} × {_plain(sentence)}" for sentence, count in mistakes.most_common(8))
        lines += ["", "Most frequent mistakes:", "", *told]
    troubled = [
        f"- {_plain(result['student'])}: {_plain(trouble)}"
        for result in results
        if (trouble := _trouble(result))
    ]
    if troubled:
        lines += ["", "To look at:", "", *troubled]
    return "\n".join(lines) + "\n"


def _items(result: Result) -> Iterator[dict[str, Any]]:
    yield from result["reports"]
    yield from result["ungraded"]


def _trouble(result: Result) -> str:
    troubles = [item["error"] for item in result["ungraded"]]
    for report in result["reports"]:
        kinds = Counter(
            HOW[check["kind"]] for check in report["checks"] if check["kind"] in ("timeout", "died")
        )
        troubles += list(
            dict.fromkeys(
                check["message"] for check in report["checks"] if check["kind"] == "forbidden"
            )
        )
        troubles += [
            f"{report['exercise']} {how} in {_checks(count)}" for how, count in kinds.items()
        ]
    return "; ".join([*troubles, *([result["note"]] if result["note"] else [])])


def _of_what(results: Sequence[Result], worth: Mapping[str, float] | None) -> str:
    return (
        " in what they handed in"
        if worth is None and any(result["handed"] for result in results)
        else ""
    )


def _students(count: int) -> str:
    return "1 student" if count == 1 else f"{count} students"


def _checks(count: int) -> str:
    return "1 check" if count == 1 else f"{count} checks"


def _csv(rows: Sequence[Sequence[str]]) -> str:
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(
        [[_inert(one_line(cell)) for cell in row] for row in rows]
    )
    return out.getvalue()


def _inert(cell: str) -> str:
    """Keep a spreadsheet from running what a student named a file."""
    return "'" + cell if cell.startswith(("=", "+", "-", "@")) else cell


def _plain(text: str) -> str:
    """Return text that is no Markdown and no HTML."""
    return "".join(f"\\{sign}" if sign in "\\`*[]|<>#" else sign for sign in one_line(text))
