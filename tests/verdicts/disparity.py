"""What the disparity lesson says of its runs, decided from the pictures' truth and the maps that a
state carries.
"""

import dataclasses
import re

import numpy as np

from lessons.disparity.captions import caption
from lessons.disparity.lesson import lesson
from tests.own_seed import of_preset
from tests.readings import LENGTH, NUMBER, metres, number, says, says_length
from tests.truths.disparity import (
    CHOSEN,
    comparing,
    depths_off,
    found_at,
    given_up_of_hidden,
    hidden_share,
    mean_error,
    near_an_edge,
    of_stage,
    off_in,
    pair_of,
    states,
    true_depth,
    wrong,
)
from tests.verdicts import Claim, Run
from workbench.algorithms.stereo.disparity import Stage

__all__ = ["CAPTIONS", "LINES", "WHYS", "caption", "right"]


def right(run: Run, k: int) -> bool | None:
    """The depths are right within 3 % in the median with few wrong pixels, wrong beyond 10 % or
    with many.
    """
    state = run.states[k]
    if state.stage is not None:
        return None
    errors, true = depths_off(state)
    relative = float(np.median(errors / true))
    if relative > 0.1 or wrong(state) > 20.0:
        return False
    return True if relative <= 0.03 and wrong(state) <= 5.0 else None


def fits_better(run: Run, k: int, found: re.Match[str]) -> bool:
    fresh = comparing(run.states)[k][0]
    said, share = (
        number(found["n"]),
        100 * number(found["n"]) / run.states[k].disparity.size,
    )
    return abs(said - fresh) <= max(2, 0.001 * fresh) and says(found["share"], share)


def wrong_change(run: Run, k: int, found: re.Match[str]) -> bool:
    return says(found["was"], wrong(run.states[k - 1])) and says(found["is"], wrong(run.states[k]))


def wrong_now(run: Run, k: int, found: re.Match[str]) -> bool:
    return says(found["is"], wrong(run.states[k]))


def error_change(run: Run, k: int, found: re.Match[str]) -> bool:
    return says(found["was"], mean_error(run.states[k - 1])) and says(
        found["is"], mean_error(run.states[k])
    )


def given_up(run: Run, k: int, found: re.Match[str]) -> bool:
    unknown = np.isnan(run.states[k].disparity)
    return number(found["n"]) == unknown.sum() and says(found["share"], 100 * unknown.mean())


def hidden_given_up(run: Run, k: int, found: re.Match[str]) -> bool:
    pair = run.states[k].setup.pair
    hidden = np.isfinite(pair.disparity) & ~pair.visible
    return says(found["n"], 100 * np.isnan(run.states[k].disparity)[hidden].mean())


def between_pixels(run: Run, k: int, found: re.Match[str]) -> bool:
    d = run.states[k].disparity[np.isfinite(run.states[k].disparity)]
    return (
        says(found["n"], float(np.abs(d - np.round(d)).mean()))
        and np.abs(d - np.round(d)).max() <= 0.5
    )


def energy_falls(run: Run, k: int, found: re.Match[str]) -> bool:
    was, now = run.states[k - 1].energy, run.states[k].energy
    return bool(
        np.isclose(number(found["was"]), was, rtol=1e-3)
        and np.isclose(number(found["is"]), now, rtol=1e-3)
    )


def law(run: Run, k: int, found: re.Match[str]) -> bool:
    """The depth of the followed pixel by Z = f B / (d + doffs); and its true depth."""
    state = run.states[k]
    setup, (u, v) = state.setup, state.setup.pixel
    f, B = number(found["f"]), number(found["B"])
    doffs = number(found["doffs"] or "0")
    true = float(true_depth(setup)[v, u])
    return bool(
        np.isclose(f * B / (number(found["d"]) + doffs), metres(found["z"]), rtol=0.01)
        and np.isclose(f * B, setup.f * setup.pair.camera.baseline, rtol=1e-3)
        and says(found["d"], state.disparity[v, u])
        and (found["true"] is None or says_length(found["true"], true))
        and (found["true"] is not None or not np.isfinite(true))
    )


