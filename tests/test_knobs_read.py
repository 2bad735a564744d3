"""How a Params class is read, how its values are written, and which of them bring files along."""

from dataclasses import dataclass, make_dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest

from workbench import knobs
from workbench.errors import InputError
from workbench.knobs import Gizmo, Knob, Pick, fields_of, make


@dataclass(frozen=True)
class Params:
    """Files, and what says how they are read."""

    form: Annotated[Literal["made", "cloud", "mesh"], Knob("What is shown")] = "made"
    kind: Annotated[Literal["a", "b"], Knob("Which of them")] = "a"
    scale: Annotated[float, Knob("Metres of one unit", 0, 9, of_files=True)] = 1.0
    turn: Annotated[float, Knob("How far it turns", 0, 9)] = 1.0
    cloud: Annotated[Path | None, Knob("Points", needs={"form": ("cloud", "mesh")})] = None
    other: Annotated[
        Path | None, Knob("More", needs={"form": ("cloud", "mesh"), "kind": ("b",)})
    ] = None


def field_of(kind: Any, knob: Knob, default: Any) -> knobs.ParamField:
    made = make_dataclass("Made", [("value", Annotated[kind, knob], default)], frozen=True)
    return fields_of(made)[0]


@pytest.mark.parametrize(
    ("kind", "knob", "default", "step"),
    [
        (float, Knob("", 0, 1, step=0.25), 0.0, 0.25),
        (int, Knob("", 0, 100, step=5), 0, 5),
        (int, Knob("", 0, 1000), 0, 1),
        (tuple[int, int], Knob("", 0, 1000), (0, 0), 1),
        (float, Knob("", 0, 0.99), 0.0, 0.01),
        (float, Knob("", 0, 0.5), 0.0, 0.001),
        (float, Knob("", 0, 1), 0.0, 0.01),
        (float, Knob("", -1, 1), 0.0, 0.01),
        (float, Knob("", 50, 60), 50.0, 0.1),
        (float, Knob("", 0, 180), 0.0, 1.0),
        (float, Knob("", -10, 0), 0.0, 0.1),
        (bool, Knob(""), False, 0.01),
    ],
)
def test_a_slider_has_99_to_990_steps_unless_it_says(kind, knob, default, *, step):
    assert field_of(kind, knob, default).step == pytest.approx(step)


def test_a_handle_is_half_a_metre_unless_it_says():
    assert (Gizmo().size, Gizmo(0.2).size) == (0.5, 0.2)


@pytest.mark.parametrize("length", [2, 3, 6])
def test_a_handle_sets_a_place_or_a_pose(length):
    field = field_of(tuple[(float,) * length], Knob("", -1, 1, by=Gizmo()), (0.0,) * length)
    assert (field.kind, field.length) == ("floats", length)


@pytest.mark.parametrize(
    ("kind", "knob", "default", "line"),
    [
        (
            tuple[float, float, float, float],
            Knob("", -1, 1, by=Gizmo()),
            (0.0,) * 4,
            "a Gizmo sets",
        ),
        (tuple[int, int, int], Knob("", -1, 1, by=Gizmo()), (0,) * 3, "a Gizmo sets"),
        (float, Knob("", -1, 1, by=Gizmo()), 0.0, "a Gizmo sets"),
        (tuple[float, float], Knob("", -1, 1, by=Pick("cloud")), (0.0, 0.0), "a Pick sets"),
        (tuple[float, int], Knob("", 0, 1), (0.0, 0), "is none of"),
        (tuple[()], Knob("", 0, 1), (), "is none of"),
        (tuple[str, str], Knob("", 0, 1), ("", ""), "is none of"),
        (Path | str, Knob(""), "", "is none of"),
        (Literal["a", 1], Knob(""), "a", "is none of"),
        (float, Knob("", 1, 1), 1.0, "low < high"),
        (int, Knob("", None, 1), 1, "low < high"),
        (int, Knob("", 0, None), 1, "low < high"),
    ],
)
def test_what_cannot_be_a_control_is_refused(kind, knob, default, *, line):
    with pytest.raises(TypeError, match=line):
        field_of(kind, knob, default)


