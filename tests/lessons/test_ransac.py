"""Holds the RANSAC lesson to what its page, presets and questions say, in numbers."""

import functools
import re
from dataclasses import replace
from typing import TypeVar

import numpy as np
import pytest

from lessons.ransac import presets
from lessons.ransac.lesson import chosen_sample, lesson, run
from lessons.ransac.params import Params
from lessons.ransac.presets import clean_share, end, first, share_reached
from lessons.ransac.shapes import outline, plane_polygon
from lessons.ransac.subject import subject_of
from lessons.ransac.words import is_right, length
from workbench.algorithms.models import MODELS, PLANE
from workbench.algorithms.ransac import Stop, iterations_needed
from workbench.algorithms.scores import count_inliers
from workbench.errors import InputError
from workbench.exercise.driven import driven
from workbench.exercise.finding import exercises_of
from workbench.geometry.lines_planes import plane_from_points
from workbench.scene import Caption, Classes, Points, Segments
from workbench.timeline import Timeline

Kind = TypeVar("Kind")


@functools.cache
def states_of(params):
    return Timeline(lesson, params).states()


def best(state):
    assert state.now.best is not None
    return state.now.best


def members(subject) -> np.ndarray:
    """Which rows were made from the model, which has to be known."""
    assert subject.is_inlier is not None
    return subject.is_inlier


def truth_of(subject) -> np.ndarray:
    assert subject.truth is not None
    return subject.truth


def part(scene, path: str, kind: type[Kind]) -> Kind:
    """The primitive at a path, which has to be of a kind."""
    primitive = scene[path]
    assert isinstance(primitive, kind)
    return primitive


def rivals(state):
    return {rival.name: rival.error for rival in state.rivals}


def page() -> str:
    return " ".join(lesson.text().split())


# the page ----------------------------------------------------------------------------------------------------------


def test_the_numbers_of_the_page():
    assert [iterations_needed(w, 3, 0.99) for w in (0.7, 0.3, 0.2)] == [11, 169, 574]
    assert "11, 169 or 574 samples for $w = 0.7$, $0.3$ or $0.2$" in page()
    for model in MODELS.values():
        assert f"{model.name} {model.sample_size}" in page()


@pytest.mark.parametrize("model", list(MODELS))
def test_how_many_inliers_the_distances_of_the_page_keep(model):
    """95 % within 1.96 σ; of a homography, whose distances hold the noise of both images, within 3.46 σ."""
    shares = {1.96: [], 2.45: [], 3.46: []}
    for scene in range(20):
        subject = subject_of(Params(model=model, points=1000, outliers=0.0, scene_seed=scene))
        sigma = Params().noise_pixels if subject.model.unit == "px" else Params().noise
        off = subject.model.distances(truth_of(subject), subject.p) / sigma
        for limit, share in shares.items():
            share.append((off <= limit).mean())
    kept = {limit: np.mean(share) for limit, share in shares.items()}
    flat = model == "homography"
    assert kept[3.46 if flat else 1.96] == pytest.approx(0.95, abs=0.005)
    assert kept[2.45] == pytest.approx(0.78 if flat else 0.986, abs=0.005)


def test_the_inlier_distances_that_are_set_keep_95_percent_of_the_inliers():
    assert Params().inlier_distance / Params().noise == pytest.approx(1.96, abs=0.05)
    assert Params().inlier_pixels / Params().noise_pixels == pytest.approx(3.46, abs=0.05)  # of a homography
    assert presets.PROSAC.inlier_pixels / presets.PROSAC.noise_pixels == pytest.approx(3.46, abs=0.05)
    assert presets.MATCHES.inlier_pixels / presets.MATCHES.noise_pixels == pytest.approx(1.96, abs=0.05)
    for words in ("$t = 1.96\\,\\sigma$", "3.46\\,\\sigma$, and only 78 % within $2.45\\,\\sigma$"):
        assert words in page()


