"""Numbers in sentences: what they say is the number, and how they say it is fit to be read."""

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.numerals import (
    angle,
    area,
    brief,
    coordinates,
    counted,
    fixed,
    fixed_or_power,
    fixed_row,
    length,
    percent,
    pixels,
    plus_minus,
    power_of_ten,
)

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
    ("text", "expected"),
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
        (brief(0.3125), "0.313"),
        (brief(-2.125), "−2.13"),
        (fixed_or_power(-999999.4, 1), "−999,999.4"),
        (fixed_or_power(-3284908864.4, 1), "−3.28 × 10⁹"),
        (fixed_or_power(1e21, 1), "1.00 × 10²¹"),
        (power_of_ten(9), "10⁹"),
        (power_of_ten(-12), "10⁻¹²"),
        (area(3.7251), "3.73 m²"),
        (area(0.001), "0.001 m²"),
        (area(0.0009), "900 mm²"),
        (area(0.0), "0 mm²"),
        (fixed_row([1.0, -0.0, -2.5], 1), "1.0, 0.0, −2.5"),
        (length(0.0), "0 mm"),
        (length(1e-16), "0 mm"),
        (length(2.34e-8), "0.023 µm"),
        (length(9.96e-7), "1 µm"),
        (length(0.00123456), "1.23 mm"),
        (length(0.09996), "100 mm"),
        (length(0.1), "0.1 m"),
        (length(-2.5), "−2.5 m"),
        (length(2.345, 2), "2.3 m"),
        (length(5_403_210.0), "5,400 km"),
        (length(12_345.6), "12,300 m"),
        (length(245_345.4), "245,000 m"),
        (length(3.28e12), "3.28 × 10⁹ km"),
        (pixels(1e-12), "0 px"),
        (pixels(3.4567), "3.46 px"),
        (pixels(82_389.27), "82,400 px"),
        (pixels(3.28e9), "3.28 × 10⁹ px"),
        (angle(0.0), "0°"),
        (angle(1e-5), "less than 0.001°"),
        (angle(35.04), "35°"),
        (angle(-0.5), "−0.5°"),
        (percent(0.0), "0 %"),
        (percent(5e-5), "less than 0.01 %"),
        (percent(0.0734), "7.3 %"),
        (percent(0.994), "99 %"),
        (percent(12.34), "1,234 %"),
        (percent(0.0734, 0), "7 %"),
        (percent(-0.0001, 1), "0.0 %"),
        (counted(1, "vertex", "vertices"), "1 vertex"),
        (counted(0, "vertex", "vertices"), "0 vertices"),
        (counted(1234, "sample"), "1,234 samples"),
    ],
)
def test_numerals(text, expected):
    assert text == expected


@pytest.mark.parametrize(
    ("value", "deviation", "expected"),
    [
        (535.5604, 1.558, ("535.6", "1.6")),
        (612.8579, 161.007, ("610", "160")),
        (503.4528, 192.11, ("500", "190")),
        (-533.2, 9.96, ("−533", "10")),
        (533.22, 0.0234, ("533.2", "0.023")),
        (3.0, 4321.0, ("0", "4,300")),
    ],
)
def test_a_value_has_no_digit_that_its_deviation_drowns(value, deviation, expected):
    assert plus_minus(value, deviation) == expected


@pytest.mark.parametrize("deviation", [0.0, -1.0, math.nan, math.inf])
def test_a_deviation_is_positive(deviation):
    with pytest.raises(ValueError, match="positive and finite"):
        plus_minus(1.0, deviation)


UNITS = {"km": 1e3, "m": 1.0, "mm": 1e-3, "µm": 1e-6}


@given(st.floats(1e-8, 9e8) | st.floats(-9e8, -1e-8))
def test_a_length_is_the_length_to_its_digits(metres):
    number, unit = length(metres).split(" ")
    assert read(number) * UNITS[unit] == pytest.approx(
        metres, rel=0.051 if unit == "µm" else 0.0051
    )
    assert 0.001 <= abs(read(number)) <= 1e6


@given(st.floats(0.001, 1e3))
def test_an_angle_is_the_angle_to_its_digits(degrees):
    assert read(angle(degrees).removesuffix("°")) == pytest.approx(degrees, rel=0.0051)


@given(st.floats(1e-4, 100.0))
def test_a_share_is_the_share_to_its_digits(share):
    assert read(percent(share).removesuffix(" %")) == pytest.approx(100.0 * share, rel=0.051)


def test_a_point_in_brackets_is_whole_or_none():
    assert coordinates((1.0, -2.345, 0.0), 2) == "(1.00, −2.35, 0.00)"
    assert coordinates((3.0, math.nan), 1) == "none"
    assert coordinates((-math.inf,), 1) == "none"
    assert coordinates((0.0, 3.28e9), 0) == "(0, 3.28 × 10⁹)"
