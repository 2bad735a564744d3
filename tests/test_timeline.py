import threading
import weakref
from dataclasses import dataclass, replace
from typing import Annotated

import numpy as np
import pytest

from tests.fake import Params, lesson
from workbench.errors import InputError
from workbench.knobs import Knob
from workbench.lesson import Lesson
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import Caption, Points, Scalar, same


@dataclass(frozen=True)
class Bare:
    steps: Annotated[int, Knob("How many", 0, 10**7)] = 3


def bare(run, draw=None) -> Lesson:
    shown = draw or (lambda state: {"p": Points(state), "caption": Caption("A step happened")})
    return Lesson(
        name="bare", title="Bare", summary="One line", params=Bare, run=run, draw=shown, order=1
    )


def test_steps_are_computed_once_and_kept():
    timeline = Timeline(lesson, Params(steps=4))
    assert len(timeline) == 0
    assert timeline.extend()
    first = timeline[0]
    timeline.complete()
    assert timeline.finished
    assert timeline.stopped is None
    assert len(timeline) == 4
    assert timeline[0] is first
    assert timeline[-1] is timeline[3]
    assert not timeline.extend()


def test_a_state_that_is_changed_after_its_yield_raises():
    def run(params):
        p = np.zeros((4, 3))
        for _ in range(3):
            yield p
            p += 1.0

    timeline = Timeline(bare(run), Bare()).complete()
    assert len(timeline) == 1
    assert "read-only" in (timeline.stopped or "")


def test_a_view_freezes_what_it_looks_at():
    def run(params):
        p = np.zeros((4, 3))
        yield p[:2]
        p[3] = 1.0
        yield p

    assert "read-only" in (Timeline(bare(run), Bare()).complete().stopped or "")


def test_steps_and_bytes_are_bounded_and_the_reason_is_said():
    def run(params):
        while True:
            yield np.zeros((1000, 3))

    by_steps = Timeline(bare(run), Bare(), most_steps=7).complete()
    assert len(by_steps) == 7
    assert "cut after 7 steps" in (by_steps.stopped or "")
    by_bytes = Timeline(bare(run), Bare(), most_bytes=100_000).complete()
    assert len(by_bytes) == 5
    assert by_bytes.bytes == 5 * 24_000


def test_shared_arrays_are_counted_once():
    p = np.zeros((1000, 3))
    timeline = Timeline(bare(lambda params: iter([p, p, p[:10]])), Bare()).complete()
    assert timeline.bytes == p.nbytes


@pytest.mark.parametrize(
    ("trouble", "line"), [("input", "step 2 met a bad file"), ("crash", "RuntimeError: a bug")]
)
def test_a_run_that_fails_keeps_its_steps_and_says_why(trouble, line):
    timeline = Timeline(lesson, Params(trouble=trouble)).complete()
    assert len(timeline) == 2
    assert line in (timeline.stopped or "")
    assert (timeline.failure is not None) == (trouble == "crash")
    with pytest.raises(InputError, match=line):
        timeline.states()


def test_a_step_without_a_caption_is_an_error_of_the_lesson():
    timeline = Timeline(
        bare(lambda params: iter([np.zeros((1, 3))]), lambda state: {"p": Points(state)}), Bare()
    ).complete()
    assert "Caption" in (timeline.stopped or "")


def test_params_are_checked():
    with pytest.raises(InputError, match="angle"):
        Timeline(lesson, Params(angle=1e9))
    with pytest.raises(InputError, match="takes Params"):
        Timeline(lesson, Bare())


def test_series_hold_every_scalar_and_nan_where_there_is_none():
    timeline = Timeline(lesson, Params(steps=5)).complete()
    series = timeline.series()
    assert list(series) == ["error", "truth", "cost"]
    np.testing.assert_allclose(series["error"].values, [1, 0.75, 0.5, 0.25, 0])
    assert np.isnan(series["truth"].values[0])


