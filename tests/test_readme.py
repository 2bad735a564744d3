"""The README's examples, verbatim: each is cut out of the file and run."""

import contextlib
import io
import re
from pathlib import Path

import numpy as np
import pytest

from workbench import open_recording
from workbench.cli import main
from workbench.errors import InputError
from workbench.lesson import Lesson, course
from workbench.publish import site
from workbench.run import links
from workbench.run.loading import load
from workbench.run.session import Session
from workbench.viewer.documents import lesson_page

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def example(heading: str) -> str:
    """The first block of Python below a heading."""
    section = re.split(r"^#+ ", README.split(f"# {heading}\n")[1], flags=re.MULTILINE)[0]
    return re.findall(r"```python\n(.*?)```", section, re.DOTALL)[0]


@pytest.fixture
def lesson_file(tmp_path) -> Path:
    path = tmp_path / "my_lesson.py"
    path.write_text(example("Add a lesson in a few lines"), encoding="utf-8")
    return path


def test_the_example_in_python(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        exec(compile(example("From Python"), "README.md", "exec"), {})
    shown, caption, *curves = output.getvalue().splitlines()
    recording = open_recording("icp.rrd")
    assert shown == repr(recording)
    assert recording.params["start_angle"] == 60
    assert caption == recording.captions[-1]
    seen = [
        values[np.isfinite(values)][-1]
        for path, values in recording.scalars.items()
        if path != "step"
    ]
    printed = [float(re.findall(r": (\S+)", line)[0]) for line in curves]
    assert printed == pytest.approx(seen, rel=5e-3)
    assert len(curves) == 6


def test_the_lesson_is_recorded_and_opened_again(capsys, monkeypatch, lesson_file):
    opened: list[tuple] = []
    monkeypatch.setattr("workbench.viewer.serving.serve", lambda *place, **_: opened.append(place))
    out = lesson_file.with_name("turn.rrd")
    assert main(["record", str(lesson_file), "--turns", "180", "-o", str(out)]) == 0
    recording = open_recording(out)
    assert (recording.lesson, len(recording)) == ("turn", 11)
    assert recording.captions[-1] == "Turned by 180°."
    assert main(["show", str(lesson_file), "--turns=45"]) == 0
    assert main(["reopen", str(out), "--lesson", str(lesson_file)]) == 0
    assert [params.turns for _, params, _ in opened] == [45.0, 180.0]
    assert capsys.readouterr().err == ""


def test_the_lesson_plays_live_with_its_summary_as_its_page(lesson_file):
    lesson = load(lesson_file)
    session = Session(lesson)
    session.compute(10)
    look = session.look()
    assert look is not None
    assert look.finished
    assert links.read(links.write(links.Place(lesson, lesson.params(), 3)), here=lesson)
    page = lesson_page(lesson, {"turn": lesson})
    assert "<h1>A turn</h1>" in page
    assert page.count("An arrow turns.") >= 2  # of the head, and on the page


def test_the_lesson_is_published_with_its_summary_as_its_page(tmp_path, lesson_file):
    site.publish(tmp_path / "site", [load(lesson_file)])
    page = (tmp_path / "site" / "turn" / "index.html").read_text(encoding="utf-8")
    assert "A turn" in page
    assert page.count("An arrow turns.") >= 2  # of the head, and on the page
    assert "workbench show my_lesson.py" in (
        tmp_path / "site" / "turn" / "runs" / "default.js"
    ).read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "command", [["show"], ["record", "-o", "a.rrd"], ["publish", "site", "--lesson"]]
)
def test_a_page_that_is_not_there_is_one_line_with_lesson_and_path(
    capsys, monkeypatch, lesson_file, *, command
):
    monkeypatch.chdir(lesson_file.parent)
    text = lesson_file.read_text(encoding="utf-8").replace(
        "params=Input", 'page=Path("none/page.md"), params=Input'
    )
    lesson_file.write_text("from pathlib import Path\n" + text, encoding="utf-8")
    assert main([*command, "my_lesson.py"]) == 2
    missing = lesson_file.parent / "none" / "page.md"
    line = capsys.readouterr().err
    assert (
        line
        == f"workbench: my_lesson.py: lesson turn: its page {missing}: No such file or directory\n"
    )


def test_a_page_that_goes_away_is_one_line_too(tmp_path, lesson_file):
    page = tmp_path / "page.md"
    page.write_text("# Here", encoding="utf-8")
    loaded = load(lesson_file)
    lesson = Lesson(
        **{name: getattr(loaded, name) for name in loaded.__dataclass_fields__} | {"page": page}
    )
    assert lesson.text() == "# Here"
    page.unlink()
    with pytest.raises(InputError, match=r"lesson turn: its page .*page\.md: No such file"):
        lesson.text()


@pytest.mark.parametrize("lesson", course().values(), ids=lambda lesson: lesson.name)
def test_every_lesson_of_the_course_has_its_row_and_its_picture(lesson):
    row = next(
        line
        for line in README.splitlines()
        if line.startswith("|") and f"(`{lesson.name}`)" in line
    )
    assert f"**{lesson.title}**" in row
    assert (ROOT / re.findall(r'src="(.*?)"', row)[0]).is_file()