def test_a_caption_about_a_sample_cannot_be_read_as_about_the_inliers():
    states = states_of(Params())
    said = [part(lesson.draw(state), "caption", Caption).text for state in states[:3]]
    assert said[0].startswith("Sample 1: three points, drawn by chance. Of its three points ")
    assert said[1].endswith("Now all 600 points vote: yes from those within 30 mm of it.")
    assert re.fullmatch(
        r"Sample 1: \d+ of 600 points lie within 30 mm of its plane\. Of its three points \w+ (is an outlier|are outliers)"
        r" in truth\.", said[2],
    )  # fmt: skip
    assert not [text for text in said if "every other" in text or "of them" in text]


def test_only_about_nine_percent_of_the_clean_samples_reach_nine_tenths_of_the_inliers():
    params = Params()
    assert params.inlier_distance == 2 * params.noise
    subject, rng = subject_of(params), np.random.default_rng(0)
    clean = np.flatnonzero(members(subject))
    planes = PLANE.solve(subject.p[rng.choice(clean, (4000, 3))])
    reached = (PLANE.distances(planes, subject.p[clean]) <= params.inlier_distance).mean(axis=1)
    assert 0.07 < (reached >= 0.9).mean() < 0.11


def test_the_default_run_does_what_the_page_says():
    states = states_of(Params())
    last, before = end(states), [state for state in states if state.now.phase == "best"][-1]
    assert 0.004 < before.best_error < 0.006
    assert last.best_error < 0.001
    assert rivals(last)["least squares"] == pytest.approx(0.25, abs=0.005)
    assert [state.now.phase for state in states[:3]] == ["sample", "model", "inliers"]
    scores = [best(state).score for state in states if state.now.best and state.now.phase not in ("refit", "stop")]
    assert scores == sorted(scores)
    needed = [state.now.needed for state in states]
    assert needed == sorted(needed, reverse=True)
    assert is_right(last)


# the presets -------------------------------------------------------------------------------------------------------


def test_thirty_and_seventy_percent():
    thirty, seventy = end(states_of(presets.THIRTY)), end(states_of(presets.SEVENTY))
    assert 10 <= thirty.now.iteration <= 20
    assert 100 < seventy.now.iteration < 200
    assert clean_share(thirty) ** 3 == pytest.approx(1 / 3, abs=0.02)
    assert 1 / clean_share(seventy) ** 3 == pytest.approx(37, abs=0.1)
    assert rivals(thirty)["least squares"] == pytest.approx(0.15, abs=0.01)
    assert max(thirty.best_error, seventy.best_error) < 0.004
    assert thirty.now.stop is seventy.now.stop is Stop.ENOUGH


def test_an_inlier_distance_too_small():
    last = end(states_of(presets.TIGHT))
    reference = end(states_of(Params()))
    assert presets.TIGHT.inlier_distance == pytest.approx(presets.TIGHT.noise / 4, rel=0.1)
    assert last.now.stop is Stop.MAX_ITERATIONS
    assert best(last).inliers[members(last.subject)].mean() == pytest.approx(0.25, abs=0.05)
    assert last.best_error > 5 * reference.best_error


def test_an_inlier_distance_too_large():
    last = end(states_of(presets.LOOSE))
    assert presets.LOOSE.inlier_distance == pytest.approx(20 * presets.LOOSE.noise)
    assert 8 <= last.now.iteration <= 17
    assert last.best_error == pytest.approx(0.04, abs=0.005)
    assert best(last).inliers[~members(last.subject)].mean() > 0.3
    assert not is_right(last)
    assert Timeline(lesson, presets.LOOSE).complete()[-1].caption.tone == "wrong"


def test_msac_keeps_a_sample_nearer_to_the_truth():
    def error(params):
        return [state for state in states_of(params) if state.now.phase == "best"][-1].best_error

    assert error(presets.MSAC) < 0.1 * error(replace(presets.MSAC, score="count"))


def test_the_largest_plane_wins():
    states = states_of(presets.WALL)
    last = end(states)
    wall = abs(best(last).estimate[2]) < 0.3
    assert wall
    assert last.best_error > 0.5
    assert not is_right(last)
    on_table, on_wall = np.count_nonzero(members(last.subject)), best(last).count
    assert on_wall == pytest.approx(2 * on_table, rel=0.1)


def test_the_picked_wire_is_degenerate_and_counts():
    states = states_of(presets.WIRE)
    assert [state.now.phase for state in states[:2]] == ["sample", "degenerate"]
    assert states[0].chosen
    assert members(states[0].subject)[states[0].now.sample].all()
    assert states[2].now.iteration == 2
    assert not states[2].chosen
    assert is_right(end(states))
    assert len([s for s in states if s.now.phase == "degenerate"]) > 1  # chance meets the wire again


