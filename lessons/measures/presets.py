"""Experiments that show what each sum takes for granted, and what to predict before looking."""

from collections.abc import Sequence

import numpy as np

from lessons.measures.state import Params, State
from workbench.algorithms.surfaces.measures import Cells, Sums
from workbench.algorithms.surfaces.monte_carlo import Balls, Throws
from workbench.certain import as_a
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import brief, fixed, percent

VIEW = View(eye=(2.3, -3.5, 1.7), target=(-0.05, -0.3, 0.0), grid=None, axes=False)
MIDDLE = View(eye=(2.0, -3.6, 1.6), target=(0.0, 0.0, 0.0), grid=None, axes=False)
WIDE = View(eye=(2.6, -4.7, 2.1), target=(0.0, 0.0, 0.0), grid=None, axes=False)
BEHIND = View(eye=(1.1, -4.0, 1.6), target=(0.3, 0.3, 0.0), grid=None, axes=False)
FRONT = View(eye=(0.0, -3.9, 0.25), target=(0.0, 0.0, 0.2), grid=None, axes=False)

HOLE = Params(origin=(1.0, 2.7, -0.6), hole=0.01)
INSCRIBED = Params(shape="sphere")
STAIRCASE = Params(method="voxels", shape="sphere", cells=64)
LANTERN = Params(shape="lantern")
THROWS = Params(method="chance", shape="sphere", throws=100_000)
LINES = Params(method="lines", throws=4000)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "origin",
        "The origin far away",
        "The origin is seven diagonals away: all plus together are 12 times the rabbit, all minus"
        " 11 times. What is left?",
        Params(origin=(-12.0, -16.0, -8.0)),
        15,
        MIDDLE,
    ),
    Preset(
        "hole",
        "A hole",
        "1 % of the triangles is cut out, on the side you see. From an origin one diagonal behind,"
        " 6.6 % of the volume go with them. Every origin has its own number.",
        HOLE,
        15,
        BEHIND,
        breaks=True,
    ),
    Preset(
        "flipped",
        "Faces turned round",
        "5 % of the triangles are turned round, and each counts with the other sign: 10 % of the"
        " volume are gone, 6 to 13 % with other seeds, and of the area nothing.",
        Params(flipped=0.05),
        -1,
        breaks=True,
    ),
    Preset(
        "overlap",
        "Two spheres that overlap",
        "Two closed meshes as one: every tetrahedron is right, and what lies in both spheres is"
        " counted twice.",
        Params(shape="two spheres", origin=(0.0, -2.0, -0.6)),
        12,
        WIDE,
        breaks=True,
    ),
    Preset(
        "union",
        "The same in voxels",
        "A cell is full when its middle lies in either sphere, so nothing is counted twice: 0.1 %"
        " off with 32 cells, where the meshes were 17.5 %.",
        Params(method="voxels", shape="two spheres"),
        -3,
        WIDE,
    ),
    Preset(
        "inscribed",
        "A sphere of triangles",
        "All vertices lie on the sphere, and the triangles cut below it. In the last step the edges"
        " are halved again and again: read the slope.",
        INSCRIBED,
        15,
        MIDDLE,
    ),
    Preset(
        "staircase",
        "Ever smaller cells",
        "From 4 to 64 cells across: the volume comes ever closer. Compare it with the area of the"
        " walls, and with that by marching cubes.",
        STAIRCASE,
        0,
        MIDDLE,
    ),
    Preset(
        "lantern",
        "Schwarz's lantern",
        "All vertices lie on the cylinder, 11 in a ring, in 121 bands. Then ever more sectors, and"
        " three ways to choose the number of rings.",
        LANTERN,
        0,
        MIDDLE,
        breaks=True,
    ),
    Preset(
        "throws",
        "Throws of dice",
        "Up to 100,000 points in a cube: count those in the ball. Watch the interval close, how"
        " slowly, and how often it misses the truth if you look at every step.",
        THROWS,
        12,
        WIDE,
    ),
    Preset(
        "stratified",
        "One throw in each small cube",
        "The same, but the box is cut into equal cubes with one throw in each: no clumps, no gaps,"
        " and an error that falls faster.",
        Params(method="chance", shape="sphere", throws=100_000, draw="stratified"),
        12,
        WIDE,
    ),
    Preset(
        "sobol",
        "Sobol's sequence",
        "Every power of two of these points is spread evenly however the box is halved. Compare the"
        " error with that of random throws.",
        Params(method="chance", shape="sphere", throws=100_000, draw="Sobol"),
        6,
        WIDE,
    ),
    Preset(
        "dimensions",
        "The ball in many dimensions",
        "100,000 throws into a cube of 2 to 20 dimensions. The picture has the first three"
        " coordinates: look for what still hits.",
        Params(method="dimensions", throws=100_000),
        1,
        WIDE,
        breaks=True,
    ),
    Preset(
        "alike",
        "Every face as likely",
        "The faces of one half were cut in four. Whoever picks all faces alike puts 86 % of the"
        " points there, for 60 % of the area.",
        Params(method="samples", throws=5000, pick="all alike"),
        -1,
        MIDDLE,
        breaks=True,
    ),
    Preset(
        "no-root",
        "The forgotten root",
        "Two random numbers make a point of a triangle. Without the square root half of all points"
        " crowd at corner a.",
        Params(method="samples", throws=5000, place="without the root"),
        3,
        FRONT,
        breaks=True,
    ),
    Preset(
        "normalised",
        "Three numbers, normalised",
        "Three random weights divided by their sum: half of all points crowd in the middle quarter,"
        " and the corners starve.",
        Params(method="samples", throws=5000, place="normalised"),
        3,
        FRONT,
        breaks=True,
    ),
    Preset(
        "lines",
        "An area from lines alone",
        "Random lines through a ball around the rabbit, and how often each crosses its surface:"
        " nothing else tells the area, 0.4 % off with 4,000 lines.",
        LINES,
        -1,
        MIDDLE,
    ),
)


