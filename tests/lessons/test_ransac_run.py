"""The pieces of a RANSAC run: the functions in its slots, every model and score, and what is
drawn.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.ransac import presets, widths
from lessons.ransac.captions import caption
from lessons.ransac.inputs import Input
from lessons.ransac.lesson import lesson, setup
from lessons.ransac.lesson import run as run_on
from lessons.ransac.questions import first
from lessons.ransac.rows import rows_of
from lessons.ransac.search import chosen_sample
from lessons.ransac.shapes import outline
from tests.lessons.ransac_runs import (
    best,
    best_error,
    end,
    ends_right,
    part,
    rivals,
    states_of,
    truth_of,
)
from workbench.algorithms.robust.models import MODELS
from workbench.algorithms.robust.ransac import iterations_needed
from workbench.algorithms.robust.scores import count_inliers
from workbench.errors import InputError
from workbench.exercise.driven import driven
from workbench.exercise.finding import exercises_of
from workbench.geometry.shapes.lines_planes import plane_from_points
from workbench.lesson import Look
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Classes, Points, Segments


def run(params, **slots) -> Any:
    return run_on(params, setup(params), **slots)


def test_the_student_functions_drive_the_run():
    calls = {"plane": 0, "count": 0, "needed": 0}

    def plane(p):
        calls["plane"] += 1
        return plane_from_points(p)

    def count(plane, p, inlier_distance):
        calls["count"] += 1
        return count_inliers(plane, p, inlier_distance)

    def needed(inlier_ratio, sample_size, confidence):
        calls["needed"] += 1
        return iterations_needed(inlier_ratio, sample_size, confidence)

    ours = list(run(Input(steps="every part")))
    theirs = list(
        run(
            Input(steps="every part"),
            plane_from_points=plane,
            count_inliers=count,
            iterations_needed=needed,
        )
    )
    assert len(ours) == len(theirs)
    np.testing.assert_array_equal(best(end(ours)).estimate, best(end(theirs)).estimate)
    assert calls["plane"] == end(ours).iteration
    assert calls["count"] >= calls["plane"]
    assert calls["needed"] == sum(state.phase == "best" for state in ours)


def test_wrong_functions_have_the_effect_they_deserve():
    horizontal = list(run(Input(), plane_from_points=lambda p: np.array([0.0, 0.0, 1.0, -p[0, 2]])))
    assert best([s for s in horizontal if s.phase == "best"][-1]).estimate[2] == 1.0
    turned_round = list(
        run(
            Input(),
            count_inliers=lambda plane, p, t: int(np.sum(np.abs(p @ plane[:3] + plane[3]) > t)),
        )
    )
    worst = [s for s in turned_round if s.phase == "best"][-1].best.estimate
    assert setup(Input()).error(worst) > 0.2
    hasty = end(run(Input(seed=3), iterations_needed=lambda w, m, p: 1))
    assert hasty.iteration <= 2


def test_a_count_decides_what_is_best_and_how_many_samples_follow():
    def tenfold(plane, p, inlier_distance):
        return 10 * count_inliers(plane, p, inlier_distance)

    for score in ("count", "MSAC"):
        ours = first(run(Input(score=score)), "best")
        theirs = first(run(Input(score=score), count_inliers=tenfold), "best")
        assert best(theirs).count == 10 * best(ours).count
        assert best(theirs).score == best(ours).score * (10 if score == "count" else 1)
        look = Look(params=Input(score=score), subject=setup(Input()), now=theirs)
        assert f"{best(theirs).count:,} votes" in caption(look).text
        share = best(theirs).count / 600
        assert theirs.needed == iterations_needed(share, 3, 0.99) < ours.needed


@pytest.mark.parametrize("model", list(MODELS))
def test_every_model_asks_how_many_samples(model):
    asked = []

    def two(inlier_ratio, sample_size, confidence):
        asked.append((sample_size, confidence))
        return 2

    last = end(run(Input(model=model, outliers=0.0, steps="improvements"), iterations_needed=two))
    assert last.iteration <= 3
    assert set(asked) == {(MODELS[model].sample_size, 0.99)}


def test_the_wire_shows_what_a_plane_does_with_points_on_a_line():
    exercise = next(
        exercise for exercise in exercises_of(lesson) if exercise.name == "plane_from_points"
    )
    assert "'Three points on one line'" in exercise.task
    assert "Three points on one line" in [
        preset.title for preset in lesson.presets if preset.params == presets.WIRE
    ]
    careless = next(
        mistake.function for mistake in exercise.mistakes if mistake.name == "line not seen"
    )
    for plane, phase in ((exercise.reference, "degenerate"), (careless, "model")):
        states = run(presets.WIRE, plane_from_points=plane)
        assert [next(states).phase for _ in range(2)] == ["sample", phase]


RIGHT = [
    (exercise, function) for exercise in exercises_of(lesson) for function in exercise.alternatives
]


@pytest.mark.parametrize(
    ("exercise", "function"), RIGHT, ids=lambda value: getattr(value, "__name__", value.__class__)
)
def test_another_right_function_draws_the_same_pictures(exercise, function):
    """Whatever side its normals are on, and however it rounds."""
    for params in (Input(), presets.WIRE):
        pairs = list(driven(lesson, exercise, function).run(params, setup(params)))
        assert end([pair.theirs for pair in pairs])
        assert [pair.trouble for pair in pairs if pair.trouble] == []
        assert [k for k, pair in enumerate(pairs) if pair.first] == []


def test_a_function_that_returns_no_plane_is_told_so():
    with pytest.raises(InputError, match=r"4 numbers"):
        list(run(Input(), plane_from_points=lambda p: p[0]))


@pytest.mark.parametrize("model", list(MODELS))
@pytest.mark.parametrize("score", ["count", "MSAC", "MLESAC"])
def test_every_model_with_every_score_is_right(model, score):
    params = Input(
        model=model, score=score, outliers=0.3, points=200, inlier_pixels=3.0, steps="improvements"
    )
    states = states_of(params)
    assert ends_right(states)
    assert best_error(states) < 0.2 * rivals(states)["least squares"]


@pytest.mark.parametrize("model", list(MODELS))
def test_the_picture_has_its_parts(model):
    timeline = Timeline(
        lesson, Input(model=model, outliers=0.1, points=100, inlier_pixels=3.5, steps="every part")
    ).complete()
    assert timeline.stopped is None, timeline.failure
    for step in timeline.known():
        state, scene = step.state, step.scene
        assert isinstance(scene["caption"], Caption)
        assert len(step.caption.text) <= 400
        points = part(scene, "points", Points)
        assert len(points.p) == 100
        if state.phase == "inliers":  # by votes: what is true of a point is another thing
            assert isinstance(points.color, Classes)
            assert dict(zip(points.color.names, points.color.roles, strict=True)) == {
                "votes for": "target",
                "votes against": "neutral",
            }
            np.testing.assert_array_equal(points.color.ids == 0, state.trial.inliers)
        if state.phase == "sample":
            np.testing.assert_array_equal(
                part(scene, "sample", Points).p[: len(state.sample)], points.p[state.sample]
            )
        for path, primitive in scene.items():
            labelled = path in ("frame", "slab") or path.startswith("who is right")
            if isinstance(primitive, Points | Segments) and not labelled:
                assert primitive.name, path
        if state.best and model in ("line", "plane", "circle"):
            tested = state.estimate if state.phase in ("model", "inliers") else state.best.estimate
            rows = part(scene, "slab", Segments).ends.reshape(-1, 3)
            rows = rows if model == "plane" else rows[:, [0, 2]] - [0.0, 0.7]
            subject = timeline.states().subject
            np.testing.assert_allclose(
                subject.model.distances(tested, rows), subject.limit, atol=1e-9
            )
    truth = part(timeline[-1].scene, "truth", Segments)
    assert len(truth.ends) > 0
    low, high = truth.ends.reshape(-1, 3).min(0), truth.ends.reshape(-1, 3).max(0)
    assert (low > -3).all()
    assert (high < 3).all()


@pytest.mark.parametrize("model", ["line", "plane", "circle", "sphere"])
def test_an_outline_lies_on_its_model(model):
    subject = rows_of(Input(model=model))
    ends = outline(subject, truth_of(subject)).reshape(-1, 3)
    p = ends[:, [0, 2]] - [0.0, 0.7] if subject.model.columns == 2 else ends
    assert subject.model.distances(truth_of(subject), p).max() < 1e-9


def test_a_model_outside_the_window_is_not_drawn():
    subject = rows_of(Input())
    assert outline(subject, np.array([0.0, 0.0, 1.0, -50.0])).shape == (0, 2, 3)
    subject = rows_of(Input(model="line"))
    assert outline(subject, np.array([0.0, 1.0, -50.0])).shape == (0, 2, 3)


def test_picks_need_enough_different_points():
    subject = rows_of(Input())
    assert chosen_sample(Input(), subject) == []
    assert chosen_sample(Input(sample=(-1, -1, 4, 9)), subject) == []
    assert chosen_sample(Input(sample=(4, 9, 4, 9)), subject) == []
    assert chosen_sample(Input(sample=(-1, 700, 4, 9)), subject) == []
    np.testing.assert_array_equal(chosen_sample(Input(sample=(1, 2, 4, 9)), subject), [[9, 4, 2]])
    four = rows_of(Input(model="sphere"))
    assert len(chosen_sample(Input(sample=(1, 2, 4, 9)), four)[0]) == 4


@pytest.mark.parametrize(
    ("points", "scenes"), [(50, 60), (60, 60), (200, 60), (600, 24), (5000, 4)]
)
def test_many_points_are_studied_in_fewer_scenes_and_the_chart_says_so(points, scenes):
    params = replace(presets.WIDER, points=points)
    assert widths.studies(params) == scenes
    timeline = Timeline(lesson, params)
    timeline.extend()
    curve = timeline[0].scene["error/whole"]
    assert f"{scenes} scenes" in str(curve)
