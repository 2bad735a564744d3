"""What third parties install joins the course; what clashes or breaks is left out in one line, and
the course is whole.
"""

import importlib.metadata
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from tests import fake
from workbench.cli import main
from workbench.errors import LeftOutWarning
from workbench.exercise import finding
from workbench.exercise.finding import exercises, exercises_of
from workbench.lesson import catalog, course
from workbench.run import listing

ROOT = Path(__file__).resolve().parents[1]
OURS = {name: lesson.order for name, lesson in course().items()}
OUR_EXERCISES = [exercise.name for lesson in course().values() for exercise in exercises_of(lesson)]


# what entry points below name
icp = replace(fake.lesson, name="icp", summary="Not the course's.", order=1)
twin = fake.lesson

LESSON = """
from dataclasses import dataclass, replace
from tests import fake

@dataclass(frozen=True)
class Params(fake.Params):
    pass

lesson = replace(fake.lesson, name={name!r}, params=Params, presets=(), questions=())
"""
CENTROID = (
    (ROOT / "tests" / "exercise" / "centroid.py")
    .read_text(encoding="utf-8")
    .partition("EXERCISE =")[0]
)
FILES = {
    "taken": ("align_rigid", CENTROID.replace("def centroid", "def align_rigid")),
    "good": ("centroid", CENTROID),
    "same": ("centroid", CENTROID),
    "strange": (
        "odd",
        CENTROID.replace("def centroid", "def odd").replace('slot="turn"', 'slot="wheel"'),
    ),
    "nameless": ("even", CENTROID),
    "failing": ("lazy", 'raise SystemExit("no exercises today")'),
}
"""By lesson its one exercise: the file's name and what it holds."""


