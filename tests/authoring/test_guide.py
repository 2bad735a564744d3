"""The authors' guide: its code is run or is the template's, and what it says of limits and names is
what is asked.
"""

import inspect
import re
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from workbench import scene
from workbench.authoring import exercise_promises, page_promises, promises
from workbench.authoring.new import TEMPLATE
from workbench.authoring.promises import Subject
from workbench.authoring.validate import look_at
from workbench.cli import COMMANDS
from workbench.lesson import Lesson, Question, View
from workbench.run.flags import RESERVED
from workbench.run.loading import load
from workbench.run.timeline import MOST_BYTES, MOST_STEPS
from workbench.words.typeset import LARGEST_PICTURE, PICTURES

ROOT = Path(__file__).resolve().parents[2]
GUIDE = (ROOT / "docs" / "lessons.md").read_text(encoding="utf-8")
PLAIN = " ".join(GUIDE.split())
BLOCKS = re.findall(r'```python(?: title="(.*?)")?\n(.*?)```', GUIDE, re.DOTALL)
EXCERPTS = [(file, text) for file, text in BLOCKS if file not in ("", "turn.py")]


def test_the_smallest_lesson_runs_and_lacks_only_what_a_whole_one_has(tmp_path):
    (tmp_path / "turn.py").write_text(
        next(text for file, text in BLOCKS if file == "turn.py"), encoding="utf-8"
    )
    told = [line for line in look_at(Subject(load(tmp_path / "turn.py"))) if line is not None]
    assert [re.findall("preset|question|page", line)[0] for line in told] == [
        "preset",
        "question",
        "page",
    ]


@pytest.mark.parametrize(("file", "text"), EXCERPTS)
def test_what_is_shown_of_the_new_lesson_is_in_its_files(file, text):
    assert text in (TEMPLATE / file).read_text(encoding="utf-8")


def test_its_files_are_listed():
    listed = re.findall(r"^\| `([\w./]+)`", GUIDE, re.MULTILINE)
    paths = [
        path.relative_to(TEMPLATE)
        for path in TEMPLATE.rglob("*.*")
        if "__pycache__" not in path.parts
    ]
    assert {
        path.as_posix() if len(path.parts) == 1 else "exercises/NAME.py" for path in paths
    } <= set(listed)


def test_other_code_runs():
    plain = [text for file, text in BLOCKS if not file]
    assert len(plain) == 1
    known: dict = {}
    exec(compile(plain[0], "lessons.md", "exec"), known)
    assert known["points_of"](None, np.random.default_rng(0)).shape == (500, 3)
    assert known["points_of"](ROOT / "assets" / "data" / "rabbit_source.ply", None).shape[1] == 3


def test_every_primitive_is_listed_with_arguments_that_it_has():
    listed = dict(re.findall(r"^\| `(\w+)\((.*?)\)` \|", GUIDE, re.MULTILINE))
    for kind in scene.PRIMITIVES:
        arguments = [name.strip(" =") for name in listed[kind.__name__].split(",")]
        assert set(arguments) <= {field.name for field in fields(kind)}, kind.__name__
    for role in scene.PALETTE:
        assert f'"{role}"' in GUIDE or role in "xyz"


def test_every_helper_stands_where_the_guide_says_with_the_arguments_it_names():
    rows = re.findall(r"^\| [^|]+ \| `(workbench[.\w]+)` \| (.*) \|$", GUIDE, re.MULTILINE)
    calls = [
        (module, *call)
        for module, cell in rows
        for call in re.findall(r"`([A-Za-z][\w.]*)\(([^`]*)\)`", cell)
    ]
    assert len(calls) > 50
    for module, name, arguments in calls:
        function: Any = import_module(module)
        for part in name.split("."):
            function = getattr(function, part)
        known = inspect.signature(function).parameters
        named = [argument.strip() for argument in arguments.split(",")]
        assert {argument.rstrip("=") for argument in named} <= set(known), f"{module}.{name}"
        needed = [
            key
            for key, parameter in known.items()
            if parameter.default is parameter.empty and parameter.kind is not parameter.VAR_KEYWORD
        ]
        assert [argument.rstrip("=") for argument in named][: len(needed)] == needed, (
            f"{module}.{name}"
        )


def test_limits_and_names_are_those_that_are_asked():
    for part in page_promises.PARTS:
        assert f"*{part}*" in PLAIN
    for word in RESERVED:
        assert f"`{word}`" in PLAIN
    least, most = promises.CAPTION
    assert f"{least} to {most} characters that says" in PLAIN
    assert f"a line of {promises.LINE[0]} to {promises.LINE[1]} characters" in PLAIN
    assert f"{page_promises.WORDS[0]} to {page_promises.WORDS[1]:,} words" in PLAIN
    assert f"({exercise_promises.TASK[0]} to {exercise_promises.TASK[1]} characters)" in PLAIN
    assert (
        f"({exercise_promises.SENTENCE[0]} to {exercise_promises.SENTENCE[1]} characters)" in PLAIN
    )
    assert f"cut after {MOST_STEPS:,} steps or {MOST_BYTES >> 20} MB" in PLAIN
    assert f"up to {LARGEST_PICTURE // 1000} kB" in PLAIN
    assert all(kind[1:] in PLAIN for kind in PICTURES if kind != ".jpeg")
    counts = (
        promises.LEAST_PRESETS,
        exercise_promises.LEAST_CHECKS,
        exercise_promises.LEAST_MISTAKES,
    )
    assert counts == (3, 4, 3)
    assert promises.SECONDS == 60


def test_commands_and_fields_that_are_named_are_there():
    for command in re.findall(r"`workbench (\w+)", PLAIN):
        assert command in COMMANDS, command
    for kind, names in (
        (View, "up grid grid_height fov_degrees axes eye"),
        (Lesson, "order first_step"),
        (Question, "choices unit tolerance why step"),
    ):
        assert set(names.split()) <= {field.name for field in fields(kind)}
