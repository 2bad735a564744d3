from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, cast

import numpy as np
import pytest

from tests.fake import lesson, test_nothing_is_left_out  # noqa: F401 (collected here)
from workbench.run.timeline import Timeline
from workbench.scene import (
    Axes,
    Camera,
    Caption,
    Chart,
    Classes,
    Curve,
    Field,
    Label,
    Mesh,
    Picture,
    Points,
    Segments,
    Table,
    arrays,
    caption_of,
    color_map,
    ghost,
    in_space,
    is_rigid,
    same,
)

P = np.zeros((4, 3))
BAD = np.array([[0, 0, np.nan]])


@pytest.mark.parametrize(
    ("make", "line"),
    [
        (lambda: Points(np.zeros((3, 2))), r"\(n, 3\), not \(3, 2\)"),
        (lambda: Points(BAD), "NaN"),
        (lambda: Points(P, cast(Any, "blue")), "unknown colour role 'blue'"),
        (lambda: Points(P, np.zeros((3, 3), np.uint8)), r"\(4, 3\) uint8"),
        (lambda: Points(P, Field(np.zeros(3), 0, 1, "x")), "values for 4 items"),
        (lambda: Points(P, radius=0.0), "positive"),
        (lambda: Points(P, T_world_object=np.eye(3)), r"\(4, 4\)"),
        (lambda: Points(P, opacity=2.0), "opacity"),
        (lambda: Segments(np.zeros((2, 3))), r"\(n, 2, 3\)"),
        (lambda: Mesh(P, np.array([[0, 1, 4]])), "out of range"),
        (lambda: Mesh(P, np.zeros((0, 3), int)), "at least one face"),
        (lambda: Axes(length=0.0), "positive"),
        (lambda: Camera(np.eye(2), 4, 4), r"\(3, 3\)"),
        (lambda: Label("a", P), r"\(3,\)"),
        (lambda: Picture(np.zeros((4, 4))), "uint8"),
        (lambda: Field(P, 1.0, 0.0, "x"), "low < high"),
        (lambda: Field(P, 0.0, 1.0, "x", map="diverging"), "zero in the middle"),
        (lambda: Classes(np.array([2]), ("source",), ("a",)), "beyond the roles"),
        (lambda: Curve(np.zeros(2), np.zeros(3), "a", "b", "c"), "n > 0"),
        (lambda: Table("a", ("x", "y"), (("1",),)), "as long as"),
        (lambda: Caption("  "), "says something"),
        (lambda: caption_of({}), "needs a Caption"),
    ],
)
def test_what_cannot_be_drawn_is_refused_where_it_is_made(make, line):
    with pytest.raises(ValueError, match=line):
        make()


def test_same_tells_every_field_apart():
    scene = Timeline(lesson, lesson.params()).complete()[4].scene
    for primitive in scene.values():
        assert same(primitive, replace(primitive))
        for field in fields(primitive):
            value = getattr(primitive, field.name)
            if isinstance(value, np.ndarray) and value.dtype.kind == "f":
                assert same(primitive, replace(primitive, **{field.name: value.copy()}))
                assert not same(
                    primitive, replace(primitive, **{field.name: value * 1.001 + 0.001})
                )
            elif isinstance(value, str) and field.name in ("text", "title", "name"):
                assert not same(primitive, replace(primitive, **{field.name: value + "x"}))


def test_maps_reach_their_ends_and_the_middle_is_light():
    assert color_map("viridis", np.array([-1.0, 0.0]))[0].tolist() == [0x44, 0x01, 0x54]
    assert color_map("viridis", np.array([1.0, 5.0]))[1].tolist() == [0xFD, 0xE7, 0x25]
    assert color_map("diverging", np.array([0.5])).min() > 230
    unknown = Field(np.array([np.nan, 0.5]), 0, 1, "x").rgb()
    assert unknown[0].tolist() == [128, 128, 128]


def test_a_ghost_is_what_stands_in_space_and_fainter():
    scene = Timeline(lesson, lesson.params()).complete()[0].scene
    faint = ghost(scene, {})
    assert faint
    assert all(path.startswith("ghost/") for path in faint)
    assert all(
        in_space(primitive) or isinstance(primitive, Picture) for primitive in faint.values()
    )
    assert faint["ghost/source"].opacity < 0.5  # type: ignore[union-attr]
    assert faint["ghost/source"].p is scene["source"].p  # type: ignore[union-attr]


def test_a_ghost_leaves_out_what_did_not_move():
    first, last = (Timeline(lesson, lesson.params()).complete()[k].scene for k in (0, -1))
    paler = {
        path: replace(p, opacity=0.5) if isinstance(p, Points) else p for path, p in last.items()
    }
    assert ghost(last, paler) == {}
    assert "ghost/source" in ghost(first, last)
    assert "ghost/target" not in ghost(first, last)


def test_round_off_is_no_other_place():
    scene = Timeline(lesson, lesson.params()).complete()[3].scene
    placed: dict[str, Any] = {
        path: p for path, p in scene.items() if getattr(p, "T_world_object", None) is not None
    }
    stirred = {
        path: replace(p, T_world_object=p.T_world_object + 1e-16) for path, p in placed.items()
    }
    assert stirred
    assert ghost(stirred, scene) == {}
    frame = cast(Any, scene["frame"])
    moved = {**scene, "frame": replace(frame, T_world_object=frame.T_world_object + 1e-6)}
    assert list(ghost(moved, scene)) == ["ghost/frame"]


