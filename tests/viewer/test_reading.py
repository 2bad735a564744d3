import pytest

from workbench.errors import InputError
from workbench.viewer.reading import number_in


@pytest.mark.parametrize(
    ("text", "value"), [("4.8", 4.8), (" 4,8 ", 4.8), ("−3", -3.0), ("1e-3", 0.001), ("0", 0.0), ("nan", None)]
)
def test_a_number_is_read_as_people_type_it(text, value):
    if value is None:
        with pytest.raises(InputError):
            number_in(text)
    else:
        assert number_in(text) == value


@pytest.mark.parametrize("text", ["", "  ", "four", "inf", "1,000.5", None, "1" * 400])
def test_an_empty_field_is_one_line_and_no_answer(text):
    with pytest.raises(InputError, match=r"^Type a number first, or skip\.$"):
        number_in(text)