def test_series_grow_with_the_run_and_what_was_read_before_stays():
    def late(state):
        scene = {"caption": Caption("A step happened"), "always": Scalar(state, "a", "c")}
        return scene | ({"late": Scalar(-state, "l", "c")} if state >= 150 and state % 2 else {})

    timeline = Timeline(bare(lambda params: iter(range(300)), late), Bare())
    read = []
    assert timeline.series() == {}
    while timeline.extend():
        read.append(timeline.series())
    for n, series in enumerate(read, 1):
        assert list(series) == (["always", "late"] if n > 151 else ["always"])
        np.testing.assert_array_equal(series["always"].values, np.arange(n))
        if n > 151:
            expected = [-k if k >= 150 and k % 2 else np.nan for k in range(n)]
            np.testing.assert_array_equal(series["late"].values, expected)
    with pytest.raises(ValueError, match="read-only"):
        read[-1]["late"].values[0] = 1.0


def test_series_are_read_without_a_look_at_the_steps():
    timeline = Timeline(lesson, Params(steps=5)).complete()
    timeline._steps = [None] * 5  # type: ignore[list-item]
    assert len(timeline.series()["error"].values) == 5


def test_series_are_read_while_another_thread_computes():
    timeline = Timeline(
        bare(
            lambda params: iter(range(4000)),
            lambda k: {
                "caption": Caption("A step happened"),
                "k": Scalar(k, "k", "c"),
                f"at/{k // 40}": Scalar(k, "k", "c"),
            },
        ),
        Bare(),
    )
    computing = threading.Thread(target=timeline.complete)
    computing.start()
    while computing.is_alive():
        series = timeline.series()
        if series:
            np.testing.assert_array_equal(series["k"].values, np.arange(len(series["k"].values)))
    computing.join()
    assert len(timeline.series()) == 101


def test_runs_are_shared_and_the_least_recently_used_is_dropped():
    kept = Timelines(most_runs=2)
    first = kept.get(lesson, Params())
    assert kept.get(lesson, Params()) is first
    second = kept.get(lesson, Params(angle=10))
    assert kept.get(lesson, Params()) is first
    kept.get(lesson, Params(angle=20))
    assert kept.get(lesson, Params()) is first
    assert len(kept) == 2
    assert kept.get(lesson, Params(angle=10)) is second, "who holds a run shares it, kept or not"
    gone = weakref.ref(second)
    del second
    kept.get(lesson, Params(angle=30))
    kept.get(lesson, Params(angle=40))
    assert gone() is None


def test_runs_that_somebody_holds_count():
    kept = Timelines(most_runs=1)
    held = [kept.get(lesson, Params(angle=angle)).complete() for angle in (10, 20, 30)]
    assert len(kept) == 1
    assert kept.bytes == sum(timeline.bytes for timeline in held) > 0


def test_a_run_that_is_given_up_says_why_and_keeps_its_steps():
    timeline = Timeline(lesson, Params())
    timeline.extend()
    timeline.give_up("no time")
    timeline.give_up("later")
    assert (len(timeline), timeline.finished, timeline.stopped, timeline.extend()) == (
        1,
        True,
        "no time",
        False,
    )


def test_runs_are_dropped_by_size():
    kept = Timelines(most_bytes=1)
    kept.get(lesson, Params()).complete()
    kept.get(lesson, Params(angle=10)).complete()
    kept.get(lesson, Params(angle=20))
    assert len(kept) == 1


def test_the_slot_replaces_the_function():
    flipped = Timeline(
        lesson, Params(steps=2), {"turn": lambda angle: np.diag([1, 1, -1, 1.0])}
    ).complete()
    plain = Timeline(lesson, Params(steps=2)).complete()
    assert not same(flipped[0].scene["source"], plain[0].scene["source"])
    assert same(
        replace(flipped[0].scene["source"], T_world_object=None),
        replace(plain[0].scene["source"], T_world_object=None),
    )  # type: ignore[type-var]