def test_three_near_inliers_make_a_bad_plane():
    state = first(states_of(presets.NEAR), "inliers")
    assert state.chosen
    assert members(state.subject)[state.now.sample].all()
    assert np.ptp(state.subject.p[state.now.sample], axis=0).max() < 0.2
    assert share_reached(state) < 0.1
    assert (
        states_of(presets.NEAR)[lesson.preset("near-sample").step or 0].now.phase == "model"
    )  # what it reaches comes next


def test_huber_lies_between_and_ransac_below():
    last = end(states_of(presets.THIRTY))
    errors = rivals(last)
    assert errors["least squares"] == pytest.approx(0.15, abs=0.01)
    assert errors["Huber"] == pytest.approx(0.014, abs=0.001)
    assert last.best_error == pytest.approx(0.002, abs=0.0005)


def test_the_local_refit_ends_sooner():
    with_it, without = (end(states_of(replace(presets.LOCAL, local_refit=local))) for local in (True, False))
    assert with_it.now.iteration < 0.75 * without.now.iteration
    assert is_right(with_it)


def test_prosac_gets_there_in_a_tenth_of_the_draws():
    def reached(params):
        states = states_of(params)
        enough = 0.8 * best(end(states)).count
        return next(state.now.iteration for state in states if state.now.best and best(state).count >= enough)

    assert reached(presets.PROSAC) <= 24
    assert reached(replace(presets.PROSAC, sampler="uniform", steps="improvements")) > 200


def test_two_views_and_their_lines():
    last = end(states_of(presets.MATCHES))
    assert is_right(last)
    assert best(last).inliers[members(last.subject)].mean() > 0.9
    assert iterations_needed(clean_share(last), 7, 0.99) > 50
    assert last.now.iteration > 50


def test_every_preset_opens_where_its_line_points():
    for name, phase in (
        ("thirty", "inliers"),
        ("collinear", "degenerate"),
        ("near-sample", "model"),
        ("two-planes", "inliers"),
        ("rivals", "refit"),
        ("loose", "stop"),
    ):
        preset = lesson.preset(name)
        states = states_of(preset.params)
        assert states[preset.step or 0].now.phase == phase


# the questions -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("predict-needed", 35.0),
        ("predict-near-sample", 2.0),
        ("predict-two-planes", 1.0),
        ("predict-size", 2.0),
        ("predict-huber", 1.0),
    ],
)
def test_the_answers_are_read_off_the_runs(name, answer):
    question = next(question for question in lesson.questions if question.name == name)
    states = states_of(question.params)
    assert question.answer(states) == answer
    assert "nan" not in question.why(states)


# the pieces --------------------------------------------------------------------------------------------------------


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

    ours = list(run(Params(steps="every part")))
    theirs = list(
        run(Params(steps="every part"), plane_from_points=plane, count_inliers=count, iterations_needed=needed)
    )
    assert len(ours) == len(theirs)
    np.testing.assert_array_equal(best(end(ours)).estimate, best(end(theirs)).estimate)
    assert calls["plane"] == end(ours).now.iteration
    assert calls["count"] >= calls["plane"]
    assert calls["needed"] == sum(state.now.phase == "best" for state in ours)


def test_wrong_functions_have_the_effect_they_deserve():
    horizontal = list(run(Params(), plane_from_points=lambda p: np.array([0.0, 0.0, 1.0, -p[0, 2]])))
    assert best([s for s in horizontal if s.now.phase == "best"][-1]).estimate[2] == 1.0
    turned_round = list(
        run(Params(), count_inliers=lambda plane, p, t: int(np.sum(np.abs(p @ plane[:3] + plane[3]) > t)))
    )
    assert [s for s in turned_round if s.now.phase == "best"][-1].best_error > 0.2
    hasty = end(run(Params(seed=3), iterations_needed=lambda w, m, p: 1))
    assert hasty.now.iteration <= 2


