"""What lines of presets and explanations of questions of the disparity lesson say, decided from
the pictures' truth and the maps that a run carries.
"""

import dataclasses
import re

import numpy as np

from tests.own_seed import of_preset
from tests.readings import LENGTH, NUMBER, number, says, says_length
from tests.truths.disparity import (
    CHOSEN,
    found_at,
    hidden_given_up,
    near_an_edge,
    of_stage,
    off_in,
    pair_of,
    run_of,
    true_depth,
    wrong,
)
from tests.verdicts import Claim, Run
from tests.verdicts.disparity.captions import caption
from tests.verdicts.disparity.values import hidden, sigma
from workbench.algorithms.stereo.disparity import Stage
from workbench.lesson import Look

# preset lines -------------------------------------------------------------------------------------

BARE = (slice(30, 90), slice(46, 88))  # of the plain wall, well inside
STRIPES = (slice(30, 90), slice(60, 110))


def flat(run: Run, k: int, m: re.Match[str]) -> bool:
    """The curve of the bare wall stays low at every shift, far below the median cost where there is
    texture.
    """
    costs = run.states[of_stage(run, Stage.AGGREGATE)].costs
    textured = run.subject
    # other parts of the wall, not each other's
    left = textured.left[:, 40:46]
    right_ = textured.right[:, 20:26]
    return bool(
        np.nanmax(costs) < 9 * 0.5 * np.abs(left - right_).mean()
        and np.nanmin(costs) > 0.4 * np.nanmedian(costs)
    )


def valleys(run: Run, k: int, m: re.Match[str]) -> bool:
    costs = run.states[CHOSEN].costs
    inner = costs[1:-1]
    at = 1 + np.flatnonzero((inner < costs[:-2]) & (inner < costs[2:]))
    apart = np.diff(at)  # noise moves a valley by a pixel at most
    deep = costs[at].max() < 0.5 * np.nanmedian(costs)
    return len(at) == 5 and bool(
        deep and (abs(apart - 6) <= 1).all() and abs(apart.mean() - 6) <= 0.25
    )


def scattered(run: Run, k: int, m: re.Match[str]) -> bool:
    of_wrong, of_all = near_an_edge(run)
    return of_wrong < 1.3 * of_all


def times_baseline(run: Run, times: float) -> bool:
    """Every disparity is so many times that of the ordinary baseline."""
    ordinary = dataclasses.replace(run.params, baseline=0.1)
    disparity, other = (pair_of(params).disparity for params in (ordinary, run.params))
    return bool(np.allclose(other, times * disparity, rtol=1e-6))


def darker(run: Run, k: int, m: re.Match[str]) -> bool:
    mean = [float(picture.mean()) for picture in (run.subject.left, run.subject.right)]
    return abs(mean[1] / mean[0] - 0.7) < 0.03


def rows_off(run: Run, k: int, m: re.Match[str]) -> bool:
    """Pushed up by two rows, the right picture is that of the same run without the mistake."""
    true = run_of(dataclasses.replace(run.params, mistake="none")).subject.right
    return bool(np.array_equal(run.subject.right[2:], true[:-2]))


def last_words(run: Run) -> str:
    past = tuple(run.states[:-1])
    look = Look(params=run.params, subject=run.subject, now=run.states[-1], past=past)
    return caption(look).text


