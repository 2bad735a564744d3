"""The stages in the flat: one line among clutter, held by hand. A vote is a colour, the truth a
ring.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from lessons.ransac.inputs import Input
from lessons.ransac.robust_scenes import scattered_line_scene
from lessons.ransac.rows import Subject, stand_up
from lessons.ransac.search import chosen_sample
from lessons.ransac.shapes import frames, outline, slab
from workbench.algorithms.robust.models import LINE
from workbench.algorithms.robust.samplers import draw_samples, uniform_samples
from workbench.captions import Quantity
from workbench.certain import sure
from workbench.geometry.clipping import clip_lines
from workbench.geometry.polylines import circle, segments
from workbench.lesson import Look, cached, say
from workbench.numerals import brief, counted
from workbench.scene import (
    Caption,
    Chart,
    Classes,
    Color,
    Label,
    Mesh,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
)

MM = 1000.0
MOST_DRAWS = 100
DOT, RING = 0.02, 0.04  # metres: the radius of a point, and of the ring around a true one
WIDTHS = (
    np.array(
        [
            5,
            7.5,
            10,
            12.5,
            15,
            20,
            25,
            30,
            35,
            40,
            45,
            50,
            60,
            70,
            80,
            90,
            100,
            120,
            140,
            160,
            180,
            200,
            225,
            250,
            275,
            300,
        ]
    )
    / MM
)
APARTS = np.append(np.arange(0.05, 0.5, 0.05), np.arange(0.5, 1.81, 0.1))
REDRAWN, STUDIES = 30, 60
ROWS, CELL = 20, 0.11  # of the strip of draws, and metres between its dots
BAND = np.array([[0, 1, 2], [1, 3, 2]])
VOTES = Chart("Votes of each draw", "draw", "votes", y_range=(0.0, 40.0))
CHANCE = Chart(
    "Chance that all are spoilt", "samples drawn", "%", x_range=(0.0, 100.0), y_range=(0.0, 100.0)
)
WIDTH = Chart(
    "Error of the finished line",
    "half the width of the band",
    "mm",
    x_range=(0.0, 300.0),
    near=(0.0, 120.0),
    x_unit="mm",
    y_range=(0.0, 30.0),
)
APART = Chart(
    "Votes and distance",
    "distance between the two points",
    "votes",
    x_range=(0.0, 1.8),
    x_unit="m",
    y_range=(0.0, 35.0),
)
CLEAN = {2: "a line, m = 2", 3: "a plane, m = 3", 4: "m = 4", 7: "m = 7"}


@dataclass(frozen=True, eq=False)
class Draw:
    """Two rows drawn, the line through them, and which rows vote for it."""

    n: int
    sample: np.ndarray
    line: np.ndarray
    votes: np.ndarray


@dataclass(frozen=True)
class Width:
    """How far the band around the true line reaches to either side, metres."""

    width: float


@dataclass(frozen=True, eq=False)
class Fan:
    """Two points of the true line so far apart (m), their noise redrawn: lines (n, 3), votes
    (n,).
    """

    apart: float
    p_pair: np.ndarray
    lines: np.ndarray
    votes: np.ndarray


State = Draw | Width | Fan


@cached
def scattered(params: Input) -> Subject:
    """Return points of a line and clutter all over its window."""
    rng = np.random.default_rng(params.scene_seed)
    made = scattered_line_scene(
        rng, count=params.points, outlier_ratio=params.outliers, sigma=params.noise
    )
    window = np.array([1.1, 1.1])
    return Subject(
        model=LINE,
        p=made.p,
        truth=made.truth,
        p_true=made.p_true,
        is_inlier=made.is_inlier,
        low=-window,
        high=window,
        places=(stand_up,),
        rivals={"least squares": LINE.refit(made.p)},
    )


def run(params: Input, subject: Subject) -> Iterator[State]:
    """Yield pairs drawn by chance, or ever wider bands, or pairs ever farther apart."""
    if params.stage == "draws":
        yield from _draws(params, subject)
    elif params.stage == "band":
        yield from (Width(float(width)) for width in WIDTHS)
    else:
        yield from (fan(params, subject, float(apart)) for apart in APARTS)


def _draws(params: Input, subject: Subject) -> Iterator[Draw]:
    rng = np.random.default_rng(params.seed)
    samples = uniform_samples(len(subject.p), 2, rng)
    for n in range(1, min(params.most_samples, MOST_DRAWS) + 1):
        chosen = chosen_sample(params, subject) if n == 1 else []
        sample = chosen[0] if chosen else next(samples)
        line = LINE.solve(subject.p[sample][None])[0]
        yield Draw(n, sample, line, LINE.distances(line, subject.p) <= params.inlier_distance)


def fan(params: Input, subject: Subject, apart: float) -> Fan:
    """Return the lines through two points whose noise is drawn thirty times."""
    assert subject.truth is not None
    a, b, c = subject.truth
    p_pair = np.array([0.0, -c / b]) + apart * np.array([[-0.5], [0.5]]) * [b, -a]
    noise = np.random.default_rng(params.seed).normal(size=(REDRAWN, 2, 2))
    lines = LINE.solve(p_pair + params.noise * noise)
    votes = (LINE.distances(lines, subject.p) <= params.inlier_distance).sum(axis=1)
    return Fan(apart, p_pair, lines, votes)


@cached
def errors_by_width(params: Input) -> np.ndarray:
    """Return the error of the finished fit (m) for each of WIDTHS: the median over sixty scenes."""
    errors = np.zeros((STUDIES, len(WIDTHS)))
    for k in range(STUDIES):
        rng = np.random.default_rng(k)
        made = scattered_line_scene(
            rng, count=params.points, outlier_ratio=params.outliers, sigma=params.noise
        )
        lines = LINE.solve(made.p[draw_samples(len(made.p), 2, 200, rng=rng)])
        off = LINE.distances(lines, made.p)
        for i, width in enumerate(WIDTHS):
            line = lines[(off <= width).sum(axis=1).argmax()]
            for _ in range(5):
                line = LINE.refit(made.p[LINE.distances(line, made.p) <= width])
            errors[k, i] = np.sqrt((LINE.distances(line, made.p_true) ** 2).mean())
    return np.median(errors, axis=0)


@cached
def votes_by_distance(params: Input) -> np.ndarray:
    """Return the median votes of a fan for each of APARTS."""
    subject = scattered(params)
    return np.array([np.median(fan(params, subject, float(apart)).votes) for apart in APARTS])


def spoilt(share: float, size: int, samples: np.ndarray | float) -> np.ndarray:
    """Return the chance, in percent, that each of so many samples holds a point that is not
    true.
    """
    return 100.0 * (1.0 - share**size) ** np.asarray(samples, float)


def known(subject: Subject) -> np.ndarray:
    """Return which points were made from the line."""
    assert subject.is_inlier is not None
    return subject.is_inlier


@lru_cache(maxsize=16)
def rings(subject: Subject) -> np.ndarray:
    """Return rings, standing upright, around the points that were made from the line."""
    p = subject.p[known(subject)]
    return np.concatenate([segments(stand_up(q + RING * circle(24), 0.012)) for q in p])


def draw(look: Look[Input, Subject, State]) -> Scene:
    """Return the points, who votes, and what this stage is about."""
    subject, now = look.subject, look.now
    scene: dict[str, Primitive] = {"frame": Segments(frames(subject), "neutral", 1.0, opacity=0.5)}
    if look.params.who_is_right:
        scene["rings"] = Segments(rings(subject), "truth", 1.5, name="who is right")
    if isinstance(now, Draw):
        return scene | _of_draw(look, now)
    return scene | (_of_width(look, now) if isinstance(now, Width) else _of_fan(look, now))


def _points(subject: Subject, votes: np.ndarray | None = None) -> Points:
    color: Color = "neutral"
    if votes is not None:
        color = Classes.marking(~votes, "neutral", "votes against", others=("target", "votes for"))
    return Points(subject.shown[0], color, DOT, name="points")


def _line(
    path: str, subject: Subject, line: np.ndarray, color: Role, name: str
) -> dict[str, Primitive]:
    return {path: Segments(outline(subject, line, np.zeros(0, np.intp)), color, 3.0, name=name)}


def _band(subject: Subject, line: np.ndarray, reach: float, color: Role) -> dict[str, Primitive]:
    edges, corners = slab(subject, line, reach)
    if not len(edges):
        return {}
    scene: dict[str, Primitive] = {"band": Segments(edges, color, 1.0, opacity=0.6)}
    if len(corners):
        scene["band/area"] = Mesh(corners, BAND, color, opacity=0.2, flat=True)
        at = corners[np.argmin(corners[:, 0] - 0.1 * corners[:, 2])] + np.array([0.16, 0.0, 0.1])
        scene["band/name"] = Label(f"± {brief(MM * reach)} mm", at, color)
    return scene


def _of_draw(look: Look[Input, Subject, State], now: Draw) -> dict[str, Primitive]:
    params, subject = look.params, look.subject
    draws = [one for one in (*look.past, now) if isinstance(one, Draw)]
    votes, clean = int(now.votes.sum()), clean_draws(subject, draws)
    best = max(int(one.votes.sum()) for one in draws)
    numbers = np.arange(1.0, min(params.most_samples, MOST_DRAWS) + 1.0)
    scene: dict[str, Primitive] = {
        "points": _points(subject, now.votes),
        **_line("line", subject, now.line, "highlight", "line through the two"),
        **_band(subject, now.line, params.inlier_distance, "highlight"),
        "sample": Points(
            stand_up(subject.p[now.sample], 0.01), "highlight", 1.6 * DOT, name="the sample"
        ),
        "count": Label(f"{votes} votes of {len(subject.p)}", np.array([0.0, 0.0, 1.88]), "target"),
        "draw": Chart("Draw").scalar(now.n, "draw"),
        "votes/whole": VOTES.whole(numbers, _all_votes(params), "votes", "target"),
        "votes/mark": VOTES.mark(now.n, votes, "this draw", "target", steps="draw"),
        "best": Chart("Best").scalar(best, "best so far"),
    }
    if params.who_is_right:
        dots = _strip(len(draws))
        color = Classes.marking(~clean, "neutral", "spoilt", others=("truth", "clean sample"))
        scene["strip"] = Points(dots, color, 0.035, name="samples so far")
        words = f"{int(clean.sum())} of {now.n} are clean"
        scene["strip/count"] = Label(words, np.array([1.5, 0.0, 1.88]), "truth")
        scene["clean"] = Chart("Clean samples").scalar(int(clean.sum()), "clean samples", "truth")
        scene |= chances(1.0 - params.outliers, 2, now.n)
    else:
        scene |= _line(
            "squares", subject, sure(subject.rivals)["least squares"], "other", "least squares"
        )
        slope = abs(np.degrees(np.arctan2(*line_direction(subject))))
        scene["squares/off"] = Chart("Least squares").scalar(slope, "least squares off", "other")
    return scene | {"caption": _said_of_draw(look, now, clean, best)}


def line_direction(subject: Subject) -> tuple[float, float]:
    """Return sine and cosine of the angle from the true line to that of least squares."""
    assert subject.truth is not None
    (a, b), (c, d) = subject.truth[:2], sure(subject.rivals)["least squares"][:2]
    return float(a * d - b * c), float(abs(a * c + b * d))


@cached
def _all_votes(params: Input) -> np.ndarray:
    return np.array([one.votes.sum() for one in _draws(params, scattered(params))], float)


def clean_draws(subject: Subject, draws: list[Draw]) -> np.ndarray:
    """Return which samples hold points of the line alone."""
    return np.array([known(subject)[one.sample].all() for one in draws])


def _strip(count: int) -> np.ndarray:
    k = np.arange(count)
    x, z = 1.28 + CELL * (k // ROWS), 1.75 - CELL * (k % ROWS)
    return np.column_stack([x, np.zeros(count), z])


def chances(share: float, size: int, drawn: int) -> dict[str, Primitive]:
    """Return the chance that all are spoilt over the samples drawn, for several sizes of sample."""
    numbers = np.arange(0.0, 101.0)
    scene: dict[str, Primitive] = {}
    for m, name in CLEAN.items():
        color: Role = "source" if m == size else "neutral"
        scene[f"chance/{m}"] = CHANCE.whole(numbers, spoilt(share, m, numbers), name, color)
    at = min(float(drawn), 100.0)
    here = float(spoilt(share, size, at))
    scene["chance/mark"] = CHANCE.mark(at, here, "drawn so far", steps="draw" if size == 2 else "")
    if 0.0 < share < 1.0 and (enough := np.log(0.01) / np.log(1.0 - share**size)) < 100.0:
        scene["chance/enough"] = CHANCE.band(float(np.ceil(enough)), 100.0, "under 1 %", "truth")
    return scene


def _of_width(look: Look[Input, Subject, State], now: Width) -> dict[str, Primitive]:
    params, subject = look.params, look.subject
    assert subject.truth is not None
    votes = LINE.distances(subject.truth, subject.p) <= now.width
    true = known(subject)
    ringed, others = int(votes[true].sum()), int(votes[~true].sum())
    errors = MM * errors_by_width(params)
    n, m = int(true.sum()), int((~true).sum())
    here = float(np.interp(now.width, WIDTHS, errors))
    return {
        "points": _points(subject, votes),
        **_line("truth", subject, subject.truth, "truth", "true line"),
        **_band(subject, subject.truth, now.width, "target"),
        "ringed": Label(
            f"{ringed} of {n} ringed points vote", np.array([-0.5, 0.0, 1.88]), "truth"
        ),
        "others": Label(f"{others} of {m} others vote", np.array([0.6, 0.0, 1.88]), "neutral"),
        "width": Chart("Width", unit="mm").scalar(MM * now.width, "width"),
        "error/whole": WIDTH.whole(MM * WIDTHS, errors, "median error of 60 scenes", "source"),
        "error/mark": WIDTH.mark(MM * now.width, here, "this band", "source", steps="width"),
        "caption": say(
            "Within {width} of the true line: {ringed} of its {points} points, and {others}"
            " others.",
            width=_mm(now.width),
            ringed=ringed,
            points=n,
            others=others,
        ),
    }


def _of_fan(look: Look[Input, Subject, State], now: Fan) -> dict[str, Primitive]:
    params, subject = look.params, look.subject
    middle = float(np.median(now.votes))
    ends = subject.places[0](
        clip_lines(now.lines, subject.low, subject.high).reshape(-1, 2)
    ).reshape(-1, 2, 3)
    return {
        "points": _points(subject),
        "fan": Segments(ends, "highlight", 1.0, opacity=0.6, name="lines through noisy pairs"),
        "pair": Points(stand_up(now.p_pair, 0.01), "highlight", 1.6 * DOT, name="the two points"),
        "count": Label(
            f"{brief(middle)} votes in the median", np.array([0.0, 0.0, 1.88]), "target"
        ),
        "apart": Chart("Distance of the two", unit="m").scalar(now.apart, "apart"),
        "votes-median": Chart("Median votes").scalar(middle, "votes in the median", "target"),
        "apart/whole": APART.whole(APARTS, votes_by_distance(params), "median votes", "target"),
        "apart/mark": APART.mark(now.apart, middle, "these two", "target", steps="apart"),
        "caption": say(
            "Two points {apart} apart: their thirty lines get {votes} votes in the median.",
            apart=Quantity(now.apart, f"{brief(now.apart)} m"),
            votes=middle,
        ),
    }


def _mm(value: float) -> Quantity:
    return Quantity(value, f"{brief(MM * value)} mm")


def _said_of_draw(
    look: Look[Input, Subject, State], now: Draw, clean: np.ndarray, best: int
) -> Caption:
    votes, draws = int(now.votes.sum()), counted(now.n, "draw")
    place = "clean" if look.params.who_is_right and clean[-1] else ""
    if look.params.who_is_right:
        return say(
            "Draw {n} is {what}: {clean} of {n} so far are clean.",
            n=now.n,
            what="clean" if clean[-1] else "spoilt",
            clean=int(clean.sum()),
            place=place,
        )
    words = "Draw {n}: {votes} of {all} points vote for this line. The best of {draws} has {best}."
    return say(words, n=now.n, votes=votes, all=len(now.votes), draws=draws, best=best)