def sums_of(states: Sequence[State]) -> Sums:
    """Return all faces added up."""
    return as_a(Sums, next(state.now for state in reversed(states) if state.study is None))


def _walls(states: Sequence[State]) -> list[float]:
    """Return the area of the walls over the true area, grid by grid."""
    cells = as_a(Cells, states[-1].now)
    return [area / states[-1].subject.area for area in cells.areas]


def _walls_answer(states: Sequence[State]) -> float:
    ends = _walls(states)[-3:]
    if ends[-1] > 1.1 * ends[0]:
        return 2.0
    return 0.0 if ends[-1] < 1.05 else 1.0


def _walls_why(states: Sequence[State]) -> str:
    shares = _walls(states)
    return (
        f"With 16 cells {fixed(shares[4], 2)} times, with 64 cells {fixed(shares[-1], 2)} times."
        " Steps stay steps: each wall is seen along an axis, and a slanted piece of surface is"
        " replaced by its three shadows, however small the cells."
    )


def _tenth(states: Sequence[State]) -> float:
    """Return how many times as many throws divide the standard error of a thousand by ten."""
    throws = as_a(Throws, states[-1].now)
    counts, errors = np.array(throws.estimates.counts), np.array(throws.estimates.errors)
    start = int(np.argmin(np.abs(counts - 1000)))
    end = int(np.argmin(np.abs(errors - errors[start] / 10)))
    return float(counts[end] / counts[start])


def _tenth_why(states: Sequence[State]) -> str:
    throws = as_a(Throws, states[-1].now)
    share = dict(
        zip(
            throws.estimates.counts,
            np.array(throws.estimates.errors) / states[-1].subject.volume,
            strict=True,
        )
    )
    return (
        f"{brief(_tenth(states), 2)} times: the standard error falls from {percent(share[1000])} at"
        f" 1,000 throws to {percent(share[100_000])} at 100,000, with one over the root of their"
        " number."
    )


def _hits(states: Sequence[State]) -> int:
    balls = as_a(Balls, states[-1].now)
    return balls.hits[-1]


def _shrinks(states: Sequence[State]) -> tuple[float, float]:
    last = next(state for state in reversed(states) if state.study is None)
    return -last.area_error, -last.volume_error


