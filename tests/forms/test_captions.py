"""Captions that carry their values."""

import numpy as np
import pytest

from workbench.captions import (
    counted,
    degrees,
    fixed,
    metres,
    number,
    pixels,
    say,
    share,
    square_metres,
)
from workbench.scene import Caption


def test_it_says_its_values_and_keeps_them():
    caption = say(
        "Fit {n} of {shape} turns by {turned}.", n=3, shape="the rabbit", turned=degrees(0.2)
    )
    assert caption.text == "Fit 3 of the rabbit turns by 0.2°."
    assert caption.values == {"n": 3.0, "turned": 0.2}
    assert caption.tone == "info"


@pytest.mark.parametrize(
    ("quantity", "words", "value"),
    [
        (metres(0.0251), "25.1 mm", 0.0251),
        (metres(np.float64(2.5)), "2.5 m", 2.5),
        (degrees(-66.04, 2), "−66°", -66.04),
        (pixels(4.126), "4.13 px", 4.126),
        (share(0.352), "35 %", 0.352),
        (square_metres(0.25), "0.25 m²", 0.25),
        (number(1234.567), "1,230", 1234.567),
        (fixed(2.0, 1), "2.0", 2.0),
        (counted(1, "match", "matches"), "1 match", 1.0),
        (0.1234, "0.123", 0.1234),
        (12_345, "12,345", 12345.0),
        (-3, "−3", -3.0),
        (np.float64(0.5), "0.5", 0.5),
        (np.int64(12_345), "12,345", 12345.0),
    ],
)
def test_quantities_have_words_and_value(quantity, words, value):
    caption = say("It is {it}.", it=quantity)
    assert caption.text == f"It is {words}."
    assert caption.values["it"] == pytest.approx(value)


def test_an_end_is_right_or_wrong():
    assert say("At {a}.", right=True, a=2).tone == "good"
    wrong = say("At {a}.", right=False, a=2)
    assert (wrong.tone, wrong.values) == ("wrong", {"a": 2.0})
    assert wrong.text == Caption.verdict("At 2.", right=False).text
    assert "It looks settled" not in say("At {a}.", right=False, settled=False, a=2).text


def test_the_step_has_a_name():
    assert say("It fits.", place="fit").place == "fit"
    assert say("It fits.", right=True, place="fit").place == "fit"


@pytest.mark.parametrize(
    ("sentence", "values", "message"),
    [
        ("It is {a}.", {}, "differ in: a"),
        ("It is.", {"a": 2}, "differ in: a"),
        ("It is {a:.2f}.", {"a": 2}, "formats a number itself"),
        ("It is {a}.", {"a": float("nan")}, "a is nan; say in words"),
        (
            "It is {a}.",
            {"a": metres(0.1).__class__(float("inf"), "none")},
            "a is inf; say in words",
        ),
        ("It is {}.", {}, "differ in"),
    ],
)
def test_what_does_not_fit_is_refused(sentence, values, message):
    with pytest.raises(ValueError, match=message):
        say(sentence, **values)