def test_a_field_needs_a_default():
    made = make_dataclass("Made", [("value", Annotated[float, Knob("", 0, 1)])], frozen=True)
    with pytest.raises(TypeError, match=r"Made\.value: needs a default"):
        fields_of(made)


def test_only_files_are_kept_from_browsers():
    assert [field.name for field in fields_of(Params) if field.sensitive] == ["cloud", "other"]
    assert knobs.paths_of(Params) == ["cloud", "other"]


@pytest.mark.parametrize(
    ("knob", "value", "line"),
    [
        (Knob("", 0, 2, unit="m"), "x", "value = 'x': a number from 0 to 2 m"),
        (Knob("", 0, 2), "x", "value = 'x': a number from 0 to 2"),
        (Knob("", 0, 2), 3.0, "value = 3: a number from 0 to 2"),
        (Knob("", 0, 2), "x" * 38, f"value = '{'x' * 38}': a number from 0 to 2"),
        (Knob("", 0, 2), "x" * 39, f"value = '{'x' * 38}…: a number from 0 to 2"),
    ],
)
def test_a_refusal_shows_the_value_and_the_range(knob, value, line):
    with pytest.raises(InputError) as refused:
        field_of(float, knob, 0.0).clean(value)
    assert str(refused.value) == line


# files --------------------------------------------------------------------------------------------


def test_own_files_come_along_with_what_says_how_to_read_them():
    mine = Params(cloud=Path("a"), scale=2.0, turn=3.0)
    assert knobs.with_own_files(Params(turn=5.0), mine) == Params(
        cloud=Path("a"), scale=2.0, turn=5.0
    )
    theirs = Params(cloud=Path("b"), scale=4.0)
    assert knobs.with_own_files(theirs, mine) == theirs
    assert knobs.with_own_files(Params(turn=5.0), Params(scale=2.0)) == Params(turn=5.0)


@pytest.mark.parametrize(
    ("params", "files", "shown"),
    [
        (Params(), [], Params()),
        (Params(), ["cloud"], Params()),
        (Params(cloud=Path("a")), ["cloud"], Params(form="cloud", cloud=Path("a"))),
        (Params(cloud=Path("a")), [], Params(cloud=Path("a"))),
        (Params(form="mesh", cloud=Path("a")), ["cloud"], Params(form="mesh", cloud=Path("a"))),
        (Params(other=Path("a")), ["other"], Params(form="cloud", kind="b", other=Path("a"))),
        (
            Params(form="mesh", other=Path("a")),
            ["other"],
            Params(form="mesh", kind="b", other=Path("a")),
        ),
    ],
)
def test_a_file_opens_what_shows_it(params, files, shown):
    assert knobs.showing(params, files) == shown


def test_a_choice_that_hides_the_file_is_refused_in_the_words_of_the_reader():
    with pytest.raises(InputError) as refused:
        knobs.showing(Params(cloud=Path("a")), ["cloud"], kept=["form"])
    message = str(refused.value)
    assert message == "“cloud” is read where “form” is cloud or mesh"
    assert knobs.in_words(message, Params) == "“Cloud” is read where “Form” is cloud or mesh"
    with knobs.called_by_flags():
        assert knobs.in_words(message, Params) == "--cloud is read where --form is cloud or mesh"
        assert knobs.in_words("“nobody”", Params) == "“nobody”"
    assert knobs.in_words(message, Params) == "“Cloud” is read where “Form” is cloud or mesh"


@dataclass(frozen=True)
class Long:
    """A name of several words."""

    max_turn_of: Annotated[float, Knob("", 0, 1)] = 0.5


def test_a_flag_has_hyphens_wherever_a_name_has_underscores():
    with knobs.called_by_flags():
        assert knobs.in_words(knobs.called("max_turn_of"), Long) == "--max-turn-of"
    assert knobs.in_words(knobs.called("max_turn_of"), Long) == "“Max turn of”"


def test_values_are_made_on_top_of_others():
    assert make(Params, {"turn": 2}, base=Params(scale=3.0)) == Params(turn=2.0, scale=3.0)
    with pytest.raises(InputError, match="unknown parameter 'trun'"):
        make(Params, {"trun": 2})
