"""Curves of one chart go through their own points and no others; every home shares the axes."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tests import fake
from workbench.page.charts import chart_of, outline, series_of
from workbench.page.plots import line_of, plot_of
from workbench.page.steps import Steps
from workbench.run.series import Series
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Chart, Curve, Scalar


def curve(x, y, kind: Any = "line") -> Curve:
    return Curve(np.array(x, float), np.array(y, float), "a", "chart", "x", "y", kind=kind)


@pytest.mark.parametrize(
    "kinds", [("line", "line"), ("bars", "line"), ("bars", "bars"), ("dots", "line")]
)
def test_two_curves_of_a_chart_keep_their_own_points_and_gaps(kinds):
    given = [([3, 0, 1], [1, 2, float("nan")], kinds[0]), ([0.5, 2.5], [4, 3], kinds[1])]
    first, second = chart_of([curve(*arguments) for arguments in given])["curves"]
    assert (first["x"], first["y"], first["kind"]) == ([0, 1, 3], [2, None, 1], kinds[0])
    assert (second["x"], second["y"], second["kind"]) == ([0.5, 2.5], [4, 3], kinds[1])


def test_bars_stand_on_zero_at_their_own_x_with_their_own_heights():
    x, y = outline(curve([2, 0, 1], [7, 3, np.nan], "bars"))
    np.testing.assert_allclose(x.reshape(-1, 4).mean(1), [0, 2])
    np.testing.assert_array_equal(y, [0, 3, 3, 0, 0, 7, 7, 0])
    assert (x.reshape(-1, 4)[:, 3] - x.reshape(-1, 4)[:, 0] < 1.0).all()
    x, _ = outline(curve([5], [2], "bars"))
    assert x.min() < 5 < x.max()


def test_a_logarithmic_chart_shows_the_numbers_and_keeps_its_mark_on_the_axis():
    chart = Chart("Chance", unit="%", y_range=(0.1, 100.0), log=True)
    x = np.arange(4.0)
    kept: list[dict[str, Any]] = []

    def keep(curve: Curve) -> int:
        kept.append(line_of(curve))
        return len(kept) - 1

    parts = [chart.whole(x, np.array([100.0, 10.0, 1.0, 0.0]), "c"), chart.mark(3.0, 0.0, "m")]
    plot = plot_of([*parts, chart.band(2.0, 3.0, "low")], keep)
    assert (plot["y"]["low"], plot["y"]["high"]) == (-1.0, 2.0)
    assert plot["y"]["words"] == ("0.1", "1", "10", "100")
    assert kept[plot["whole"][0]]["y"] == [2, 1, 0, None]
    assert plot["marks"][0]["y"] == -1
    assert plot["log"]
    assert "log" not in plot_of([Chart("Chance").whole(x, x, "c")], keep)
    with pytest.raises(ValueError, match="above zero"):
        Chart("Chance", y_range=(0.0, 1.0), log=True)


def test_a_scalar_is_sent_as_it_is_for_a_number_that_was_rounded_is_not_rounded_again():
    """0.371500004 is 0.372; of six digits, 0.371500, a browser makes 0.371."""

    def draw(state):
        return {
            "off": Scalar(0.371500004, "error", "Error", "deg"),
            "caption": Caption("The error is 0.372°."),
        }

    timeline = Timeline(replace(fake.lesson, draw=draw), fake.Params(steps=1, points=3)).complete()
    assert Steps(timeline).whole()["series"][0]["values"][0] == 0.371500004


def test_round_off_is_zero_in_what_is_plotted_recorded_and_published():
    def draw(state):
        return {
            "off": Scalar(
                2.84e-14 * (state.k + 1), "median pixel error", "Error to the true picture", "px"
            ),
            "caption": Caption("Nothing but round-off."),
        }

    timeline = Timeline(replace(fake.lesson, draw=draw), fake.Params(steps=3, points=3)).complete()
    assert timeline.series()["off"].values.tolist() == [0.0, 0.0, 0.0]
    data = Steps(timeline).whole()
    assert data["series"][0]["values"] == [0.0, 0.0, 0.0]
    chart = data["charts"]["Error to the true picture"]
    assert chart["y"]["words"] == ("0", "0.5", "1.0")
    assert chart["head"] == "Error to the true picture"
    assert chart["yLabel"] == "px"


def test_a_value_over_the_steps_is_rounded_once_where_it_is_read():
    mean = 5.694998344433385  # 5.69 in a caption; by way of 5.69500 a tile would say 5.7
    told = series_of(
        {"mean": Series(Scalar(mean, "mean", "Error", unit="°"), np.array([mean, np.nan]))}
    )
    assert told[0]["values"] == [mean, None]