def test_a_count_decides_what_is_best_and_how_many_samples_follow():
    def tenfold(plane, p, inlier_distance):
        return 10 * count_inliers(plane, p, inlier_distance)

    for score in ("count", "MSAC"):
        ours = first(run(Params(score=score)), "best")
        theirs = first(run(Params(score=score), count_inliers=tenfold), "best")
        assert best(theirs).count == 10 * best(ours).count
        assert best(theirs).score == best(ours).score * (10 if score == "count" else 1)
        assert f"{best(theirs).count:,} inliers" in part(lesson.draw(theirs), "caption", Caption).text
        share = best(theirs).count / len(theirs.subject.p)
        assert theirs.now.needed == iterations_needed(share, 3, 0.99) < ours.now.needed


@pytest.mark.parametrize("model", list(MODELS))
def test_every_model_asks_how_many_samples(model):
    asked = []

    def two(inlier_ratio, sample_size, confidence):
        asked.append((sample_size, confidence))
        return 2

    last = end(run(Params(model=model, outliers=0.0, steps="improvements"), iterations_needed=two))
    assert last.now.iteration <= 3
    assert set(asked) == {(MODELS[model].sample_size, 0.99)}


def test_the_wire_shows_what_a_plane_does_with_points_on_a_line():
    exercise = next(exercise for exercise in exercises_of(lesson) if exercise.name == "plane_from_points")
    assert "'Three points on one line'" in exercise.task
    assert "Three points on one line" in [preset.title for preset in lesson.presets if preset.params == presets.WIRE]
    careless = next(mistake.function for mistake in exercise.mistakes if mistake.name == "line not seen")
    for plane, phase in ((exercise.reference, "degenerate"), (careless, "model")):
        states = run(presets.WIRE, plane_from_points=plane)
        assert [next(states).now.phase for _ in range(2)] == ["sample", phase]


RIGHT = [(exercise, function) for exercise in exercises_of(lesson) for function in exercise.alternatives]


@pytest.mark.parametrize(("exercise", "function"), RIGHT, ids=lambda value: getattr(value, "__name__", value.__class__))
def test_another_right_function_draws_the_same_pictures(exercise, function):
    """Whatever side its normals are on, and however it rounds."""
    for params in (Params(), presets.WIRE):
        pairs = list(driven(lesson, exercise, function).run(params))
        assert end([pair.theirs for pair in pairs])
        assert [pair.trouble for pair in pairs if pair.trouble] == []
        assert [k for k, pair in enumerate(pairs) if pair.first] == []


def test_a_polygon_does_not_depend_on_the_side_of_the_normal():
    subject, rng = subject_of(Params()), np.random.default_rng(5)
    for _ in range(20):
        plane = PLANE.solve(rng.uniform(-0.8, 0.8, (1, 3, 3)))[0]
        corners = plane_polygon(subject, plane)
        np.testing.assert_allclose(plane_polygon(subject, -plane), corners, atol=1e-12)
        np.testing.assert_allclose(plane_polygon(subject, plane * (1.0 + 1e-15)), corners, atol=1e-12)
        steps = np.roll(corners, -1, axis=0) - corners
        turns = np.cross(steps, np.roll(steps, -1, axis=0)) @ plane[:3]
        assert (turns > 0).all() or (turns < 0).all(), "convex, in order"


def test_a_function_that_returns_no_plane_is_told_so():
    with pytest.raises(InputError, match=r"4 numbers"):
        list(run(Params(), plane_from_points=lambda p: p[0]))


@pytest.mark.parametrize("model", list(MODELS))
@pytest.mark.parametrize("score", ["count", "MSAC", "MLESAC"])
def test_every_model_with_every_score_is_right(model, score):
    params = Params(model=model, score=score, outliers=0.3, points=200, inlier_pixels=3.0, steps="improvements")
    last = end(states_of(params))
    assert is_right(last)
    assert last.best_error < 0.2 * rivals(last)["least squares"]


