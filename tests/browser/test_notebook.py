"""A run in real notebooks: JupyterLab, and a notebook that was saved and exported as HTML."""

import contextlib
import json
import os
import re
import subprocess
import sys
import time

import pytest

import workbench
from workbench.lesson import catalog
from workbench.notebook import HOW_TO_PLAY, STILL
from workbench.run.timeline import Timeline

pytestmark = pytest.mark.browser
CELL = 'import workbench\nworkbench.replay("icp", start_angle=120, steps=4, height=520)'
CELLS = [
    {
        "cell_type": "code",
        "id": "one",
        "metadata": {},
        "source": CELL,
        "outputs": [],
        "execution_count": None,
    }
]


@pytest.fixture(scope="module")
def notebook(tmp_path_factory):
    """A notebook with one cell, in a folder of its own, with settings and runtime files there
    too.
    """
    pytest.importorskip("jupyterlab", reason="pip install -e '.[test]' has JupyterLab")
    folder = tmp_path_factory.mktemp("notebook")
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    told = {"cells": CELLS, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    (folder / "run.ipynb").write_text(json.dumps(told))
    bundle = workbench.replay("icp", start_angle=60, steps=1)._repr_mimebundle_()
    output = {"output_type": "execute_result", "execution_count": 1, "metadata": {}, "data": bundle}
    stranger = [{**CELLS[0], "outputs": [output], "execution_count": 1}]
    (folder / "stranger.ipynb").write_text(json.dumps({**told, "cells": stranger}))
    return folder / "run.ipynb"


def environment(notebook) -> dict[str, str]:
    own = {
        f"JUPYTER_{name}_DIR": str(notebook.parent / name.lower())
        for name in ("CONFIG", "DATA", "RUNTIME")
    }
    return {**os.environ, **own, "PATH": f"{os.path.dirname(sys.executable)}:{os.environ['PATH']}"}


def steps() -> Timeline:
    lesson = catalog()["icp"]
    timeline = Timeline(lesson, lesson.params(start_angle=120.0))
    while len(timeline) < 4:
        timeline.extend()
    return timeline


def plays(frame) -> None:
    """The page in a notebook says what the Timeline says, steps, and draws its scene."""
    here = steps()
    frame.locator("#caption").get_by_text(here[0].caption.text, exact=True).wait_for()
    frame.locator("[data-act=next]").click()
    frame.locator("#caption").get_by_text(here[1].caption.text, exact=True).wait_for()
    frame.locator("[data-act=last]").click()
    frame.locator("#caption").get_by_text(here[3].caption.text, exact=True).wait_for()
    frame.locator("[data-act=back]").click()
    frame.locator("#caption").get_by_text(here[2].caption.text, exact=True).wait_for()
    frame.frame_locator("#scene iframe").locator("canvas").first.wait_for()


def test_a_saved_notebook_plays_as_html(chromium, notebook):
    command = [
        sys.executable,
        "-m",
        "nbconvert",
        "--to",
        "html",
        "--execute",
        "--output",
        "saved.html",
        str(notebook),
    ]
    done = subprocess.run(
        command, capture_output=True, text=True, env=environment(notebook), cwd=notebook.parent
    )
    assert done.returncode == 0, done.stderr
    saved = notebook.with_name("saved.html")
    html = saved.read_text()
    assert html.count("<iframe") == 1
    page = chromium.new_page(viewport={"width": 1000, "height": 800})
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(saved.as_uri())
    page.evaluate("scrollTo(0, 0)")
    plays(page.frame_locator("iframe"))
    assert page.locator("iframe").bounding_box()["height"] == pytest.approx(520, abs=4)
    assert page.evaluate("document.activeElement.tagName") in ("BODY", "IFRAME")
    page.close()
    assert errors == []


def test_a_cell_plays_in_jupyterlab(chromium, notebook):
    command = [
        sys.executable,
        "-m",
        "jupyterlab",
        "--no-browser",
        "--core-mode",  # whatever else is installed may ask for a build
        "--port=0",
        "--IdentityProvider.token=",
        "--allow-root",
        "--ServerApp.disable_check_xsrf=True",
        "--LabApp.news_url=",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]
    from playwright.sync_api import TimeoutError as TookTooLong

    log = notebook.with_name("lab.txt")
    with (
        log.open("w") as output,
        subprocess.Popen(
            command, stdout=output, stderr=output, env=environment(notebook), cwd=notebook.parent
        ) as lab,
    ):
        try:
            address = found(log, lab)
            page = chromium.new_page(viewport={"width": 1280, "height": 900})
            page.goto(f"{address}/lab/tree/run.ipynb?reset")
            page.locator(".jp-Notebook .jp-CodeCell").first.wait_for()
            shown = page.locator(".jp-OutputArea-output iframe")
            # JupyterLab asks at any time, such as which kernel is meant
            page.add_locator_handler(
                page.locator("dialog.jp-Dialog"),
                lambda dialog: dialog.locator(".jp-mod-accept").first.click(),
            )
            for _ in range(10):  # a kernel that is still coming up may let go of what it is asked
                page.locator(".jp-Notebook .jp-CodeCell .cm-content").first.click()
                page.locator(".jp-Notebook-ExecutionIndicator[data-status=idle]").wait_for()
                page.keyboard.press("Control+Enter")
                with contextlib.suppress(TookTooLong):
                    shown.wait_for(timeout=30_000)
                    break
            plays(page.frame_locator(".jp-OutputArea-output iframe"))
            page.goto(f"{address}/lab/tree/stranger.ipynb?reset")
            page.get_by_text(HOW_TO_PLAY).wait_for()  # somebody else's outputs are not trusted
            still = page.locator(".jp-OutputArea-output img")
            assert (
                still.evaluate("image => image.decode().then(() => image.naturalWidth)") == STILL[0]
            )
            assert shown.count() == 0
            page.close()
        finally:
            ended(lab)


def ended(lab) -> None:
    """End JupyterLab, which at times waits for a thread of its own for ever."""
    lab.terminate()
    try:
        lab.wait(timeout=20)
    except subprocess.TimeoutExpired:
        lab.kill()


def found(log, lab) -> str:
    """Return where JupyterLab says that it listens."""
    for _ in range(1800):
        if match := re.search(r"http://(?:localhost|127\.0\.0\.1):(\d+)/lab", log.read_text()):
            return f"http://127.0.0.1:{match[1]}"
        assert lab.poll() is None, log.read_text()
        time.sleep(0.1)
    raise AssertionError(log.read_text())
