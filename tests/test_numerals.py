"""Numbers in sentences: what they say is the number, and how they say it is fit to be read."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.numerals import brief, fixed, fixed_or_power, fixed_row

NUMERAL = re.compile(r"−?\d{1,3}(,\d{3})*(\.\d+)?")


def read(text: str) -> float:
    assert NUMERAL.fullmatch(text), text
    return float(text.replace(",", "").replace("−", "-"))


@given(st.floats(-1e12, 1e12), st.integers(0, 6))
def test_fixed_is_the_number_to_its_places(value, places):
    text = fixed(value, places)
    assert abs(read(text) - value) <= 0.5 * 10.0**-places + 1e-9 * abs(value)
    assert math.copysign(1.0, read(text)) == 1.0 or read(text) < 0.0


@given(st.floats(-1e12, 1e12), st.integers(1, 8))
def test_brief_is_the_number_to_its_digits(value, digits):
    assert abs(read(brief(value, digits)) - value) <= 0.5 * 10.0 ** (1 - digits) * abs(value) + 1e-9


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (fixed(-0.001, 2), "0.00"),
        (fixed(-90.0, 0), "−90"),
        (fixed(-3284908864.4, 0), "−3,284,908,864"),
        (brief(8.39e-05), "0.0000839"),
        (brief(1.2e-15), "0"),
        (brief(-1e-7), "−0.0000001"),
        (brief(3240.0), "3,240"),
        (brief(1200.0), "1,200"),
        (brief(1.4), "1.4"),
        (brief(0.0), "0"),
        (brief(99.96), "100"),
        (brief(1e7), "10,000,000"),
        (brief(12.345, 4), "12.35"),
        (fixed_or_power(-999999.4, 1), "−999,999.4"),
        (fixed_or_power(-3284908864.4, 1), "−3.28 × 10⁹"),
        (fixed_or_power(1e21, 1), "1.00 × 10²¹"),
        (fixed_row([1.0, -0.0, -2.5], 1), "1.0, 0.0, −2.5"),
    ],
)
def test_numerals(text, said):
    assert text == said