def four_times_too_far(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[-2]
    pair = run.subject.pair
    true = true_depth(pair)
    known = np.isfinite(state.depth) & np.isfinite(true) & pair.visible
    return abs(float(np.median(state.depth[known] / true[known])) - 4.0) < 0.2


LINES = {
    "single-pixel": (Claim("the right row", None),),
    "baselines": (Claim("The right camera moves away", None),),
    "spheres": (
        Claim(
            "leave 12 % wrong",
            of_preset(lambda run, k, _: abs(wrong(run, of_stage(run, Stage.AGGREGATE)) - 12) < 1),
        ),
        Claim("the paths 2 %", lambda run, k, _: abs(wrong(run, CHOSEN) - 2) <= 0.7),
        Claim(
            "The check finds most of what is hidden",
            lambda run, k, _: hidden_given_up(run, CHOSEN + 1) > 0.7,
        ),
    ),
    "textureless": (
        Claim("On the bare wall the cost curve is flat", flat),
        Claim(
            "over 90 % of it is wrong at a low cost",
            lambda run, k, _: off_in(run, CHOSEN, BARE) > 0.9,
        ),
    ),
    "textureless-smooth": (
        Claim("The bare wall is right", lambda run, k, _: off_in(run, CHOSEN, BARE) < 0.1),
        Claim("its own costs still know nothing", flat),
    ),
    "repeated": (
        Claim("Stripes 6 px apart give the curve a valley every 6 px", valleys),
        Claim(
            "on four fifths of the pattern a wrong one wins",
            lambda run, k, _: abs(off_in(run, CHOSEN, STRIPES) - 0.8) < 0.04,
        ),
    ),
    "repeated-paths": (
        Claim(
            "hardly a stripe stays wrong",
            lambda run, k, _: off_in(run, CHOSEN, STRIPES) < 0.05,
        ),
    ),
    "occlusion": (
        Claim(
            "Left of each post is a band that only the left camera sees",
            lambda run, k, _: not run.subject.pair.visible[10:110, 71:76].any(),
        ),
        Claim("No answer there is right", None),
        Claim(
            "The check gives up about four fifths of it, not all",
            of_preset(lambda run, k, _: abs(hidden_given_up(run, CHOSEN + 1) - 0.8) < 0.05),
        ),
    ),
    "window-3": (
        Claim(
            "about a third of the map is wrong",
            lambda run, k, _: abs(wrong(run, CHOSEN) - 100 / 3) < 5,
        ),
        Claim("scattered everywhere", scattered),
    ),
    "window-21": (Claim("which pixels are wrong now", None),),
    "baseline-half": (
        Claim("half the disparity everywhere", lambda run, k, _: times_baseline(run, 0.5)),
    ),
    "baseline-double": (
        Claim("every disparity doubles", lambda run, k, _: times_baseline(run, 2.0)),
    ),
    "one-pixel": (
        Claim(
            "Every disparity is made 1 px too large",
            lambda run, k, _: run.params.disparity_error == 1.0,
        ),
        Claim(
            r"The last step tells how far each board moves: by Z² / \(f B\), and measured",
            lambda run, k, _: "20 m by 5 m. Measured: " in last_words(run),
        ),
    ),
    "sky": (
        Claim(
            "The sky does not shift between the pictures: d = 0",
            lambda run, k, _: (
                (run.subject.pair.disparity == 0).sum() > 5000
                and np.isinf(run.states[-2].depth[5, 80])
            ),
        ),
    ),
    "darker": (
        Claim("The right picture is darker", None),
        Claim("Another exposure changes every grey value by 30 %", darker),
        Claim(
            "94 % of the map is wrong",
            of_preset(lambda run, k, _: abs(wrong(run, CHOSEN) - 94) < 1.5),
        ),
    ),
    "darker-census": (
        Claim("about 2 % are wrong", lambda run, k, _: abs(wrong(run, CHOSEN) - 2) < 1),
    ),
    "exchanged": (
        Claim(
            "94 % of the map is wrong",
            of_preset(lambda run, k, _: abs(wrong(run, CHOSEN) - 94) < 1.5),
        ),
        Claim("With left and right exchanged", None),
    ),
    "rows-off": (
        Claim("The right picture is 2 rows too low", rows_off),
        Claim(
            "two thirds are wrong",
            lambda run, k, _: abs(wrong(run, CHOSEN) - 100 * 2 / 3) < 5,
        ),
    ),
    "motorcycle": (
        Claim(
            "94 % of what both see is right",
            lambda run, k, _: abs(100 - wrong(run, CHOSEN) - 94) < 1,
        ),
        Claim(
            "a quarter of their size",
            lambda run, k, _: run.subject.left.shape[1] == 741 // 4,
        ),
    ),
    "f-not-rescaled": (Claim("everything is 4 times too far", four_times_too_far),),
}


# explanations -------------------------------------------------------------------------------------


def four_times(run: Run, k: int, m: re.Match[str]) -> bool:
    fB = run.params.focal_length * run.params.baseline
    return says(m["far"], fB / 4) and says(m["near"], fB / 16)


def came_nearer(run: Run, k: int, m: re.Match[str]) -> bool:
    fB = run.params.focal_length * run.params.baseline
    return (
        fB == 80.0
        and says_length(m["far"], 20.0 - fB / (fB / 20.0 + 1.0))
        and says_length(m["other"], fB / (fB / 20.0 - 1.0) - 20.0)
        and 20.0**2 / fB == 5.0
    )


def means(run: Run, k: int, m: re.Match[str]) -> bool:
    at = list(found_at(run, -2).values())
    fB = 640 * 0.125
    return says(m["z"], float(np.mean(at))) and says(
        m["d"], fB / float(np.mean([fB / z for z in at]))
    )


def more_hidden(run: Run, k: int, m: re.Match[str]) -> bool:
    was = 100 * hidden(run, 2)
    after = 100 * hidden(run, 6)
    return says(m["was"], was) and says(m["is"], after) and 1.5 < after / was < 2.5


def beside_edges(run: Run, k: int, m: re.Match[str]) -> bool:
    of_wrong, of_all = near_an_edge(run, -1)
    return (
        says(m["wrong"], wrong(run, len(run.states) - 1))
        # what counts as an edge differs by a pixel
        and abs(number(m["near"]) - 100 * of_wrong) < 3
        and abs(number(m["all"]) - 100 * of_all) < 5
        and of_wrong > 1.5 * of_all
    )


def by_chance(run: Run, k: int, m: re.Match[str]) -> bool:
    pair = run.subject.pair
    pictures = run.subject
    slices = []
    for d in range(32):
        cost = np.full(pictures.left.shape, np.inf)
        cost[:, d:] = np.abs(pictures.left[:, d:] - pictures.right[:, : 160 - d])
        slices.append(cost)
    off = np.abs(np.argmin(slices, axis=0) - pair.disparity)[pair.visible]
    return says(m["wrong"], 100.0 * float((off > 1.0).mean()))


WHYS = {
    "quarter": (
        Claim(
            rf"(?P<far>{NUMBER}) m\. The jump is one over the distance: 16 px at"
            rf" (?P<near>{NUMBER}) m",
            four_times,
        ),
    ),
    "single": (
        Claim(rf"^(?P<wrong>{NUMBER}) %", by_chance),
        Claim("one of the wrong ones", None),
    ),
    "nearer": (
        Claim(
            rf"made of 20 m 80 / 5 = 16 m: it came (?P<far>{LENGTH}) nearer\. The formula"
            r" Z² / \(f B\), which says 5 m, is the tangent\. One pixel too few would have put it"
            rf" (?P<other>{LENGTH}) further",
            came_nearer,
        ),
    ),
    "averages": (
        Claim(
            rf"The mean of the depths is (?P<z>{NUMBER}) m, the mean disparity stands for"
            rf" (?P<d>{NUMBER}) m",
            means,
        ),
    ),
    "baseline": (
        Claim(rf"(?P<was>{NUMBER}) % became (?P<is>{NUMBER}) %", more_hidden),
        Claim(
            r"The depths of the rest are twice as exact",
            lambda run, k, _: abs(sigma(run, 2) / sigma(run, 6) - 2.0) < 1e-9,
        ),
    ),
    "window": (
        Claim(
            r"(?P<wrong>\d+) % of the map is wrong, and (?P<near>\d+) % of that lies within 10 px,"
            r" half a window, of an"
            r" edge, where only (?P<all>\d+) % of all pixels are",
            beside_edges,
        ),
    ),
}