@pytest.fixture
def packages(tmp_path, monkeypatch):
    """Writes packages of third parties: each a lesson, and an exercise."""
    for name, (exercise, text) in FILES.items():
        folder = tmp_path / f"their_{name}"
        (folder / "exercises").mkdir(parents=True)
        (folder / "lesson.py").write_text(LESSON.format(name=name))
        (folder / "exercises" / f"{exercise}.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    yield
    for name in [name for name in sys.modules if name.startswith("their_")]:
        del sys.modules[name]


@pytest.fixture
def install(monkeypatch):
    """Registers lessons of this module under the entry points of third parties; the catalogue is
    read anew.
    """

    def register(*values: str) -> None:
        entries = [
            importlib.metadata.EntryPoint(f"by-{i}", value, "workbench.lessons")
            for i, value in enumerate(values)
        ]
        for module in (importlib.metadata, listing):
            monkeypatch.setattr(module, "entry_points", lambda group: entries)

    catalog.cache_clear()
    finding.usable.cache_clear()
    yield register
    catalog.cache_clear()
    finding.usable.cache_clear()


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (
            ["tests.test_third_parties:icp"],
            r"lesson by-0 \(tests.test_third_parties:icp\) .*'icp' is taken by lessons.icp",
        ),
        (
            ["tests.fake:lesson", "tests.test_third_parties:twin"],
            (
                r"lesson by-1 \(tests.test_third_parties:twin\) .*'fake' is taken by by-0"
                r" \(tests.fake:lesson\)"
            ),
        ),
        (["tests.test_third_parties:nothing"], "lesson by-0 .*of type Lesson"),
    ],
)
def test_a_lesson_with_a_taken_name_is_left_out_and_both_places_are_named(
    capsys, install, values, *, message
):
    install(*values)
    with pytest.warns(LeftOutWarning, match=message):
        assert main(["list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    theirs = len(values) - 1
    assert len(lines) == len(OURS) + theirs
    assert {name: lesson.order for name, lesson in catalog().items() if name in OURS} == OURS
    assert not any("Not the course's" in line for line in lines)


@pytest.mark.parametrize(
    ("names", "message", "more"),
    [
        (
            ["taken"],
            (
                r"exercise align_rigid of lesson taken \(their_taken.lesson\) .* taken by lesson"
                r" icp \(lessons.icp"
            ),
            [],
        ),
        (
            ["good", "same"],
            r"exercise centroid of lesson same .* taken by lesson good \(their_good",
            ["centroid"],
        ),
        (
            ["strange"],
            (
                "exercises of lesson strange .*: InputError: exercise odd: run .* has no keyword"
                " 'wheel'"
            ),
            [],
        ),
        (
            ["nameless"],
            "exercises of lesson nameless .*even.py: it needs one function `even` with @contract",
            [],
        ),
        (["failing"], "exercises of lesson failing .*: SystemExit: no exercises today", []),
    ],
)
def test_an_exercise_that_cannot_stand_is_left_out_and_its_place_is_named(
    capsys, packages, install, *, names, message, more
):
    install(*(f"their_{name}.lesson:lesson" for name in names))
    with pytest.warns(LeftOutWarning, match=message):
        assert main(["exercise"]) == 0
    listed = [line.split()[:2] for line in capsys.readouterr().out.splitlines()]
    assert sorted(name for _, name in listed) == sorted([*OUR_EXERCISES, *more])
    assert ["icp", "align_rigid"] in listed


def test_a_third_party_s_exercises_join_in_course_order(packages, install):
    install("their_good.lesson:lesson")
    assert [exercise.name for exercise in exercises_of(catalog()["good"])] == ["centroid"]
    order = list(catalog())
    places = [order.index(exercise.lesson) for exercise in exercises().values()]
    assert places == sorted(places)


def test_what_is_left_out_is_one_line_where_a_person_reads_it(tmp_path):
    (tmp_path / "theirs.py").write_text(
        "from dataclasses import replace\nfrom tests.fake import lesson as other\nlesson ="
        " replace(other, name='icp')\n"
    )
    about = tmp_path / "theirs-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: theirs\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[workbench.lessons]\nmine = theirs:lesson\n")
    path = os.pathsep.join([str(tmp_path), str(ROOT)])
    words = [sys.executable, "-m", "workbench", "list"]
    done = subprocess.run(
        words, capture_output=True, text=True, check=False, env=os.environ | {"PYTHONPATH": path}
    )
    assert done.returncode == 0
    assert (
        done.stderr
        == "workbench: lesson mine (theirs:lesson) is left out: its name 'icp' is taken by"
        " lessons.icp\n"
    )
    assert len(done.stdout.splitlines()) == len(OURS)


@pytest.mark.parametrize(
    ("names", "exercise", "command", "message"),
    [
        (
            ("same", "same"),
            "centroid",
            "list",
            "lessons.one and lessons.two are both named 'same': rename one",
        ),
        (
            ("a", "b"),
            "centroid",
            "exercise",
            (
                "exercise centroid is in lesson a (lessons.one.lesson) and in lesson b"
                " (lessons.two.lesson): rename one"
            ),
        ),
    ],
)
def test_a_clash_inside_the_course_is_refused_with_both_places(
    tmp_path, names, exercise, *, command, message
):
    for folder, name in zip(("one", "two"), names, strict=True):
        (tmp_path / "lessons" / folder / "exercises").mkdir(parents=True)
        (tmp_path / "lessons" / folder / "__init__.py").touch()
        (tmp_path / "lessons" / folder / "lesson.py").write_text(LESSON.format(name=name))
        (tmp_path / "lessons" / folder / "exercises" / f"{exercise}.py").write_text(CENTROID)
    (tmp_path / "lessons" / "__init__.py").touch()
    begin = (
        f"import sys; sys.path[:0] = [{str(tmp_path)!r}, {str(ROOT)!r}]; from workbench.cli import"
        " main; exit(main())"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", begin, command], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (2, f"workbench: {message}\n")


def test_two_lessons_of_one_name_are_not_published_together(tmp_path, capsys):
    for name in ("one", "two"):
        (tmp_path / f"{name}.py").write_text(LESSON.format(name="same"))
    words = [
        "publish",
        str(tmp_path / "site"),
        "--lesson",
        str(tmp_path / "one.py"),
        str(tmp_path / "two.py"),
    ]
    assert main(words) == 2
    assert "one.py and " in (line := capsys.readouterr().err)
    assert "two.py are both named 'same'" in line