def _lantern_share(states: Sequence[State]) -> float:
    return sums_of(states).area / states[-1].subject.area


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-walls",
        "A sphere is made into ever smaller cubes. What becomes of the area of their outer walls?",
        answer=_walls_answer,
        why=_walls_why,
        params=STAIRCASE,
        choices=(
            Choice(
                "It tends to the sphere's area",
                why=(
                    "The cubes do come as near to the sphere as you like. Their walls do not turn:"
                    " a staircase is no ramp."
                ),
            ),
            "It stays too large by a fixed share",
            Choice(
                "It grows without end",
                why=(
                    "There are ever more walls, four times as many for half the edge. Each has a"
                    " quarter of the area."
                ),
            ),
        ),
    ),
    Question(
        "predict-tenth",
        "1,000 throws leave a standard error of some 3 %. How many times as many bring it to a"
        " tenth of that?",
        answer=_tenth,
        why=_tenth_why,
        params=THROWS,
        unit="times",
        tolerance=20.0,
        wrong=(
            (
                9.0,
                11.0,
                (
                    "That would hold if the error fell with the number of throws. It falls with the"
                    " root of it."
                ),
            ),
            (
                900.0,
                1100.0,
                (
                    "Three dimensions do not enter: a throw is in or out, and only the number of"
                    " throws counts."
                ),
            ),
            (
                3.0,
                3.5,
                "The root of ten is what ten times as many throws gain. You need the square.",
            ),
        ),
    ),
    Question(
        "predict-hits",
        "100,000 points are thrown into a cube of ten dimensions. How many land in the ball that"
        " touches all its sides?",
        answer=lambda states: float(
            np.argmin(np.abs(np.log10([25_000, 2_500, 250, 2.5]) - np.log10(_hits(states))))
        ),
        why=lambda states: (
            f"{_hits(states):,}. The corners take over: at ten dimensions the ball fills a quarter"
            " of a per cent of its cube, and at twenty no throw finds it."
        ),
        params=Params(method="dimensions", throws=100_000, dimension=10),
        choices=(
            Choice(
                "some 25,000",
                why=(
                    "In five dimensions it is 16,000 already. With every dimension more of the cube"
                    " lies in its corners."
                ),
            ),
            Choice(
                "some 2,500",
                why=(
                    "That is about seven or eight dimensions. Each further one takes more than"
                    " half."
                ),
            ),
            "some 250",
            Choice(
                "two or three",
                why="That is about fifteen dimensions. π⁵ / 120 / 2¹⁰ is what a ball of ten fills.",
            ),
        ),
    ),
    Question(
        "predict-inscribed",
        "642 vertices on a unit sphere, joined by triangles: which of the two loses the larger"
        " share?",
        answer=lambda states: 0.0 if _shrinks(states)[0] > _shrinks(states)[1] else 1.0,
        why=lambda states: (
            f"The area is {percent(_shrinks(states)[0])} too small, the volume"
            f" {percent(_shrinks(states)[1])}. Both fall with the square of the edges."
        ),
        params=INSCRIBED,
        choices=(
            Choice(
                "the area",
                why=(
                    "Triangles are smaller than their piece of the sphere. They are also nearer to"
                    " the middle, which counts for the volume only."
                ),
            ),
            "the volume",
        ),
    ),
    Question(
        "predict-lantern",
        "A cylinder is made of 2,662 triangles: 11 vertices in a ring, 121 bands, every vertex on"
        " the cylinder. How large is their area?",
        answer=lambda states: float(
            np.argmin(np.abs(np.array([0.97, 1.03, 4.93]) - _lantern_share(states)))
        ),
        why=lambda states: (
            f"{fixed(_lantern_share(states), 2)} times that of the cylinder. The bands are so low"
            " that their triangles lie almost level: points on a surface do not make triangles"
            " along it."
        ),
        params=LANTERN,
        choices=(
            Choice(
                "a little smaller than the cylinder's",
                why=(
                    "That holds for a polygon in a circle. In space a triangle with corners on the"
                    " surface may stand across it."
                ),
            ),
            Choice(
                "a little larger",
                why=(
                    "The triangles do stand out of the wall, but by 78°, not a little: bands are"
                    " far lower than sectors are wide."
                ),
            ),
            "about five times as large",
        ),
    ),
)
