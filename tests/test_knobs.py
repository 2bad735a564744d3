from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.fake import Params
from workbench.errors import InputError
from workbench.knobs import Knob, changed, fields_of, from_json, make, only, to_json

ANYTHING = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.lists(st.floats(), max_size=4),
    st.binary(max_size=4),
)


@given(
    value=ANYTHING,
    name=st.sampled_from([f.name for f in fields_of(Params) if f.kind != "path"]),
    clamp=st.booleans(),
)
def test_whatever_comes_in_is_in_range_or_refused_in_one_line(value, name, clamp):
    field = next(f for f in fields_of(Params) if f.name == name)
    try:
        params = make(Params, {name: value}, clamp=clamp)
    except InputError as refusal:
        line = str(refusal)
        assert "\n" not in line
        assert name in line
        return
    kept = getattr(params, name)
    for part in kept if isinstance(kept, tuple) else (kept,):
        if field.kind in ("float", "int", "floats", "ints"):
            assert field.knob.low <= part <= field.knob.high
            assert isinstance(part, int) or field.kind in ("float", "floats")
    if field.kind == "choice":
        assert kept in field.choices


def test_a_number_out_of_range_is_clamped_for_browsers_and_refused_elsewhere():
    assert make(Params, {"angle": 99999}, clamp=True).angle == 180
    assert make(Params, {"steps": -3.4}, clamp=True).steps == 1
    with pytest.raises(InputError, match=r"angle = 99999: a number from 0 to 180 deg"):
        make(Params, {"angle": 99999})
    with pytest.raises(InputError, match="whole number"):
        make(Params, {"steps": 2.5})


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("angle", "nan", "a number from 0 to 180 deg"),
        ("angle", "fast", "a number"),
        ("wobble", "maybe", "true or false"),
        ("colors", "red", "one of role, field"),
        ("place", "1,2", "3 comma-separated numbers"),
        ("nothing", 1, "unknown parameter 'nothing'"),
    ],
)
def test_each_refusal_says_what_is_allowed(name, value, line):
    with pytest.raises(InputError, match=line):
        make(Params, {name: value})


def test_params_survive_json_and_name_only_what_differs():
    params = Params(angle=12.5, place=(0.1, 0.2, -2.0), scan=Path("a.npy"), wobble=True)
    assert from_json(Params, to_json(params)) == params
    assert changed(params) == {
        "angle": "12.5",
        "wobble": "True",
        "place": "0.1,0.2,-2",
        "scan": "a.npy",
    }
    assert make(Params, changed(params)) == params
    with pytest.raises(InputError, match="not a JSON object"):
        from_json(Params, "[1, 2")


@dataclass(frozen=True)
class NoRange:
    n: Annotated[int, Knob("How many")] = 3


@dataclass(frozen=True)
class NoKnob:
    n: int = 3


@dataclass(frozen=True)
class OddType:
    n: Annotated[list[int], Knob("What", 0, 1)] = ()  # type: ignore[assignment]


@dataclass
class Thawed:
    n: Annotated[Literal["a"], Knob("What")] = "a"


@pytest.mark.parametrize("owner", [NoRange, NoKnob, OddType, Thawed])
def test_a_params_class_that_cannot_be_a_panel_is_refused(owner):
    with pytest.raises(TypeError, match=owner.__name__):
        fields_of(owner)


def test_a_name_that_is_a_symbol_is_written_as_in_formulas():
    @dataclass(frozen=True)
    class Lens:
        f: Annotated[float, Knob("Focal length", 1, 9)] = 1.0
        k1: Annotated[float, Knob("Radial", -1, 1)] = 0.0
        start_angle: Annotated[float, Knob("Turned by", 0, 9)] = 0.0
        doffs: Annotated[float, Knob("Offset", 0, 9, label="doffs")] = 0.0

    assert [field.label for field in fields_of(Lens)] == ["f", "k₁", "Start angle", "doffs"]


def test_only_these_fields_differ_from_the_defaults():
    names = [field.name for field in fields_of(Params) if field.kind in ("float", "int")]
    mine = make(
        Params,
        {name: next(f for f in fields_of(Params) if f.name == name).knob.low for name in names},
    )
    assert set(changed(only(mine, names[0]))) == set(changed(mine)) & {names[0]}
    assert only(mine) == Params()
    assert only(mine, *[field.name for field in fields_of(Params)]) == mine
