"""A run in a notebook: one frame that needs nothing else, and the same told as text."""

import base64
import io
import json
import os
import re
import subprocess
import sys
from html import unescape
from pathlib import Path

import pytest
from PIL import Image

import workbench
from tests import fake
from workbench.errors import InputError
from workbench.lesson import catalog
from workbench.notebook import HOW_TO_PLAY, STILL
from workbench.run.timeline import Timeline


@pytest.fixture(scope="module")
def shown():
    return workbench.replay("icp", start_angle=60, steps=3)


def test_as_text_it_is_the_last_caption_its_numbers_and_the_command(shown):
    here = Timeline(catalog()["icp"], catalog()["icp"].params(start_angle=60.0))
    while len(here) < 3:
        here.extend()
    caption, numbers, command = repr(shown).split("\n")
    assert caption == f"Iterative closest point, step 2 of 2: {here[2].caption.text}"
    assert "RMSE" in numbers
    assert command == "Live: workbench show icp --start-angle=60"
    bundle = shown._repr_mimebundle_()
    assert bundle["text/plain"] == repr(shown)
    assert bundle["text/html"] == shown._repr_html_()


def test_a_still_picture_and_one_line_stand_where_no_frame_is_shown(shown):
    png = base64.b64decode(shown._repr_mimebundle_()["image/png"])
    with Image.open(io.BytesIO(png)) as still:
        assert (still.format, still.size) == ("PNG", STILL)
        # two clouds on white, not an empty ground
        assert len(still.convert("RGB").getcolors(1 << 20) or ()) > 20
    html = re.sub("<iframe.*</iframe>", "", shown._repr_html_())
    assert html.count("data:image/png;base64,") == 1
    assert html.count(f"<p>{HOW_TO_PLAY}</p>") == 1
    assert len(png) < 100_000


def test_a_cell_has_the_frame_and_nothing_else():
    nbformat = pytest.importorskip("nbformat", reason="pip install -e '.[test]' has nbconvert")
    nbclient = pytest.importorskip("nbclient", reason="pip install -e '.[test]' has nbconvert")
    cell = nbformat.v4.new_code_cell(
        'import workbench\nworkbench.replay("icp", start_angle=60, steps=1)'
    )
    nbclient.NotebookClient(
        nbformat.v4.new_notebook(cells=[cell]), timeout=300, kernel_name="python3"
    ).execute()
    (output,) = cell.outputs
    assert set(output.data) == {"text/html", "image/png", "text/plain"}
    assert "127.0.0.1" not in output.data["text/html"]


def test_the_frame_asks_for_nothing(shown):
    html = shown._repr_html_()
    assert html.count("<iframe") == 1
    assert "height:640px" in html
    document = unescape(re.search(r'srcdoc="([^"]*)"', html)[1])  # type: ignore[index]
    assert not re.search(
        r'<(script|link|img|iframe)[^>]*(src|href)="(?!data:)',
        document.partition("viserClient(")[0],
    )


def test_the_licences_of_what_is_in_the_frame_come_along(shown):
    document = unescape(re.search(r'srcdoc="([^"]*)"', shown._repr_html_())[1])  # type: ignore[index]
    text = re.search(
        r'<script type="text/plain" id="third-parties">(.*?)</script>', document, re.DOTALL
    )
    assert text is not None
    assert "Apache License" in text[1]
    assert "client of viser" in text[1]


def test_nothing_is_printed(capfd):
    workbench.replay("icp", steps=1)._repr_html_()
    assert capfd.readouterr() == ("", "")


def test_a_lesson_may_be_given_itself_and_params_start_from_a_preset():
    preset = fake.lesson.presets[0]
    assert workbench.replay(fake.lesson, preset=preset.name).params == preset.params
    assert len(workbench.replay(fake.lesson).timeline) == len(
        Timeline(fake.lesson, fake.Params()).complete()
    )


MARIMO = """
import marimo

app = marimo.App()


@app.cell
def _():
    import workbench

    workbench.replay("icp", start_angle=60, steps=3)
    return


if __name__ == "__main__":
    app.run()
"""


def test_marimo_keeps_the_frame_as_it_is(shown, tmp_path):
    pytest.importorskip("marimo", reason="pip install marimo")
    (tmp_path / "run.py").write_text(MARIMO)
    command = [
        sys.executable,
        "-m",
        "marimo",
        "export",
        "html",
        "run.py",
        "-o",
        "run.html",
        "--no-include-code",
    ]
    homes = {f"XDG_{name}_HOME": str(tmp_path / name) for name in ("CONFIG", "STATE", "DATA")}
    environment = os.environ | homes | {"PYTHONPATH": str(Path(workbench.__file__).parents[1])}
    subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, check=True)
    written = re.findall(r'"text/html": ("(?:[^"\\]|\\.)*")', (tmp_path / "run.html").read_text())
    frames = [html for html in map(json.loads, written) if "<iframe" in html]
    assert len(frames) == 1
    document = unescape(re.search(r'srcdoc="([^"]*)"', frames[0])[1])  # type: ignore[index]
    assert all(
        json.dumps(step.caption.text, ensure_ascii=False)[1:-1] in document
        for step in shown.timeline.known()
    )
    assert frames[0].count("<iframe") == 1


@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"lesson": "nothing"}, "no lesson is named 'nothing'"),
        ({"lesson": "icp", "preset": "nothing"}, "no preset 'nothing'"),
        ({"lesson": "icp", "angle": 3}, "unknown parameter 'angle'"),
        ({"lesson": "icp", "start_angle": 1000}, "start_angle = 1000"),
        ({"lesson": "icp", "steps": 0}, "1 or more"),
        ({"lesson": "icp", "height": 10}, "pixels or more"),
    ],
)
def test_what_cannot_be_shown_is_said_in_one_line(wrong, why):
    with pytest.raises(InputError, match=why) as error:
        workbench.replay(**wrong)
    assert "\n" not in str(error.value)
