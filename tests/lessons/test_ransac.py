"""Holds the RANSAC lesson to what its page, presets and questions say, in numbers."""

import re
from dataclasses import replace

import numpy as np
import pytest

from lessons.ransac import presets
from lessons.ransac.captions import is_right
from lessons.ransac.lesson import draw, lesson
from lessons.ransac.presets import clean_share, end, first, share_reached
from lessons.ransac.rows import subject_of
from lessons.ransac.state import Params
from tests.lessons.ransac_runs import best, members, part, rivals, states_of, truth_of
from tests.truths.ransac import most_trusted
from workbench.algorithms.robust.models import MODELS, PLANE
from workbench.algorithms.robust.ransac import Stop, iterations_needed
from workbench.run.timeline import Timeline
from workbench.scene import Caption


def page() -> str:
    return " ".join(lesson.text().split())


# the page -----------------------------------------------------------------------------------------


def test_the_numbers_of_the_page():
    assert [iterations_needed(w, 3, 0.99) for w in (0.7, 0.3, 0.2)] == [11, 169, 574]
    assert "11, 169 or 574 samples for $w = 0.7$, $0.3$ or $0.2$" in page()
    for model in MODELS.values():
        assert f"{model.name} {model.sample_size}" in page()


@pytest.mark.parametrize("model", list(MODELS))
def test_how_many_inliers_the_distances_of_the_page_keep(model):
    """95 % within 1.96 σ; of a homography, whose distances hold the noise of both images, within
    3.46 σ.
    """
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
    assert Params().inlier_pixels / Params().noise_pixels == pytest.approx(
        3.46, abs=0.05
    )  # of a homography
    assert presets.PROSAC.inlier_pixels / presets.PROSAC.noise_pixels == pytest.approx(
        3.46, abs=0.05
    )
    assert presets.MATCHES.inlier_pixels / presets.MATCHES.noise_pixels == pytest.approx(
        1.96, abs=0.05
    )
    for words in ("$t = 1.96\\,\\sigma$", "3.46\\,\\sigma$, and only 78 % within $2.45\\,\\sigma$"):
        assert words in page()


def test_a_caption_about_a_sample_cannot_be_read_as_about_the_inliers():
    states = states_of(Params())
    said = [part(draw(state), "caption", Caption).text for state in states[:3]]
    assert said[0].startswith("Sample 1: three points, drawn by chance. Of its three points ")
    assert said[1].endswith("Now all 600 points vote: yes from those within 30 mm of it.")
    assert re.fullmatch(
        r"Sample 1: \d+ of 600 points lie within 30 mm of its plane\. Of its three points \w+ (is"
        r" an outlier|are outliers)"
        r" in truth\.",
        said[2],
    )
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
    scores = [
        best(state).score
        for state in states
        if state.now.best and state.now.phase not in ("refit", "stop")
    ]
    assert scores == sorted(scores)
    needed = [state.now.needed for state in states]
    assert needed == sorted(needed, reverse=True)
    assert is_right(last)


# the presets --------------------------------------------------------------------------------------


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
    assert part(draw(last), "caption", Caption).tone == "wrong"
    assert (
        Timeline(lesson, presets.LOOSE).complete()[-1].caption.tone == "info"
    )  # it is meant to be


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
    assert (
        len([s for s in states if s.now.phase == "degenerate"]) > 1
    )  # chance meets the wire again


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
    with_it, without = (
        end(states_of(replace(presets.LOCAL, local_refit=local))) for local in (True, False)
    )
    assert with_it.now.iteration < 0.75 * without.now.iteration
    assert is_right(with_it)


@pytest.mark.parametrize("seed", range(6))
def test_prosac_stops_after_a_tenth_of_the_draws_and_is_right(seed):
    """It once stopped by the share of all matches, as chance does, after some 300 samples."""
    params = replace(presets.PROSAC, seed=seed)
    trusting, by_chance = (
        end(states_of(replace(params, sampler=how))) for how in ("PROSAC", "uniform")
    )
    assert trusting.now.stop is Stop.ENOUGH
    assert trusting.now.iteration < 25
    assert by_chance.now.iteration > 300
    assert is_right(trusting)
    assert trusting.best_error == pytest.approx(by_chance.best_error, abs=0.05)


@pytest.mark.parametrize(
    "params", [presets.PROSAC, replace(presets.PROSAC, seed=3), Params(sampler="PROSAC")]
)
def test_prosac_asks_for_the_share_among_the_most_trusted(params):
    for state in states_of(params):
        if state.now.phase == "best":
            length, share = most_trusted(state)
            assert state.subject.most_trusted(best(state)) == (length, pytest.approx(share))
            needed = iterations_needed(share, state.subject.model.sample_size, 0.99)
            assert state.now.needed == min(500, needed)


def test_a_vote_is_never_called_inlier():
    """Which the captions say of the truth alone: points of the green line were "outliers" to a bad
    line.
    """
    for name in ("line", "near-sample", "epipolar"):
        params = lesson.preset(name).params
        for state in states_of(params):
            scene = draw(state)
            legend = [getattr(one, "name", "") for one in scene.values()]
            legend += [
                word
                for one in scene.values()
                for word in getattr(getattr(one, "color", None), "names", ())
            ]
            assert not [word for word in legend if "lier" in word]
            said = part(scene, "caption", Caption).text.replace(
                "If that is the share of inliers", ""
            )
            said = said.replace("free of outliers", "")
            assert not re.findall(r"\w+lier\w*(?! in truth)\b(?! in truth)", said), said


def test_what_is_quoted_is_at_rest_or_says_that_it_is_not():
    for params in [one.params for one in (*lesson.presets, *lesson.questions)]:
        last = end(states_of(params))
        if last.now.stop is not Stop.ENOUGH:
            assert params == presets.TIGHT
            assert "500 samples do not suffice" in lesson.preset("tight").line
            assert (
                "maximum number of samples is reached" in part(draw(last), "caption", Caption).text
            )


def test_known_wrong_answers_are_answered():
    for question in lesson.questions:
        right = question.answer(states_of(question.params))
        if question.choices:
            assert [bool(question.reply(i)) for i in range(len(question.choices))] == [
                i != right for i in range(len(question.choices))
            ]
    needed = lesson.questions[0]
    assert all(needed.reply(given) for given in (7, 8, 300, 588))
    assert not any(needed.reply(given) for given in (30, 35, 40))
    assert round(100 * (7 / 8) ** 8) == 34


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


# the questions ------------------------------------------------------------------------------------


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