def test_a_ghost_hides_nothing_of_what_is_compared():
    first, last = (Timeline(lesson, lesson.params()).complete()[k].scene for k in (0, -1))
    faint = cast(Any, ghost(first, last))
    assert faint["ghost/source"].radius < 0.5 * cast(Any, first)["source"].radius
    assert "ghost/camera" not in faint  # it stands still; were it moved, it would be its frustum
    moved = {**last, "camera": replace(cast(Any, last["camera"]), T_world_object=np.eye(4))}
    assert cast(Any, ghost(first, moved)["ghost/camera"]).image is None
    other = {**last, "plane": replace(cast(Any, last["plane"]), image=np.zeros((4, 4), np.uint8))}
    assert "ghost/plane" not in ghost(first, other)


def test_a_picture_beside_the_scene_has_a_pinned_version_where_it_differs():
    first, last = (Timeline(lesson, lesson.params()).complete()[k].scene for k in (0, -1))
    faint = cast(Any, ghost(first, last))
    assert faint["ghost/beside/depth"].title == "Depth, pinned"
    assert not in_space(faint["ghost/beside/depth"])
    assert "ghost/beside/photo" not in faint


@pytest.mark.parametrize(
    ("T", "rigid"),
    [
        (np.eye(4), True),
        (np.diag([1, 1, -1, 1.0]), False),
        (np.diag([2, 2, 2, 1.0]), False),
        (np.diag([-1, -1, 1, 1.0]), True),
    ],
)
def test_rigid_means_a_rotation_and_a_translation(T, rigid):
    assert is_rigid(T) is rigid


def test_what_is_marked_has_its_role_and_the_others_theirs():
    classes = Classes.marking(
        np.array([False, True, True]), "wrong", "outlier", others=("target", "inlier")
    )
    assert [(classes.roles[i], classes.names[i]) for i in classes.ids] == [
        ("target", "inlier"),
        ("wrong", "outlier"),
        ("wrong", "outlier"),
    ]


def test_a_field_of_magnitudes_ends_where_most_values_are_reached():
    values = np.append(np.arange(100.0), [np.nan, 1e6])
    field = Field.magnitude(values, "error", "m", percent=50)
    assert (field.low, field.high) == (0, 50)
    assert Field.magnitude(np.full(3, np.nan), "error").high == 1
    assert Field.magnitude(np.zeros(3), "error").high > 0


def test_what_a_chart_makes_shares_its_plot():
    chart = Chart("error", "distance (m)", "px")
    x = np.arange(3.0)
    made = [
        chart.curve(x, x, "a", marks=(1.0,)),
        chart.dots(x, x, "b"),
        chart.histogram(np.array([0.5, 1.5, 1.6]), 2, "c"),
    ]
    assert {(curve.chart, curve.x_label, curve.y_label) for curve in made} == {
        ("error", "distance (m)", "px")
    }
    assert [curve.kind for curve in made] == ["line", "dots", "bars"]
    assert made[2].y.sum() == 3
    assert (made[2].y == [1, 2]).all()
    np.testing.assert_allclose(made[2].x, [0.775, 1.325])
    number = chart.scalar(2.0, "d", "truth", log=True)
    assert (number.chart, number.unit, number.color, number.log) == ("error", "px", "truth", True)


def test_a_matrix_is_a_table_of_its_numbers():
    assert Table.of_matrix("M", ("a", "b"), np.array([[1.0, -0.001], [2.5, 1000.0]])).rows == (
        ("1.00", "0.00"),
        ("2.50", "1,000.00"),
    )


@pytest.mark.parametrize(
    ("right", "settled", "text", "tone"),
    [
        (True, True, "End.", "good"),
        (False, True, "End. It looks settled, and it is wrong.", "wrong"),
        (False, False, "End. It is wrong.", "wrong"),
    ],
)
def test_a_verdict_says_what_only_the_truth_shows(right, settled, text, *, tone):
    caption = Caption.verdict("End.", right=right, settled=settled)
    assert (caption.text, caption.tone) == (text, tone)


def test_a_picture_in_space_knows_where_its_pixels_and_boxes_are():
    # columns right, rows down, seen along +y
    T = np.array([[1.0, 0, 0, 5], [0, 0, 1, 6], [0, -1, 0, 7], [0, 0, 0, 1]])
    picture = Picture(np.zeros((2, 4), np.uint8), width=8.0, T_world_object=T)
    assert picture.size == (4, 2)
    np.testing.assert_allclose(picture.places(np.array([0.0, 0.0])), [5 - 3, 6, 7 + 1])
    np.testing.assert_allclose(picture.places(np.array([3.0, 1.0]), 0.5), [5 + 3, 5.5, 7 - 1])
    border = picture.border(0.5)
    np.testing.assert_allclose(border.min(axis=(0, 1)), [1, 5.5, 5])
    np.testing.assert_allclose(border.max(axis=(0, 1)), [9, 5.5, 9])
    np.testing.assert_allclose(border[1:, 0], border[:-1, 1])


def test_all_arrays_are_walked_through_and_what_holds_itself_is_no_trap():
    @dataclass(frozen=True)
    class Holds:
        points: Points
        others: tuple[Any, ...]

    p, q, r = (np.full((2, 3), float(k)) for k in range(3))
    looped: list[Any] = [r]
    looped.append(looped)
    held = Holds(Points(p), ({"q": q}, "a word", 3.0, Holds, looped))
    assert sorted(array[0, 0] for array in arrays([held, held])) == [0.0, 1.0, 2.0]


def test_arrays_in_values_that_are_made_when_asked_for_are_all_found():
    class Made(Mapping):
        def __getitem__(self, k: int) -> tuple[np.ndarray, ...]:
            return (np.full(2, float(k)),)

        def __len__(self) -> int:
            return 50

        def __iter__(self) -> Iterator[int]:
            return iter(range(50))

        def values(self) -> Any:
            return (self[k] for k in self)

    assert sorted(array[0] for array in arrays([({"one": Made()},), Made()])) == sorted(
        [*range(50)] * 2
    )
