"""Words and formulas that Rerun's fonts can draw."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests import fake
from workbench.lesson import catalog
from workbench.machinery.licence import CC_BY, NOTICE
from workbench.recording.glyphs import safe
from workbench.recording.plain_page import plain_formula, plain_page
from workbench.recording.sink import markdown
from workbench.recording.write import _told


@given(st.text(max_size=60))
def test_safe_words_stay_as_they_are(text):
    assert safe(safe(text)) == safe(text)


@given(st.text(st.characters(min_codepoint=0x20, max_codepoint=0x7E), max_size=60))
def test_plain_text_stays_as_it_is(text):
    assert safe(text) == text


@pytest.mark.parametrize(
    ("text", "drawn"),
    [
        ("θ² ‖x‖ → −½", "θ² ‖x‖ → −½"),
        ("Rᵀ", "R^T"),
        ("x ∈ ℝ³", "x  in  R³"),
        ("⟨a, b⟩", "<a, b>"),
        ("𝐱 and ﬁ", "x and fi"),
        ("中🙂", "??"),
        ("e\u0301 x\u0302", "é x"),
    ],
)
def test_signs_that_fonts_lack_are_replaced(text, drawn):
    assert safe(text) == drawn


@pytest.mark.parametrize(
    ("tex", "plain"),
    [
        (r"p_t = R\,p_s + t", "pₜ = R pₛ + t"),
        (r"\frac{a+b}{2}", "(a + b)/2"),
        (r"\frac1n\sum_i x_i^2", "1/n ∑ᵢ xᵢ²"),
        (r"\sqrt{x^2 + y^2}", "√(x² + y²)"),
        (r"V^\top", "V^T"),
        (r"\mathrm{median}(d) \le 3", "median(d) ≤ 3"),
        (r"T_{\text{world}}^{-1}", "T_world⁻¹"),
        (r"x_{i+1}", "xᵢ₊₁"),
        (r"x_{k,i}", "x_(k,i)"),
        (r"\{1, 2\}", "{1, 2}"),
        (r"\begin{bmatrix} 1 & 0 \\ 0 & 1 \end{bmatrix}", "[1 0; 0 1]"),
        (r"\lVert q \rVert", "‖q‖"),
        (r"90^\circ", "90°"),
        (r"\bar q", "mean q"),
        (r"\unknown{x}", r"\unknownx"),
        (r"\frac", r"\frac"),
        (r"x^", "x^"),
        (r"^\bf", r"^\bf"),
        ("}", "}"),
        ("a & b", "a & b"),
        (r"(-n^\top, -1) = K^{-\top}", "(−n^T, −1) = K^(−T)"),
        (r"8 \sin^2 a", "8 sin² a"),
    ],
)
def test_formulas_in_plain_signs(tex, plain):
    assert plain_formula(tex) == plain


@given(st.text(st.sampled_from(list(r"\{}^_$ab12&frac ")), max_size=30))
def test_no_formula_breaks_the_page(tex):
    assert "\x00" not in plain_formula(tex)


def test_code_is_left_alone_and_formulas_become_words():
    page = plain_page("Take $\\alpha_1$ and `$x$`.\n\n$$ a = b $$\n\n```\n$y$\n```\n")
    assert page == "Take α₁ and `$x$`.\n\n\n    a = b\n\n\n```\n$y$\n```\n"


def test_a_picture_is_its_words():
    page = plain_page("See ![a circle of $r_1$](figures/a.svg) and `![b](c.png)`.")
    assert page == "See a circle of r₁ and `![b](c.png)`."


@pytest.mark.parametrize("lesson", catalog().values(), ids=lambda lesson: lesson.name)
def test_every_page_is_free_of_tex(lesson):
    page = plain_page(lesson.page.read_text(encoding="utf-8"))
    assert safe(page) == page
    assert "$" not in page.replace("`$", "")
    for command in (
        "frac",
        "\\sum",
        "mathrm",
        "\\left",
        "begin{",
        "operatorname",
        "qquad",
        "lVert",
        "boldsymbol",
    ):
        assert command not in page, command
    assert "?" * 2 not in page


def test_what_looks_like_a_link_in_a_caption_stays_words():
    assert (
        markdown("[x](https://example.org) ![y](z)") == "\\[x\\](https://example.org) !\\[y\\](z)"
    )


def test_a_recording_says_whose_its_words_are_where_they_are_of_the_course():
    ours = catalog()["fitting"]
    assert _told(ours).endswith(f"\n\n{NOTICE}\n")
    assert CC_BY in NOTICE
    assert _told(fake.lesson) == fake.lesson.text()
