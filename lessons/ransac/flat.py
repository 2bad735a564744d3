"""The stages in the flat: one line among clutter, held by hand. A vote is a colour, the truth a
ring.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from lessons.ransac.inputs import Input
from lessons.ransac.rows import Subject, stand_up
from lessons.ransac.search import chosen_sample
from lessons.ransac.shapes import MM, band, frames, marked, outline
from lessons.ransac.widths import STUDIED, WIDTHS, errors_by_width, line_scene, studies
from workbench.algorithms.robust.models import LINE
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.captions import Quantity, counted
from workbench.certain import sure
from workbench.geometry.clipping import clip_lines
from workbench.geometry.polylines import circle, segments
from workbench.lesson import Look, cached, say
from workbench.numerals import brief
from workbench.scene import Chart, Classes, Label, Points, Primitive, Role, Scene, Segments

MOST_DRAWS = 100
DOT = 0.03  # metres: the radius of a point
APARTS = np.append(np.arange(0.05, 0.5, 0.05), np.arange(0.5, 1.81, 0.1))
REDRAWN = 30  # times the noise of two points
VOTES = Chart("Votes of each draw", "draw", y_range=(0.0, 40.0))
CHANCE = Chart(
    "Chance that all are spoilt",
    "samples drawn",
    "%",
    x_range=(0.0, 100.0),
    y_range=(0.1, 100.0),
    log=True,
)
COUNTS = Chart("Votes", "half the width of the band", x_range=(0.0, 300.0), x_unit="mm")
WIDTH = Chart(
    "Error of the finished line",
    "half the width of the band",
    "mm",
    x_range=(0.0, 300.0),
    x_unit="mm",
    y_range=(0.0, 30.0),
)
APART = Chart(
    "Median votes",
    "distance between the two points",
    x_range=(0.0, 1.8),
    x_unit="m",
    y_range=(0.0, 35.0),
)
SIZES = {2: "a line, m = 2", 3: "a plane, m = 3", 4: "m = 4", 7: "m = 7"}


@dataclass(frozen=True, eq=False)
class Draw:
    """Two rows drawn, the line through them, who votes for it, and whether both rows are true."""

    n: int
    sample: np.ndarray
    line: np.ndarray
    votes: np.ndarray
    clean: bool


@dataclass(frozen=True, eq=False)
class Width:
    """How far the band around the true line reaches to either side (m), and who is in it."""

    width: float
    votes: np.ndarray


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
FlatLook = Look[Input, Subject, State]


@cached
def scattered(params: Input) -> Subject:
    """Return points of a line and clutter all over its window."""
    made = line_scene(params, params.scene_seed)
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
        yield from draws(params)
    elif params.stage == "band":
        off = LINE.distances(sure(subject.truth), subject.p)
        yield from (Width(float(width), off <= width) for width in WIDTHS)
    else:
        yield from (fan(params, subject, float(apart)) for apart in APARTS)


@cached
def draws(params: Input) -> tuple[Draw, ...]:
    """Return all draws of two points."""
    subject = scattered(params)
    samples = uniform_samples(len(subject.p), 2, np.random.default_rng(params.seed))
    pairs = []
    for n in range(1, min(params.most_samples, MOST_DRAWS) + 1):
        chosen = chosen_sample(params, subject) if n == 1 else []
        sample = chosen[0] if chosen else next(samples)
        line = LINE.solve(subject.p[sample][None])[0]
        votes = LINE.distances(line, subject.p) <= params.inlier_distance
        pairs.append(Draw(n, sample, line, votes, bool(sure(subject.is_inlier)[sample].all())))
    return tuple(pairs)


def fan(params: Input, subject: Subject, apart: float) -> Fan:
    """Return the lines through two points whose noise is drawn thirty times."""
    a, b, c = sure(subject.truth)
    p_pair = np.array([0.0, -c / b]) + apart * np.array([[-0.5], [0.5]]) * [b, -a]
    noise = np.random.default_rng(params.seed).normal(size=(REDRAWN, 2, 2))
    lines = LINE.solve(p_pair + params.noise * noise)
    votes = (LINE.distances(lines, subject.p) <= params.inlier_distance).sum(axis=1)
    return Fan(apart, p_pair, lines, votes)


@cached
def votes_by_distance(params: Input) -> np.ndarray:
    """Return the median votes of a fan for each of APARTS."""
    subject = scattered(params)
    return np.array([np.median(fan(params, subject, float(apart)).votes) for apart in APARTS])


def spoilt(share: float, size: int, samples: np.ndarray | float) -> np.ndarray:
    """Return the chance (%) that each of so many samples holds a point that is not true."""
    return 100.0 * (1.0 - share**size) ** np.asarray(samples, float)


def chances(share: float, size: int, drawn: int, *, sizes: tuple[int, ...]) -> dict[str, Primitive]:
    """Return the chance that all are spoilt over the samples drawn, for several sizes of sample."""
    numbers = np.arange(0.0, 101.0)
    scene: dict[str, Primitive] = {}
    for m in sizes:
        color: Role = "source" if m == size else "neutral"
        scene[f"chance/{m}"] = CHANCE.whole(numbers, spoilt(share, m, numbers), SIZES[m], color)
    scene["chance/second"] = CHANCE.second(np.array([0.0, 100.0]), np.ones(2), "1 %")
    at = min(float(drawn), 100.0)
    here = float(spoilt(share, size, at))
    scene["chance/mark"] = CHANCE.mark(at, here, "drawn so far", steps="draw" if size == 2 else "")
    if 0.0 < share < 1.0 and (enough := np.log(0.01) / np.log(1.0 - share**size)) < 100.0:
        scene["chance/enough"] = CHANCE.band(float(np.ceil(enough)), 100.0, "under 1 %", "truth")
    return scene


def draw(look: FlatLook) -> Scene:
    """Return the points, who votes, and what this stage is about."""
    subject, state = look.subject, look.now
    votes = None if isinstance(state, Fan) else state.votes
    scene: dict[str, Primitive] = {
        "frame": Segments(frames(subject), "neutral", 1.0, opacity=0.5),
        "points": Points(
            subject.shown[0], "neutral" if votes is None else marked(votes), DOT, name="points"
        ),
    }
    if look.params.who_is_right:
        ring = 2.0 * DOT * circle(24)
        around = [segments(stand_up(p + ring, 0.012)) for p in subject.p[sure(subject.is_inlier)]]
        scene["rings"] = Segments(np.concatenate(around), "truth", 1.5, name="who is right")
    if isinstance(state, Draw):
        return scene | _of_draw(look, state)
    return scene | (_of_width(look, state) if isinstance(state, Width) else _of_fan(look, state))


def _head(words: str, x: float, color: Role) -> Label:
    return Label(words, np.array([x, 0.0, 1.88]), color)


def _of_draw(look: FlatLook, state: Draw) -> dict[str, Primitive]:
    params, subject = look.params, look.subject
    votes = int(state.votes.sum())
    line = outline(subject, state.line)
    pair = stand_up(subject.p[state.sample], 0.01)
    tally = params.who_is_right
    scene: dict[str, Primitive] = {
        "line": Segments(line, "highlight", 3.0, name="line through the two"),
        **band(subject, state.line, "highlight", reach=params.inlier_distance, named=not tally),
        "sample": Points(pair, "highlight", 1.6 * DOT, name="the sample"),
        "count": _head(f"{votes} votes of {len(subject.p)}", 0.0, "target"),
        "draw": Chart("Draw").scalar(state.n, "draw"),
        "votes": Chart("Votes").scalar(votes, "votes", "target"),
    }
    past = draws(params)[: state.n]
    return scene | (_tally(look, state, past) if tally else _beside_squares(look, state, past))


def _beside_squares(look: FlatLook, state: Draw, past: tuple[Draw, ...]) -> dict[str, Primitive]:
    """Return the votes of all draws so far, one stroke each, and least squares over all points."""
    subject = look.subject
    votes = np.array([drawn.votes.sum() for drawn in past], float)
    gap = np.full(state.n, np.nan)
    strokes = np.column_stack([np.zeros(state.n), votes, gap]).ravel()
    squares = sure(subject.rivals)["least squares"]
    line = outline(subject, squares)
    left = line.reshape(-1, 3)[np.argmin(line[..., 0])]
    at = np.repeat(np.arange(1.0, state.n + 1.0), 3)
    chart = replace(VOTES, x_range=(0.0, min(look.params.most_samples, MOST_DRAWS)))
    words = "Draw {n}: {votes} of {all} points vote for this line. The best of {draws} has {best}."
    return {
        "squares": Segments(line, "other", 3.0, name="least squares"),
        "squares/name": Label("least squares", left - [0.45, 0.0, 0.0], "other"),
        "squares/off": Chart("Least squares").scalar(
            turned(sure(subject.truth), squares), "least squares off", "other"
        ),
        "votes/whole": chart.whole(at, strokes, "votes", "target"),
        "votes/mark": chart.mark(state.n, votes[-1], "this draw", "target", steps="draw"),
        "caption": say(
            words,
            n=state.n,
            votes=int(votes[-1]),
            all=len(state.votes),
            draws=counted(state.n, "draw"),
            best=int(votes.max()),
        ),
    }


def turned(line: np.ndarray, other: np.ndarray) -> float:
    """Return the angle between two lines (a, b, c), degrees."""
    return float(np.degrees(np.arccos(min(1.0, abs(line[:2] @ other[:2])))))


def _tally(look: FlatLook, state: Draw, past: tuple[Draw, ...]) -> dict[str, Primitive]:
    """Return a strip with one dot for each sample, and the chance that all are spoilt."""
    spoiled = np.array([not drawn.clean for drawn in past])
    clean = int((~spoiled).sum())
    column, row = np.divmod(np.arange(state.n), 20)
    dots = stand_up(np.column_stack([1.28 + 0.11 * column, 1.05 - 0.11 * row]))
    color = Classes.marking(spoiled, "neutral", "spoilt", others=("truth", "clean sample"))
    return {
        "strip": Points(dots, color, 0.035, name="samples so far"),
        "strip/count": _head(f"{clean} of {state.n} are clean", 1.5, "truth"),
        "clean": Chart("Clean samples").scalar(clean, "clean", "truth"),
        **chances(1.0 - look.params.outliers, 2, state.n, sizes=(2,)),
        "caption": say(
            "Draw {n} is {what}: {clean} of {n} so far are clean.",
            n=state.n,
            what="clean" if state.clean else "spoilt",
            clean=clean,
            place="clean" if state.clean else "",
        ),
    }


def _of_width(look: FlatLook, state: Width) -> dict[str, Primitive]:
    subject = look.subject
    truth = sure(subject.truth)
    true = sure(subject.is_inlier)
    near = LINE.distances(truth, subject.p) <= WIDTHS[:, None]
    at = MM * state.width
    scene: dict[str, Primitive] = {
        "truth": Segments(outline(subject, truth), "truth", 3.0, name="true line"),
        **band(subject, truth, "target", reach=state.width),
        "width": Chart("Width", unit="mm").scalar(at, "width"),
    }
    inside = {}
    for name, rows in (("ringed", true), ("others", ~true)):
        role: Role = "truth" if name == "ringed" else "neutral"
        inside[name] = int(state.votes[rows].sum())
        noun = "ringed points" if name == "ringed" else name
        scene[f"{name}/whole"] = COUNTS.whole(MM * WIDTHS, near[:, rows].sum(axis=1), noun, role)
        scene[f"{name}/mark"] = COUNTS.mark(at, inside[name], noun, role, steps="width")
    ringed, others = inside["ringed"], inside["others"]
    scene["counts"] = _head(f"{ringed} ringed, {others} other votes", 0.0, "target")
    errors = MM * errors_by_width(look.params)
    here = float(np.interp(state.width, STUDIED, errors))
    drawn = f"median error of {studies(look.params)} scenes"
    words = "Within {width} of the true line: {ringed} of its {points} points, and {others}."
    return scene | {
        "error/whole": WIDTH.whole(MM * STUDIED, errors, drawn, "source"),
        "error/mark": WIDTH.mark(at, here, "this band", "source", steps="width"),
        "caption": say(
            words,
            width=Quantity(state.width, f"{brief(at)} mm"),
            points=int(true.sum()),
            ringed=ringed,
            others=counted(others, "other"),
        ),
    }


def _of_fan(look: FlatLook, state: Fan) -> dict[str, Primitive]:
    subject = look.subject
    middle = float(np.median(state.votes))
    ends = stand_up(clip_lines(state.lines, subject.low, subject.high).reshape(-1, 2))
    median = votes_by_distance(look.params)
    return {
        "fan": Segments(
            ends.reshape(-1, 2, 3), "highlight", 1.0, opacity=0.6, name="lines through noisy pairs"
        ),
        "pair": Points(stand_up(state.p_pair, 0.01), "highlight", 1.6 * DOT, name="the two points"),
        "count": _head(f"{brief(middle)} votes in the median", 0.0, "target"),
        "apart": Chart("Distance of the two", unit="m").scalar(state.apart, "apart"),
        "votes-median": Chart("Votes in the median").scalar(
            middle, "votes in the median", "target"
        ),
        "apart/whole": APART.whole(APARTS, median, "median votes", "target"),
        "apart/mark": APART.mark(state.apart, middle, "these two", "target", steps="apart"),
        "caption": say(
            "Two points {apart} apart: their thirty lines get {votes} votes in the median.",
            apart=Quantity(state.apart, f"{brief(state.apart)} m"),
            votes=middle,
        ),
    }
