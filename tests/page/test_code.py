"""Code on a page: every sign of it is there, Python's own tokens have their colours, and what is no
Python stays plain.
"""

import gc
import html
import re
import threading
from pathlib import Path

import pytest

import workbench
from workbench.page.code import _long_docstring, text_html

SOURCES = sorted(Path(workbench.__file__).parent.rglob("*.py"))[::9]


def plain(shown: str) -> list[str]:
    """The lines of a shown text, without their numbers."""
    rows = re.findall(r'<div data-line="\d+"><span class="n">\d+</span>(.*?)</div>', shown)
    return [html.unescape(re.sub(r"</?span[^>]*>", "", row)) for row in rows]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_nothing_of_a_source_is_lost(path):
    text = path.read_text(encoding="utf-8").rstrip()
    assert plain(text_html(text)) == [line or " " for line in text.split("\n")]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("return x", '<span class="k">return</span> x'),
        ("a is not None", 'a <span class="k">is</span> <span class="k">not</span>'),
        ("x = 1.5e3", '= <span class="m">1.5e3</span>'),
        ("x = 'é' + y", '<span class="s">&#x27;é&#x27;</span> + y'),
        ("x  # why <b>", 'x  <span class="c"># why &lt;b&gt;</span>'),
    ],
)
def test_tokens_have_their_colours(text, shown):
    assert shown in text_html(text)


def test_a_text_over_several_lines_is_coloured_in_each():
    rows = text_html("x = '''a\nb'''\ny").split("<div ")
    assert '<span class="s">&#x27;&#x27;&#x27;a</span>' in rows[1]
    assert '<span class="s">b&#x27;&#x27;&#x27;</span>' in rows[2]
    assert '<span class="s">' not in rows[3]


@pytest.mark.parametrize(
    "text", ["x = (1,", "def f(:\n  '''a", "x = 'a\ny", "  a\n b\n", "a\tb ?$"]
)
def test_what_is_no_python_is_shown_all_the_same(text):
    assert plain(text_html(text)) == text.rstrip().split("\n")


def test_sources_that_two_threads_show_at_once_do_not_disturb_each_other():
    """A collection of garbage while a tree is made lets another thread run, which makes another."""
    inside, done = threading.Event(), threading.Event()
    main = threading.current_thread()
    failed: list[SystemError] = []

    def meanwhile() -> None:
        inside.wait(10)
        for deep in range(3):
            show(deep)
        done.set()

    def show(deep: int) -> None:
        try:
            _long_docstring(text_of(deep))
        except SystemError as error:
            failed.append(error)

    def text_of(deep: int) -> str:
        return "def f():\n    return " + "(0, " * (20 * deep) + "0" + ")" * (20 * deep)

    def while_collected(phase: str, _info: object) -> None:
        if phase == "start" and threading.current_thread() is main and not inside.is_set():
            inside.set()
            done.wait(1)  # the other one waits for this one, or disturbs it

    other = threading.Thread(target=meanwhile)
    other.start()
    threshold = gc.get_threshold()
    gc.callbacks.append(while_collected)
    gc.set_threshold(50)
    try:
        show(4)
    finally:
        gc.set_threshold(*threshold)
        gc.callbacks.remove(while_collected)
        inside.set()
        other.join()
    assert not failed
