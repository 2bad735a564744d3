import pytest

from workbench.numerals import short


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (3243.2, 3, "3,240"),
        (99.96, 3, "100"),
        (0.0000321, 3, "0.0000321"),
        (-1.2345, 3, "−1.23"),
        (1e7, 3, "10,000,000"),
        (1e-12, 3, "0"),
        (12.0, 3, "12"),
        (12.345, 4, "12.35"),
    ],
)
def test_digits_that_count_and_never_an_exponent(value, digits, text):
    assert short(value, digits) == text