@pytest.mark.parametrize("model", list(MODELS))
def test_the_picture_has_its_parts(model):
    timeline = Timeline(
        lesson, Params(model=model, outliers=0.1, points=100, inlier_pixels=3.5, steps="every part")
    ).complete()
    assert timeline.stopped is None, timeline.failure
    for step in timeline.known():
        state, scene = step.state, step.scene
        assert isinstance(scene["caption"], Caption)
        assert len(step.caption.text) <= 400
        points = part(scene, "points", Points)
        assert len(points.p) == 100
        if state.now.phase == "inliers":
            assert isinstance(points.color, Classes)
            np.testing.assert_array_equal(points.color.ids == 0, state.now.trial.inliers)
        if state.now.phase == "sample":
            np.testing.assert_array_equal(
                part(scene, "sample", Points).p[: len(state.now.sample)], points.p[state.now.sample]
            )
        for path, primitive in scene.items():
            if isinstance(primitive, Points | Segments):
                assert primitive.name, path
    truth = part(timeline[-1].scene, "truth", Segments)
    assert len(truth.ends) > 0
    low, high = truth.ends.reshape(-1, 3).min(0), truth.ends.reshape(-1, 3).max(0)
    assert (low > -3).all()
    assert (high < 3).all()


@pytest.mark.parametrize("model", ["line", "plane", "circle", "sphere"])
def test_an_outline_lies_on_its_model(model):
    subject = subject_of(Params(model=model))
    ends = outline(subject, truth_of(subject), np.zeros(0, int)).reshape(-1, 3)
    p = ends[:, [0, 2]] - [0.0, 0.7] if subject.model.columns == 2 else ends
    assert subject.model.distances(truth_of(subject), p).max() < 1e-9


def test_a_model_outside_the_window_is_not_drawn():
    subject = subject_of(Params())
    assert outline(subject, np.array([0.0, 0.0, 1.0, -50.0]), np.zeros(0, int)).shape == (0, 2, 3)
    subject = subject_of(Params(model="line"))
    assert outline(subject, np.array([0.0, 1.0, -50.0]), np.zeros(0, int)).shape == (0, 2, 3)


def test_picks_need_enough_different_points():
    subject = subject_of(Params())
    assert chosen_sample(Params(), subject) == []
    assert chosen_sample(Params(sample=(-1, -1, 4, 9)), subject) == []
    assert chosen_sample(Params(sample=(4, 9, 4, 9)), subject) == []
    assert chosen_sample(Params(sample=(-1, 700, 4, 9)), subject) == []
    np.testing.assert_array_equal(chosen_sample(Params(sample=(1, 2, 4, 9)), subject), [[9, 4, 2]])
    four = subject_of(Params(model="sphere"))
    assert len(chosen_sample(Params(sample=(1, 2, 4, 9)), four)[0]) == 4


# own data ----------------------------------------------------------------------------------------------------------


def test_an_own_cloud_and_what_does_not_fit_it(tmp_path):
    p = subject_of(Params(outliers=0.3)).p * 10 + 500
    np.savetxt(tmp_path / "cloud.csv", p, delimiter=",")
    params = Params(cloud=tmp_path / "cloud.csv", inlier_distance=0.3)
    timeline = Timeline(lesson, params).complete()
    assert timeline.stopped is None, timeline.failure
    last = end(timeline.states())
    assert best(last).count == pytest.approx(410, abs=20)
    assert np.isnan(last.best_error)
    shown = part(timeline[-1].scene, "points", Points)
    assert np.abs(shown.p).max() < 2.5
    for other, message in (("line", "plane or sphere"), ("homography", "plane or sphere")):
        assert message in str(Timeline(lesson, replace(params, model=other)).complete().stopped)
    assert "does not say whom to trust" in str(Timeline(lesson, replace(params, sampler="PROSAC")).complete().stopped)
    assert "no such file" in str(Timeline(lesson, replace(params, cloud=tmp_path / "none.csv")).complete().stopped)


def captions_of(params) -> list[Caption]:
    timeline = Timeline(lesson, params).complete()
    assert timeline.stopped is None, timeline.failure
    return [step.caption for step in timeline.known()]


