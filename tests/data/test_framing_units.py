"""A unit is worth as many metres as everywhere."""

import pytest

from workbench.data.framing import METRES


@pytest.mark.parametrize(("unit", "metres"), [("m", 1), ("cm", 1e-2), ("mm", 1e-3), ("km", 1e3)])
def test_a_unit_in_metres(unit, metres):
    assert METRES[unit] == metres


def test_no_other_unit_is_known():
    assert set(METRES) == {"m", "cm", "mm", "km"}
