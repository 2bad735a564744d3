"""What a timeline has beside its steps: sizes, where it opens, notes, its line, its plot."""

import dataclasses
from collections.abc import Iterator

import numpy as np
import pytest

from tests.fake import Params, lesson
from workbench.errors import AuthorError
from workbench.run.series import plotted_values
from workbench.run.timeline import MOST_BYTES, Timeline, Timelines
from workbench.scene import Caption, Label, Primitive, Scalar


def finished(**params) -> Timeline:
    return Timeline(lesson, Params(**params)).complete()


def test_what_is_owned_adds_up_to_its_bytes():
    timeline = finished(points=50)
    owned = timeline.owned()
    assert sum(owned.values()) == timeline.bytes > 0
    held = [value for step in timeline for value in vars(step.state).values()]
    arrays = [value for value in held if isinstance(value, np.ndarray) and value.base is None]
    assert arrays
    assert all(owned[id(array)] == array.nbytes for array in arrays)


def test_a_run_opens_at_a_step_or_counts_from_the_end():
    timeline = finished(steps=4)
    assert [timeline.opening("x", step) for step in range(-4, 4)] == [0, 1, 2, 3, 0, 1, 2, 3]
    for step in (-5, 4):
        with pytest.raises(AuthorError, match=f"x opens at step {step}, but its run has 4 steps"):
            timeline.opening("x", step)


def test_a_run_that_goes_on_opens_where_it_can():
    timeline = Timeline(lesson, Params(steps=4))
    timeline.extend()
    timeline.extend()
    assert [timeline.opening("x", step) for step in (-3, -2, -1, 0, 1, 7)] == [0, 0, 1, 0, 1, 7]


def test_a_run_says_at_which_line_it_is():
    moments = [step.moment for step in finished()]
    assert all(moment is not None for moment in moments)

    def run(params: Params) -> Iterator[int]:
        yield from range(params.steps)

    plain = dataclasses.replace(
        lesson, run=run, draw=lambda k: {"caption": Caption(str(k))}, presets=(), questions=()
    )
    steps = Timeline(plain, Params(steps=3, angle=1.0)).complete()
    assert [step.moment is not None and step.moment.line for step in steps] == [
        run.__code__.co_firstlineno + 1
    ] * 3


def test_notes_of_own_files_stand_in_the_first_caption_alone(monkeypatch, tmp_path):
    path = tmp_path / "scan.npy"
    np.save(path, np.zeros((5, 3)))
    monkeypatch.setattr(
        "workbench.run.timeline.told", lambda own: [f"{own.name}: 2 rows left out."]
    )
    captions = [step.caption.text for step in finished(scan=path, steps=3)]
    assert [caption.endswith("scan.npy: 2 rows left out.") for caption in captions] == [
        True,
        False,
        False,
    ]


def without(path: str, **others: Primitive) -> Timeline:
    def draw(state) -> dict:
        return {
            key: primitive for key, primitive in lesson.draw(state).items() if key != path
        } | others

    return Timeline(dataclasses.replace(lesson, draw=draw), Params()).complete()


def test_what_is_picked_has_to_be_shown_and_clickable():
    assert finished().stopped is None
    assert "shows nothing at 'plane'" in str(without("plane").stopped)
    label = next(
        primitive for primitive in finished()[-1].scene.values() if isinstance(primitive, Label)
    )
    assert "a Label at 'plane'" in str(without("plane", plane=label).stopped)


def test_a_plot_is_of_logarithms_where_the_scalar_says():
    values = np.array([100.0, 0.05, 1e-12, 0.0, -1.0, np.nan])
    plain = Scalar(1.0, "e", "e")
    log = Scalar(1.0, "e", "e", log=True)
    np.testing.assert_array_equal(plotted_values(plain, values), values)
    np.testing.assert_allclose(
        plotted_values(log, values), [2.0, np.log10(0.05), -12.0, np.nan, np.nan, np.nan]
    )
    assert plotted_values(plain, [1, 2]).dtype == float  # type: ignore[arg-type]


def test_the_oldest_run_is_dropped_until_none_is_left():
    timelines = Timelines()
    kept = [timelines.get(lesson, Params(angle=angle)) for angle in (1.0, 2.0)]
    assert len(timelines) == 2
    assert timelines.drop()
    assert len(timelines) == 1
    assert timelines.get(lesson, Params(angle=2.0)) is kept[1]
    assert timelines.drop()
    assert (timelines.drop(), len(timelines)) == (False, 0)


def test_a_run_may_hold_half_a_gigabyte():
    assert MOST_BYTES == 512 * 2**20