def is_infinite(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[k]
    u, v = state.setup.pixel
    true = float(true_depth(state.setup)[v, u])
    said = np.isinf(true) if found["true"] is None else says_length(found["true"], true)
    return bool(state.disparity[v, u] == 0 and said)


def first_order(run: Run, k: int, found: re.Match[str]) -> bool:
    e, fB = number(found["e"]), run.states[k].setup.f * run.states[k].setup.pair.camera.baseline
    pairs = [part.split(" by ") for part in found["list"].split(", ")]
    return all(
        np.isclose(metres(moved), metres(z) ** 2 / fB * e, rtol=0.03, atol=6e-4)
        for z, moved in pairs
    )


def measured(run: Run, k: int, found: re.Match[str]) -> bool:
    """The boards, at 1, 5 and 20 m, moved by this in the median."""
    said = found["list"].split(", ")
    moved = [abs(depth - z) for z, depth in found_at(run, k).items()]
    return all(says_length(text, off_by) for text, off_by in zip(said, moved, strict=True))


def half_within(run: Run, k: int, found: re.Match[str]) -> bool:
    return says_length(found["z"], float(np.median(depths_off(run.states[k])[0])))


def exchanged(run: Run, k: int, found: re.Match[str]) -> bool:
    return (
        run.params.mistake == "pictures exchanged" and number(found["b"]) > number(found["a"]) + 5
    )


CAPTIONS = (
    Claim(
        rf"(?P<n>{NUMBER}) pixels \((?P<share>{NUMBER}) %\) fit better than at any smaller shift",
        fits_better,
    ),
    Claim(rf"energy (?P<was>{NUMBER}) → (?P<is>{NUMBER}) per pixel", energy_falls),
    Claim(rf"[Ww]rong pixels (?P<was>{NUMBER}) → (?P<is>{NUMBER}) %", wrong_change),
    Claim(rf"(?P<is>{NUMBER}) % are wrong", wrong_now),
    Claim(rf"the pixel is given up: (?P<n>{NUMBER}) \((?P<share>{NUMBER}) %\)", given_up),
    Claim(r"(?P<n>\d+) % of what the right camera cannot see", hidden_given_up),
    Claim(rf"(?P<n>{NUMBER}) px from whole ones on average", between_pixels),
    Claim(rf"mean error of the right ones (?P<was>{NUMBER}) → (?P<is>{NUMBER}) px", error_change),
    Claim(
        rf"Z = f B / (?:d|\(d \+ (?P<doffs>{NUMBER})\)) with f = (?P<f>{NUMBER}) px, B ="
        rf" (?P<B>{NUMBER}) m: left pixel"
        rf" \(\d+, \d+\), d = (?P<d>{NUMBER}) px, is (?P<z>{LENGTH}) away(?: \(truth:"
        rf" (?P<true>{LENGTH})\))?",
        law,
    ),
    Claim(
        r"has d = 0, which means infinitely far, not missing \(truth: (?:infinitely"
        rf" far|(?P<true>{LENGTH}))\)",
        is_infinite,
    ),
    Claim(
        rf"(?P<n>{NUMBER}) pixels are infinitely far",
        lambda run, k, found: number(found["n"]) == np.isinf(run.states[k].depth).sum(),
    ),
    Claim(
        rf"To first order (?P<e>{NUMBER}) px of error moves a depth by Z² / \(f B\) · {NUMBER} px:"
        rf" (?P<list>(?:{LENGTH} by {LENGTH}(?:, )?)+)",
        first_order,
    ),
    Claim(rf"Measured: (?P<list>{LENGTH}(?:, {LENGTH})*)", measured),
    Claim(rf"Half of all points are within (?P<z>{LENGTH}) of the truth", half_within),
    Claim(
        r"more pixels find each other, (?P<b>\d+) % instead of (?P<a>\d+) %: is the left one the"
        r" right one",
        exchanged,
    ),
    Claim(
        r"[Tt]he right picture chooses too|against right|to the right|down and right|up and"
        r" right|what the right camera",
        None,
    ),
)


# preset lines -------------------------------------------------------------------------------------

BARE = (slice(30, 90), slice(46, 88))  # of the plain wall, well inside
STRIPES = (slice(30, 90), slice(60, 110))


def flat(run: Run, k: int, found: re.Match[str]) -> bool:
    """The curve of the bare wall stays low at every shift, far below the median cost where there is
    texture.
    """
    state = of_stage(run, Stage.AGGREGATE)
    costs, textured = state.costs, state.setup
    left, right_ = (
        textured.left[:, 40:46],
        textured.right[:, 20:26],
    )  # other parts of the wall, not each other's
    return bool(
        np.nanmax(costs) < 9 * 0.5 * np.abs(left - right_).mean()
        and np.nanmin(costs) > 0.4 * np.nanmedian(costs)
    )


def valleys(run: Run, k: int, found: re.Match[str]) -> bool:
    costs = run.states[CHOSEN].costs
    inner = costs[1:-1]
    at = 1 + np.flatnonzero((inner < costs[:-2]) & (inner < costs[2:]))
    apart = np.diff(at)  # noise moves a valley by a pixel at most
    deep = costs[at].max() < 0.5 * np.nanmedian(costs)
    return len(at) == 5 and bool(
        deep and (abs(apart - 6) <= 1).all() and abs(apart.mean() - 6) <= 0.25
    )


def scattered(run: Run, k: int, found: re.Match[str]) -> bool:
    of_wrong, of_all = near_an_edge(run)
    return of_wrong < 1.3 * of_all


def times_baseline(run: Run, times: float) -> bool:
    """Every disparity is so many times that of the ordinary baseline."""
    ordinary = dataclasses.replace(run.params, baseline=0.1)
    one, other = (pair_of(params).disparity for params in (ordinary, run.params))
    return bool(np.allclose(other, times * one, rtol=1e-6))


def darker(run: Run, k: int, found: re.Match[str]) -> bool:
    mean = [
        float(picture.mean()) for picture in (run.states[0].setup.left, run.states[0].setup.right)
    ]
    return abs(mean[1] / mean[0] - 0.7) < 0.03


def rows_off(run: Run, k: int, found: re.Match[str]) -> bool:
    """Pushed up by two rows, the right picture is that of the same run without the mistake."""
    true = next(iter(lesson.run(dataclasses.replace(run.params, mistake="none")))).setup.right
    return bool(np.array_equal(run.states[0].setup.right[2:], true[:-2]))


def four_times_too_far(run: Run, k: int, found: re.Match[str]) -> bool:
    state = run.states[-2]
    true = true_depth(state.setup)
    known = np.isfinite(state.depth) & np.isfinite(true) & state.setup.pair.visible
    return abs(float(np.median(state.depth[known] / true[known])) - 4.0) < 0.2


LINES = {
    "spheres": (
        Claim(
            "74 % are wrong",
            of_preset(lambda run, k, _: abs(wrong(of_stage(run, Stage.COMPARE)) - 74) < 1),
        ),
        Claim(
            "leave 12 %",
            of_preset(lambda run, k, _: abs(wrong(of_stage(run, Stage.AGGREGATE)) - 12) < 1),
        ),
        Claim("the paths 2 %", lambda run, k, _: abs(wrong(run.states[CHOSEN]) - 2) <= 0.7),
        Claim(
            "The check finds four fifths of what is hidden",
            lambda run, k, _: abs(given_up_of_hidden(run) - 0.8) < 0.04,
        ),
    ),
    "textureless": (
        Claim("On the bare wall the cost curve is flat", flat),
        Claim(
            "over 90 % of it is wrong at a low cost",
            lambda run, k, _: off_in(run.states[CHOSEN], BARE) > 0.9,
        ),
    ),
    "textureless-smooth": (
        Claim("The bare wall is right", lambda run, k, _: off_in(run.states[CHOSEN], BARE) < 0.1),
        Claim("its own costs still know nothing", flat),
    ),
    "repeated": (
        Claim("Stripes 6 px apart give the curve a valley every 6 px", valleys),
        Claim(
            "on four fifths of the pattern a wrong one wins",
            lambda run, k, _: abs(off_in(run.states[CHOSEN], STRIPES) - 0.8) < 0.04,
        ),
    ),
    "repeated-paths": (
        Claim(
            "hardly a stripe stays wrong",
            lambda run, k, _: off_in(run.states[CHOSEN], STRIPES) < 0.05,
        ),
    ),
    "occlusion": (
        Claim(
            "Left of each post is a band that only the left camera sees",
            lambda run, k, _: not run.states[0].setup.pair.visible[10:110, 71:76].any(),
        ),
        Claim("No answer there is right", None),
        Claim(
            "The check gives up about four fifths of it, not all",
            of_preset(lambda run, k, _: abs(given_up_of_hidden(run) - 0.8) < 0.05),
        ),
    ),
    "window-3": (
        Claim(
            "about a third of the map is wrong",
            lambda run, k, _: abs(wrong(run.states[CHOSEN]) - 100 / 3) < 5,
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
            lambda run, k, _: "20 m by 5 m. Measured: " in caption(run.states[-1]).text,
        ),
    ),
    "sky": (
        Claim(
            "The sky does not shift between the pictures: d = 0",
            lambda run, k, _: (
                (run.states[0].setup.pair.disparity == 0).sum() > 5000
                and np.isinf(run.states[-2].depth[5, 80])
            ),
        ),
    ),
    "darker": (
        Claim("The right picture is darker", None),
        Claim("Another exposure changes every grey value by 30 %", darker),
        Claim(
            "94 % of the map is wrong",
            of_preset(lambda run, k, _: abs(wrong(run.states[CHOSEN]) - 94) < 1.5),
        ),
    ),
    "darker-census": (
        Claim("about 2 % are wrong", lambda run, k, _: abs(wrong(run.states[CHOSEN]) - 2) < 1),
    ),
    "exchanged": (
        Claim(
            "94 % of the map is wrong",
            of_preset(lambda run, k, _: abs(wrong(run.states[CHOSEN]) - 94) < 1.5),
        ),
        Claim("With left and right exchanged", None),
    ),
    "rows-off": (
        Claim("The right picture is 2 rows too low", rows_off),
        Claim(
            "two thirds are wrong",
            lambda run, k, _: abs(wrong(run.states[CHOSEN]) - 100 * 2 / 3) < 5,
        ),
    ),
    "motorcycle": (
        Claim(
            "94 % of what both see is right",
            lambda run, k, _: abs(100 - wrong(run.states[CHOSEN]) - 94) < 1,
        ),
        Claim(
            "a quarter of their size",
            lambda run, k, _: run.states[0].setup.left.shape[1] == 741 // 4,
        ),
    ),
    "f-not-rescaled": (Claim("everything is 4 times too far", four_times_too_far),),
}


# explanations -------------------------------------------------------------------------------------


def came_nearer(run: Run, k: int, found: re.Match[str]) -> bool:
    at = found_at(run, -1)
    return (
        says(found["far"], 20 - at[20])
        and says(found["times"], (20 - at[20]) / (1 - at[1]))
        and says_length(found["near"], 1 - at[1])
        and abs(20 - at[20] - (20 - 80 / 5)) < 0.05
    )


def means(run: Run, k: int, found: re.Match[str]) -> bool:
    at = list(found_at(run, -2).values())
    fB = 640 * 0.125
    return says(found["z"], float(np.mean(at))) and says(
        found["d"], fB / float(np.mean([fB / z for z in at]))
    )


def more_hidden(run: Run, k: int, found: re.Match[str]) -> bool:
    was, now = (
        hidden_share(dataclasses.replace(run.params, baseline=0.1, seed=0)),
        hidden_share(run.params),
    )
    return says(found["was"], was) and says(found["is"], now) and 1.5 < now / was < 2.5


def twice_as_exact(run: Run, k: int, found: re.Match[str]) -> bool:
    ordinary = states(dataclasses.replace(run.params, baseline=0.1))[-1]
    errors = [float(np.median(depths_off(state)[0])) for state in (ordinary, run.states[-1])]
    return 1.6 < errors[0] / errors[1] < 2.5


def beside_edges(run: Run, k: int, found: re.Match[str]) -> bool:
    of_wrong, of_all = near_an_edge(run)
    return (
        says(found["wrong"], wrong(run.states[CHOSEN]))
        and abs(number(found["near"]) - 100 * of_wrong)
        < 3  # what counts as an edge differs by a pixel
        and abs(number(found["all"]) - 100 * of_all) < 5
        and of_wrong > 1.5 * of_all
    )


WHYS = {
    "quarter": (
        Claim(
            rf"found at (?P<near>{NUMBER}) m and (?P<far>{NUMBER}) m",
            lambda run, k, found: (
                says(found["near"], found_at(run, -2)[5])
                and says(found["far"], found_at(run, -2)[20])
            ),
        ),
    ),
    "nearer": (
        Claim(
            rf"it came (?P<far>{NUMBER}) m nearer, (?P<times>\d+) times as much as the board at 1 m"
            rf" \((?P<near>{LENGTH})\)",
            came_nearer,
        ),
        Claim(
            r"Its 4 px became 5, and Z = f B / d with f B = 80 made of 20 m 80 / 5 = 16 m",
            lambda run, k, _: abs(found_at(run, -1)[20] - 16) < 0.05,
        ),
        Claim(
            r"which says 5 m, is the tangent: 1 px too small would have put it 6\.67 m further",
            lambda run, k, _: 20**2 / 80 == 5 and abs(80 / 3 - 20 - 6.67) < 0.005,
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
        Claim(r"The depths of the rest are about twice as exact", twice_as_exact),
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