def test_an_own_cloud_in_another_unit_is_noticed_and_converted(tmp_path):
    p = subject_of(Params(outliers=0.3)).p
    np.savetxt(tmp_path / "m.csv", p, delimiter=",")
    np.savetxt(tmp_path / "mm.csv", 1000.0 * p, delimiter=",")
    in_metres, as_metres = (Params(cloud=tmp_path / name, steps="improvements") for name in ("m.csv", "mm.csv"))
    right, wrong = captions_of(in_metres), captions_of(as_metres)
    assert not [caption for caption in right if "Mind" in caption.text]
    for caption in (wrong[0], wrong[-1]):
        assert (
            "so few of them can be expected within 30 mm of any plane. Is the cloud in m (cloud_unit)?" in caption.text
        )
    converted = captions_of(replace(as_metres, cloud_unit="mm"))
    assert [caption.text for caption in converted] == [caption.text for caption in right]
    np.savetxt(tmp_path / "km.csv", 1e-3 * p, delimiter=",")
    assert "so nearly all of them" in captions_of(replace(in_metres, cloud=tmp_path / "km.csv"))[-1].text


@pytest.mark.parametrize("rows", ["one place", "one line"])
@pytest.mark.parametrize("model", ["plane", "sphere", "homography", "fundamental matrix"])
def test_own_rows_that_determine_nothing_are_told_so(tmp_path, model, rows):
    columns = MODELS[model].columns
    p = (
        np.ones((20, columns))
        if rows == "one place"
        else np.outer(np.linspace(0.0, 50.0, 20), np.arange(1.0, columns + 1))
    )
    np.savetxt(tmp_path / "rows.csv", p, delimiter=",")
    own = {"cloud" if columns == 3 else "matches": tmp_path / "rows.csv"}
    last = captions_of(Params(model=model, most_samples=20, steps="improvements", **own))[-1]
    assert last.tone == "wrong"
    assert f"Every sample was degenerate ({MODELS[model].degenerate_when}): such" in last.text
    assert f"determine no {model}." in last.text


def test_matches_that_are_no_pixels_are_noticed(tmp_path):
    p = subject_of(Params(model="homography", outliers=0.2)).p
    np.savetxt(tmp_path / "normalised.csv", p / 640.0, delimiter=",")
    last = captions_of(Params(model="homography", matches=tmp_path / "normalised.csv", steps="improvements"))[-1]
    assert "Are the matches in pixels?" in last.text
    with pytest.raises(InputError, match="a folder, not a file"):
        subject_of(Params(model="homography", matches=tmp_path))


def test_lengths_are_written_as_people_write_them():
    assert [length(x, "m") for x in (0.0, 1e-16, 0.0012, 0.1, 3.456, 12345.6)] == [
        "0 mm", "0 mm", "1.2 mm", "0.1 m", "3.46 m", "12,346 m",
    ]  # fmt: skip
    assert [length(x, "px") for x in (1e-12, 0.05, 3.5, 1234.5)] == ["0 px", "0.05 px", "3.5 px", "1,234 px"]


def test_own_matches_with_their_truth(tmp_path):
    subject = subject_of(Params(model="fundamental matrix", outliers=0.2, points=150))
    np.savez(
        tmp_path / "m.npz",
        x1=subject.p[:, :2],
        x2=subject.p[:, 2:],
        F=truth_of(subject),
        quality=np.asarray(subject.quality),
    )
    params = Params(model="fundamental matrix", matches=tmp_path / "m.npz", sampler="PROSAC", steps="improvements")
    last = end(states_of(params))
    assert is_right(last)
    assert "homography or fundamental" in str(Timeline(lesson, replace(params, model="plane")).complete().stopped)
    np.savetxt(tmp_path / "few.csv", subject.p[:5], delimiter=",")
    few = Timeline(lesson, replace(params, matches=tmp_path / "few.csv")).complete()
    assert "5 matches; at least 7" in str(few.stopped)


def test_the_real_photographs_and_the_real_room(shared_data):
    folder = shared_data / "ransac"
    pair = Params(
        model="fundamental matrix", matches=folder / "fountain-P11" / "gt_and_matches.npz", inlier_pixels=1.0,
        first_image=folder / "fountain-P11" / "0004_third.jpg", second_image=folder / "fountain-P11" / "0005_third.jpg",
        steps="improvements",
    )  # fmt: skip
    last = end(states_of(pair))
    assert best(last).inliers[members(last.subject)].mean() >= 0.95
    room = Params(cloud=folder / "capture0001.pcd", up="-y", inlier_distance=0.02, steps="improvements")
    last = end(states_of(room))
    assert best(last).count / len(last.subject.p) == pytest.approx(0.27, abs=0.03)
