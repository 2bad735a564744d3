import base64
import html
import io
import re
import subprocess
import sys
from pathlib import Path

import pytest
from fontTools.ttLib import TTFont

from workbench.errors import InputError
from workbench.lesson import catalog
from workbench.words.typeset import (
    LARGEST_PICTURE,
    inline_html,
    math_font,
    math_font_css,
    math_html,
    page_html,
    page_of,
)


def test_maths_becomes_mathml_and_sections_are_named():
    page = page_html(
        "# T\n\nText $x^2$.\n\n## Break it!\n\n$$\\sum_i \\lVert p_i \\rVert$$\n\n| a |\n|---|\n|"
        " 1 |\n"
    )
    assert page.count("<math") == 2
    assert '<section class="s-break-it">' in page
    assert "<table>" in page
    assert 'display="block"' in page


def test_html_in_a_text_is_shown_as_text():
    for shown in (
        page_html("a <script>alert(1)</script>"),
        inline_html("<img src=x onerror=alert(1)>"),
    ):
        assert "<script" not in shown
        assert "<img" not in shown
        assert "&lt;" in shown
    assert "javascript:" not in page_html("[a](javascript:alert(1))").replace("[a](javascript:", "")


def test_functions_the_converter_does_not_know_are_taught_to_it():
    assert "arg" in math_html(r"\arg\min_x f(x)")
    assert chr(92) not in math_html(r"\arg\min_x f(x)")


def test_a_formula_that_cannot_be_read_is_shown_as_written():
    assert math_html(r"\frac{1}") == r"<code>\frac{1}</code>" or "<math" in math_html(r"\frac{1}")
    assert "&lt;b&gt;" in math_html("<b>") or "<mi>" in math_html("<b>")


def test_the_font_is_small_and_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    math_font.cache_clear()
    font = math_font()
    assert 75_000 < len(font) < 150_000
    kept = list(tmp_path.rglob("*.woff2"))
    assert len(kept) == 1
    math_font.cache_clear()
    assert math_font() == font


def test_a_page_has_the_font_beside_it_or_in_it():
    assert "url(math.woff2)" in math_font_css("math.woff2")
    inside = re.search(r"base64,([^)]*)\)", math_font_css())
    assert inside is not None
    assert base64.b64decode(inside.group(1)) == math_font()


def test_the_font_says_whose_it_is_and_under_which_licence():
    names = TTFont(io.BytesIO(math_font()))["name"]
    texts = {kind: names.getDebugName(kind) or "" for kind in (0, 7, 13, 14)}
    assert "STIX Fonts Project Authors" in texts[0]
    assert "trademarks" in texts[7]
    assert "SIL Open Font License, Version 1.1" in texts[13]
    assert texts[14] == "https://scripts.sil.org/OFL"


def test_the_font_has_every_letter_of_every_formula():
    known = TTFont(io.BytesIO(math_font())).getBestCmap() or {}
    for lesson in catalog().values():
        for formula in re.findall(r"<math.*?</math>", page_html(lesson.text()), re.DOTALL):
            letters = set(html.unescape(re.sub(r"<[^>]*>", "", formula)))
            assert {c for c in letters if not c.isspace() and ord(c) not in known} == set(), (
                lesson.name
            )


DOT = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)


@pytest.fixture
def page(tmp_path):
    folder = tmp_path / "lesson"
    (folder / "figures").mkdir(parents=True)
    (folder / "dot.png").write_bytes(DOT)
    (folder / "figures" / "a b.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    (folder / "large.webp").write_bytes(bytes(LARGEST_PICTURE + 1))
    (folder / "notes.txt").write_text("no picture")
    (tmp_path / "outside.png").write_bytes(DOT)
    (folder / "link.png").symlink_to(tmp_path / "outside.png")
    return folder / "page.md"


def test_a_page_s_pictures_come_with_it(page):
    page.write_text('# T\n\n![a "dot" & $x$](dot.png)\n\n## Watch\n\n![b](./figures/a%20b.svg)\n')
    html = page_of(page.read_text(encoding="utf-8"), page)
    assert f'src="data:image/png;base64,{base64.b64encode(DOT).decode()}"' in html
    assert "data:image/svg+xml;base64," in html
    assert 'alt="a &quot;dot&quot; &amp; ' in html
    assert "<img" not in page_html(page.read_text())  # without a folder a picture is its words


@pytest.mark.parametrize(
    ("name", "line"),
    [
        ("missing.png", "no picture 'missing.png'"),
        ("../outside.png", "no picture '../outside.png'"),
        ("figures/../../outside.png", "no picture"),
        ("%2e%2e/outside.png", "no picture '../outside.png'"),
        ("/etc/hostname.png", "no picture '/etc/hostname.png'"),
        ("https://example.org/a.png", "no picture 'https://example.org/a.png'"),
        ("link.png", "no picture 'link.png'"),
        ("figures", "no picture 'figures'"),
        ("notes.txt", "'notes.txt' is none of .svg, .png"),
        ("large.webp", "'large.webp' has 300 kB, over the limit of 300 kB"),
    ],
)
def test_a_picture_that_is_not_the_page_s_own_is_one_line(page, name, line):
    page.write_text(f"![a]({name})")
    with pytest.raises(InputError) as raised:
        page_of(page.read_text(encoding="utf-8"), page)
    assert line in str(raised.value)
    assert str(page) in str(raised.value)
    assert "\n" not in str(raised.value)


FIRST = """
import sys, threading
from workbench.words import typeset

sys.setswitchinterval(1e-6)
typeset._parser()
wrong, gate = [], threading.Barrier(8)

def first():
    gate.wait()
    try:
        typeset.page_html("[far](run:far@-1) [there](http://a/b c)" * 20)
    except Exception as error:
        wrong.append(error)

threads = [threading.Thread(target=first) for _ in range(8)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
sys.exit(repr(wrong) if wrong else 0)
"""


def test_several_threads_may_typeset_their_first_page_at_once():
    for _ in range(3):
        subprocess.run([sys.executable, "-c", FIRST], cwd=Path(__file__).parents[1], check=True)
