"""What a recording's layout asks of the viewer, held against what the viewer makes of it."""

import numpy as np
import pytest
import rerun.blueprint as rrb

from workbench.lesson import View, catalog
from workbench.recording.chart import Canvas
from workbench.recording.contents import Contents
from workbench.recording.layout import HALF_TITLE, RERUN_FOV, one_run, scene_view
from workbench.scene import Scalar

SEEN = {
    "down": View(eye=(0.0, 0.0, 4.0)),
    "down beside the origin": View(eye=(1.0, -2.0, 3.0), target=(1.0, -2.0, 0.5)),
    "nearly down": View(eye=(0.02, 0.0, 4.0)),
    "up": View(eye=(1.0, 2.0, -3.0), target=(1.0, 2.0, 0.0)),
    "down, y up": View(eye=(0.0, 5.0, 0.0), up=(0.0, 1.0, 0.0)),
    "down, -y up": View(eye=(0.0, -5.0, 0.0), up=(0.0, -2.0, 0.0)),
    "down, x up": View(eye=(5.0, 0.0, 0.0), up=(1.0, 0.0, 0.0)),
    "ahead": View(eye=(0.0, -3.0, 0.7), target=(0.0, 0.0, 0.7)),
} | {
    f"{lesson.name} {i}": view
    for lesson in catalog().values()
    for i, view in enumerate(
        dict.fromkeys([lesson.view, *(preset.view or lesson.view for preset in lesson.presets)])
    )
}


def picture(ahead, up) -> tuple[np.ndarray, np.ndarray]:
    """Return what is on the right and what is up in a picture, as a camera's look-at has it."""
    right = np.cross(ahead, up)
    right /= np.linalg.norm(right)
    return right, np.cross(right, ahead)


def viewer_up(ahead, eye_up) -> np.ndarray:
    """Return the up that Rerun's viewer takes (`EyeController::up` of its eye.rs): its own, looking
    along it.
    """
    right = (
        np.array([1.0, 0.0, 0.0]) if abs(ahead[2]) > 0.9999 else np.cross(ahead, [0.0, 0.0, 1.0])
    )
    own = np.cross(ahead, right)
    given = eye_up / np.linalg.norm(eye_up)
    return own / np.linalg.norm(own) if abs(given @ ahead) > 0.9999 else given


@pytest.mark.parametrize("view", SEEN.values(), ids=SEEN)
def test_a_recording_is_seen_the_way_round_in_which_the_page_shows_it(view):
    eye = scene_view("", view, "").properties["EyeControls3D"]
    position, target, eye_up = (
        np.array(component.as_arrow_array().to_pylist()[0], float)
        for component in (eye.position, eye.look_target, eye.eye_up)
    )
    away = position - target
    page_away = view.seen_from() - np.array(view.target)
    ahead, page_ahead = -away / np.linalg.norm(away), -page_away / np.linalg.norm(page_away)
    right, upwards = picture(ahead, viewer_up(ahead, eye_up))
    page_right, page_upwards = picture(page_ahead, np.array(view.up))
    np.testing.assert_allclose(right, page_right, atol=1e-3)
    np.testing.assert_allclose(upwards, page_upwards, atol=0.02)
    half_height = np.linalg.norm(away) * np.tan(np.radians(RERUN_FOV) / 2)
    page_half_height = np.linalg.norm(page_away) * np.tan(np.radians(view.fov_degrees) / 2)
    assert half_height == pytest.approx(page_half_height, rel=1e-3)


@pytest.mark.parametrize(("length", "at_once"), [(HALF_TITLE, 2), (HALF_TITLE + 1, 1)])
def test_charts_stand_beside_each_other_where_their_titles_can_be_read(length, at_once):
    titles = ["A".ljust(length, "x"), "B".ljust(length, "x")]
    charts = {f"/charts/{title}": Canvas(title, 100.0, 60.0, 0) for title in titles}
    column = one_run(View(), Contents(canvases=charts), {"a": np.zeros(3)}).root_container.contents[
        1
    ]
    rows = column.contents[0].contents if at_once == 2 else column.contents
    assert [view.name for view in rows] == titles


@pytest.mark.parametrize(
    ("values", "corner"),
    [
        (np.linspace(1.0, 0.0, 40), "RightTop"),
        (np.linspace(0.0, 1.0, 40), "LeftTop"),
        (np.append(np.linspace(0.0, 1.0, 10), np.ones(30)), "RightBottom"),
        (np.append(np.ones(30), np.linspace(1.0, 0.0, 10)), "LeftBottom"),
    ],
)
def test_the_legend_of_a_plot_stands_where_no_curve_runs(values, corner):
    contents = Contents(
        scalars={"a": {"a": Scalar(0.5, "a", chart="a")}, "b": {"b": Scalar(0.5, "b", chart="b")}}
    )
    first, _ = (
        one_run(View(), contents, {"a": values, "b": np.zeros(40)})
        .root_container.contents[1]
        .contents
    )
    stands = first.properties["PlotLegend"].corner.as_arrow_array().to_pylist()
    assert stands == [getattr(rrb.Corner2D, corner).value]


def test_the_unit_of_a_plot_reads_well_and_its_lowest_value_stands_clear_of_the_first_step():
    share = Scalar(0.5, "a", chart="a", unit="of the whole", log=True)
    contents = Contents(scalars={"a": {"a": share}, "b": {"b": Scalar(0.5, "b", chart="b")}})
    values = {"a": np.array([1.0, 0.1]), "b": np.array([0.0, 4.0])}
    first, second = one_run(View(), contents, values).root_container.contents[1].contents
    assert first.name == "a (of the whole, as a power of ten)"
    low, high = second.properties["ScalarAxis"].range.as_arrow_array().to_pylist()[0]
    assert low <= -0.05 * high
