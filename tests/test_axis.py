"""An axis has round ticks with words that tell them apart, and does not show round-off."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.words.axis import (
    LONGEST_LABEL,
    apart,
    axis,
    labelled,
    number,
    of_powers,
    settled,
    ticks,
    value_axis,
)

finite = st.floats(-1e6, 1e6)


@given(finite, st.floats(1e-6, 1e6), st.integers(2, 8))
def test_ticks_are_few_round_and_inside(low, span, most):
    high = low + span
    if not high - low > 1e-9 * abs(low):
        return
    places = ticks(low, high, most)
    assert 1 <= len(places) <= most
    assert (places >= low - 1e-6 * span).all()
    assert (places <= high + 1e-6 * span).all()
    if len(places) > 1:
        step = places[1] - places[0]
        first = float(f"{step:.6e}"[0])
        assert first in (1, 2, 5, 9)  # 9: a one that rounding took down


def test_a_zero_tick_has_no_sign():
    assert axis(-1.0, 1.0, 3).words == ("−1", "0", "1")


@given(st.lists(finite | st.floats(-1e-8, 1e-8) | st.just(float("nan")), max_size=8), st.booleans())
def test_values_are_on_their_axis_and_its_words_differ(values, from_zero):
    known = settled(np.array(values, float))
    up = value_axis([np.array(values, float)], from_zero)
    assert up.low < up.high
    assert np.nanmin([*known, up.high]) >= up.low
    assert np.nanmax([*known, up.low]) <= up.high
    assert len(set(up.words)) == len(up.words) == len(up.ticks) >= 1
    if from_zero:
        assert up.low <= 0.0 <= up.high


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ([2.84e-14, 0.0, 2.84e-14], ("0", "0.5", "1.0")),
        ([0.0035, 0.0045], ("0.0036", "0.0038", "0.0040", "0.0042", "0.0044")),
        ([1e-5, 3e-5], ("0", "1e−5", "2e−5", "3e−5")),
        ([0.0, 120_000.0], ("0", "50,000", "100,000")),
        ([5.0, 5.0 + 1e-14], ("3", "4", "5", "6", "7")),
    ],
)
def test_ticks_have_the_digits_they_need(values, words):
    assert value_axis([np.array(values)]).words == words


@pytest.mark.parametrize(
    ("value", "word"),
    [
        (1.09e-15, "0"),
        (-3e-10, "0"),
        (0.0413, "0.0413"),
        (3240.4, "3,240"),
        (-1.5, "−1.5"),
        (2.5e-6, "2.5e−6"),
        (100.0, "100"),
        (0.99999, "1"),
        (12_345_678.0, "1.23e7"),
    ],
)
def test_a_number_is_said_in_three_digits_and_round_off_is_zero(value, word):
    assert number(value) == word


def test_steps_have_no_ticks_between_them():
    assert axis(0.0, 2.0).words == ("0", "0.5", "1.0", "1.5", "2.0")
    assert axis(0.0, 2.0, whole=True).words == ("0", "1", "2")
    assert axis(0.0, 134.0, whole=True).words == ("0", "50", "100")
    assert axis(0.0, 0.0, whole=True).words == ("0",)


def test_ends_that_only_round_off_tells_apart_are_moved_apart():
    assert apart(1.0, 1.0 + 1e-12) == pytest.approx((0.9, 1.1))
    assert apart(0.0, 0.0) == (-0.5, 0.5)
    assert apart(0.0, 2.0) == (0.0, 2.0)


@pytest.mark.parametrize(
    ("chart", "unit", "expected"),
    [
        ("RMSE", "m", ("", "RMSE (m)")),
        ("Error to the truth", "%", ("Error to the truth", "%")),
        ("Mass that is far astray", "", ("Mass that is far astray", "")),
    ],
)
def test_no_label_is_longer_than_its_axis(chart, unit, expected):
    assert labelled(chart, unit) == expected
    assert len(expected[1]) <= LONGEST_LABEL


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (-1.2, 1.3, ("0.1", "1", "10")),
        (-9.1, 0.4, ("1e−5", "1")),
        (0.1, 0.9, ("2", "5")),
    ],
)
def test_logarithms_are_said_as_the_numbers_that_they_are_of(low, high, words):
    powers = of_powers(axis(low, high, 4))
    assert powers.words == words
    assert (powers.low, powers.high) == (low, high)
    assert all(low <= place <= high for place in powers.ticks)
