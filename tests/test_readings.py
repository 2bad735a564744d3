"""What reads numbers back out of sentences takes what they say, and nothing else."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.readings import metres, near, near_length, says_percent
from workbench.numerals import brief, length, percent


@given(st.floats(1e-6, 1e6) | st.floats(-1e6, -1e-6))
def test_a_value_is_near_what_is_said_of_it_and_another_is_not(value):
    assert near(brief(value), value)
    assert not near(brief(value), 1.02 * value)


@given(st.floats(1e-5, 1e6))
def test_so_is_a_length(value):
    assert near_length(length(value), value)
    assert not near_length(length(value), 1.02 * value)
    assert metres(length(value)) == pytest.approx(value, rel=0.0051)


@given(st.floats(1e-4, 50.0))
def test_so_is_a_share(value):
    assert says_percent(percent(value), value)
    assert not says_percent(percent(value), 2.0 * value + 0.001)


@pytest.mark.parametrize(
    ("text", "share", "agrees"),
    [
        ("0 %", 0.0, True),
        ("0 %", 0.004, False),
        ("less than 0.01 %", 5e-5, True),
        ("less than 0.01 %", 2e-4, False),
        ("9.0 %", 0.0896, True),
        ("9.0 %", 0.0889, False),
        ("129 %", 1.29, True),
        ("129 %", 1.31, False),
    ],
)
def test_shares(text, share, agrees):
    assert says_percent(text, share) is agrees
