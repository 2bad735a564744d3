"""The Rerun sink makes the stream equal to a scene: whatever was shown before leaves no trace, and
little is sent.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests import fake
from tests.fake import test_nothing_is_left_out as test_nothing_is_left_out
from tests.recording.latest_at import rows, shown_at
from workbench.recording.chart import Canvas
from workbench.recording.contents import contents_of
from workbench.recording.sink import RerunSink, legend_of
from workbench.recording.spatial import FADED
from workbench.recording.streams import stream_bytes
from workbench.scene import (
    PALETTE,
    Axes,
    Camera,
    Classes,
    Field,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
    Table,
)


def recorded(scenes: list[Scene], path: Path) -> Path:
    def fill(stream) -> None:
        sink = RerunSink(stream)
        for k, scene in enumerate(scenes):
            sink.show(k, scene)

    path.write_bytes(stream_bytes("workbench-test", fill))
    return path


def fake_scenes(colors: str = "field") -> list[Scene]:
    params = fake.Params(points=20, colors=colors)  # type: ignore[arg-type]
    return [fake.draw(state) for state in fake.run(params)]


SCENES = [
    scene for colors in ("role", "field", "classes", "measured") for scene in fake_scenes(colors)
]


@given(st.lists(st.integers(0, len(SCENES) - 1), min_size=1, max_size=4))
@settings(max_examples=12, deadline=None)
def test_showing_one_scene_after_others_leaves_exactly_it(tmp_path_factory, order):
    folder = tmp_path_factory.mktemp("sink")
    history = recorded([SCENES[i] for i in order], folder / "history.rrd")
    for k, i in enumerate(order):
        alone = recorded([SCENES[i]], folder / "alone.rrd")
        assert shown_at(history, k) == shown_at(alone, 0)


class Heard:
    """A stream that keeps where something was logged, in order."""

    def __init__(self):
        self.where: list[str] = []

    def set_time(self, *_args, **_kwargs) -> None:
        pass

    def log(self, where: str, *_said, **_kwargs) -> None:
        self.where.append(where)


def test_what_is_gone_is_said_in_the_order_in_which_it_came():
    stream = Heard()
    sink = RerunSink(stream)
    sink.show(
        0,
        {
            path: primitive
            for path, primitive in SCENES[2].items()
            if not isinstance(primitive, Table)
        },
    )
    came = [
        where
        for where in dict.fromkeys(stream.where)
        if not where.startswith("/legend") and where != "/world"
    ]
    assert any(where.endswith("/frame") for where in came)
    stream.where.clear()
    sink.show(1, {"caption": SCENES[2]["caption"]})
    gone = [where for where in stream.where if where in came]
    assert gone == [where for where in came if where in gone]
    assert {where for where in came if where.startswith("/charts")} <= set(gone)


def test_everything_in_a_scene_is_shown(tmp_path):
    scene = SCENES[2]
    shown = shown_at(recorded([scene], tmp_path / "a.rrd"), 0)
    for path in (
        "source",
        "target",
        "box",
        "pulled",
        "wire",
        "frame",
        "camera",
        "eye",
        "word",
        "plane",
        "pairs",
        "late",
    ):
        assert f"/world/{path}" in shown
    assert "/world/camera/image" in shown
    assert "/world/eye/image" not in shown
    assert {
        "/pictures/beside\\/depth/image",
        "/pictures/beside\\/depth/bar",
        "/pictures/beside\\/photo/image",
    } <= set(shown)
    assert {
        "/charts/Basin/curves",
        "/charts/Basin/frame",
        "/charts/Histogram/curves",
        "/tables",
        "/legend/bar0",
    } <= set(shown)


def test_a_moved_cloud_is_sent_once_and_then_only_its_pose(tmp_path):
    path = recorded(fake_scenes(), tmp_path / "a.rrd")
    sent = [components for _, _, entity, components in rows(path) if entity == "/world/source"]
    assert len(sent) == 6
    assert "Points3D:positions" in sent[0]
    for components in sent[1:]:
        assert set(components) == {"Transform3D:mat3x3", "Transform3D:translation"}


def test_points_that_move_by_themselves_are_sent_again(tmp_path):
    scenes = [fake.draw(state) for state in fake.run(fake.Params(points=20, wobble=True))]
    sent = [
        components
        for _, _, entity, components in rows(recorded(scenes, tmp_path / "a.rrd"))
        if entity == "/world/source"
    ]
    assert all("Points3D:positions" in components for components in sent)


def test_a_scene_shown_twice_sends_nothing(tmp_path):
    once = recorded(SCENES[:1], tmp_path / "1.rrd")
    twice = recorded(SCENES[:1] * 2, tmp_path / "2.rrd")
    assert len(rows(once)) == len(rows(twice))


def test_changed_classes_send_ids_and_no_places(tmp_path):
    p = np.random.default_rng(0).normal(size=(50, 3))
    half = Classes((p[:, 0] > 0).astype(int), ("source", "wrong"), ("inlier", "outlier"))
    most = replace(half, ids=(p[:, 0] > -1).astype(int))
    path = recorded([{"p": Points(p, half)}, {"p": Points(p, most)}], tmp_path / "a.rrd")
    sent = [components for _, _, entity, components in rows(path) if entity == "/world/p"]
    assert set(sent[1]) == {"Points3D:class_ids"}
    wrong = [
        colored
        for colored in shown_at(path, 1)["/world/p"]["Points3D:class_ids"]
        if colored[0] == "outlier"
    ]
    assert len(wrong) == int((p[:, 0] > -1).sum())
    assert all(rgb(color) == PALETTE["wrong"] for _, color in wrong)


def test_a_surface_that_gets_colours_forgets_its_own(tmp_path):
    """Rerun multiplies the colour of a surface with those of its vertices."""
    height = Field(fake.CORNERS[:, 2], -0.2, 0.2, "height", "m", "diverging")
    plain = Mesh(fake.CORNERS, fake.FACES, "neutral")
    coloured = Mesh(fake.CORNERS, fake.FACES, height)
    path = recorded([{"m": plain}, {"m": coloured}, {"m": plain}], tmp_path / "a.rrd")
    kinds = [
        {"Mesh3D:albedo_factor", "Mesh3D:vertex_colors"} & set(shown_at(path, k)["/world/m"])
        for k in range(3)
    ]
    assert kinds == [{"Mesh3D:albedo_factor"}, {"Mesh3D:vertex_colors"}, {"Mesh3D:albedo_factor"}]


def test_a_motion_that_is_not_rigid_is_kept(tmp_path):
    T = np.array([[1, 0.5, 0, 1], [0, 2, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1.0]])
    shown = shown_at(
        recorded([{"m": Mesh(fake.CORNERS, fake.FACES, T_world_object=T)}], tmp_path / "a.rrd"), 0
    )["/world/m"]
    R = np.array(shown["Transform3D:mat3x3"][0]).reshape(3, 3).T  # columns first
    np.testing.assert_allclose(R, T[:3, :3])
    np.testing.assert_allclose(shown["Transform3D:translation"][0], T[:3, 3])


@pytest.mark.parametrize("kind", ["points", "segments"])
def test_a_projective_motion_is_applied_to_the_points(tmp_path, kind):
    T = np.eye(4)
    T[3] = (0.1, 0.0, 0.2, 1.5)
    ends = np.random.default_rng(0).uniform(-1, 1, (4, 2, 3))
    primitive = (
        Points(ends[:, 0], T_world_object=T)
        if kind == "points"
        else Segments(ends, T_world_object=T)
    )
    shown = shown_at(recorded([{"x": primitive}], tmp_path / "a.rrd"), 0)["/world/x"]
    w = ends @ T[3, :3] + T[3, 3]
    expected = ends / w[..., None]
    if kind == "points":
        np.testing.assert_allclose(shown["Points3D:positions"], expected[:, 0], rtol=1e-6)
    else:
        np.testing.assert_allclose(shown["LineStrips3D:strips"], expected, rtol=1e-6)


def test_faint_points_are_mixed_with_grey_and_faint_surfaces_are_transparent(tmp_path):
    scene = {
        "p": Points(np.zeros((1, 3)), "target", opacity=0.5),
        "m": Mesh(fake.CORNERS, fake.FACES, "target", opacity=0.5),
    }
    shown = shown_at(recorded([scene], tmp_path / "a.rrd"), 0)
    between = [round((a + b) / 2) for a, b in zip(PALETTE["target"], FADED, strict=True)]
    assert list(rgb(shown["/world/p"]["Points3D:colors"][0])) == between
    assert shown["/world/m"]["Mesh3D:albedo_factor"][0] & 255 == 128


def test_an_empty_cloud_and_no_segments_are_fine(tmp_path):
    scene = {"p": Points(np.empty((0, 3))), "s": Segments(np.empty((0, 2, 3)))}
    shown = shown_at(recorded([scene], tmp_path / "a.rrd"), 0)
    assert shown["/world/p"]["Points3D:positions"] == []
    assert shown["/world/s"]["LineStrips3D:strips"] == []


def test_a_thing_in_a_folder_does_not_move_with_its_neighbour(tmp_path):
    scene = {
        "a": Points(np.zeros((1, 3)), T_world_object=fake.turn_about_z(1.0)),
        "a/b": Points(np.zeros((1, 3))),
    }
    shown = shown_at(recorded([scene], tmp_path / "a.rrd"), 0)
    assert set(shown) >= {"/world/a", "/world/a\\/b"}  # a part of its own: no child of /world/a


def test_a_camera_that_loses_its_image_shows_none(tmp_path):
    camera = Camera(fake.K, 64, 48, image=fake.PHOTO)
    path = recorded([{"c": camera}, {"c": replace(camera, image=None)}], tmp_path / "a.rrd")
    assert "/world/c/image" in shown_at(path, 0)
    assert "/world/c/image" not in shown_at(path, 1)


def test_another_kind_of_thing_at_a_path_leaves_nothing_of_the_one_before(tmp_path):
    p = np.eye(3)
    things = [
        Points(p, "source"),
        Segments(np.zeros((3, 2, 3)), "source"),
        Mesh(p, np.array([[0, 1, 2]]), "source"),
        Mesh(p, np.array([[0, 1, 2]]), "source", wireframe=True),
        Axes(name="frame"),
        Axes(),
        Camera(fake.K, 64, 48, color="source"),
        Points(p, "source"),
    ]
    alone = [shown_at(recorded([{"x": thing}], tmp_path / "alone.rrd"), 0) for thing in things]
    for order in (range(len(things)), range(len(things) - 1, -1, -1)):
        path = recorded([{"x": things[i]} for i in order], tmp_path / "history.rrd")
        for k, i in enumerate(order):
            assert shown_at(path, k) == alone[i], f"{things[i]} as number {k}"


def test_what_is_not_there_at_every_step_is_announced(tmp_path):
    def fill(stream) -> None:
        sink = RerunSink(
            stream,
            {
                "/charts/Basin": Canvas("Basin", 20.0, 20.0, 1),
                "/tables": Canvas("Numbers", 0.0, 0.0, 1),
            },
        )
        sink.show(0, {})
        sink.show(1, SCENES[0])
        sink.show(2, {})

    path = tmp_path / "a.rrd"
    path.write_bytes(stream_bytes("workbench-test", fill))
    assert shown_at(path, 0)["/charts/Basin"]["Points2D:labels"] == ["from step 1 on"]
    assert shown_at(path, 0)["/tables"]["TextDocument:text"] == ["from step 1 on"]
    assert "/charts/Basin" not in shown_at(path, 1)
    assert "/charts/Basin/curves" in shown_at(path, 1)
    assert "from step" not in shown_at(path, 1)["/tables"]["TextDocument:text"][0]
    assert shown_at(path, 2)["/charts/Basin"]["Points2D:labels"] == ["not in this step"]
    assert shown_at(path, 2)["/tables"]["TextDocument:text"] == ["not in this step"]


def test_what_is_beside_the_scene_is_known_with_its_first_step():
    table = Table("Numbers", ("a",), (("1",),))
    canvases = contents_of([{}, SCENES[0], {"t": table}, {"t": table}]).canvases
    assert {"/charts/Basin", "/pictures/beside\\/photo", "/tables"} <= canvases.keys()
    assert all(canvas.first == 1 for canvas in canvases.values())
    late = contents_of([{}, {}, {"t": table}]).canvases
    assert late == {"/tables": Canvas("Numbers", 0.0, 0.0, 2)}


def rgb(color: int) -> tuple[int, int, int]:
    return color >> 24, color >> 16 & 255, color >> 8 & 255


def test_a_picture_of_a_field_in_space_has_its_bar_in_the_legend():
    field = Field(np.zeros((2, 3)), 0.0, 31.0, "Disparity", "px")
    standing = Picture(field, width=1.0)
    beside = Picture(field)
    assert legend_of({"map": standing, "map/beside": beside}) == ((), [field])
    assert legend_of({"map": beside}) == ((), [])  # it has a bar of its own
