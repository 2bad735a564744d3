"""Experiments that show what each form is good for, and what to predict before looking."""

from collections.abc import Sequence

import numpy as np

from lessons.representations.captions import field_error
from lessons.representations.state import Params, State
from workbench.algorithms.spatial.octree import Level
from workbench.certain import sure
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import brief, length, percent

VIEW = View(eye=(1.25, -3.85, 2.2), target=(0.05, 0.0, 0.56), grid=None, axes=False)
ALONE = View(eye=(1.35, -2.6, 1.5), target=(0.0, 0.0, -0.05), grid=None, axes=False)
PATCH = View(eye=(2.2, 2.0, 1.5), target=(0.15, 0.1, 0.0), grid=None, axes=False)
NEAR = View(eye=(1.7, -3.8, 1.6), target=(0.1, -0.2, 0.0), grid=None, axes=False)
WIDE = View(eye=(2.1, -4.2, 2.2), target=(0.0, 0.0, -0.05), grid=None, axes=False)

BINARY = Params(form="voxels", resolution=64)
UNION = Params(shape="two boxes")
OCTREE = Params(form="octree", depth=7)
SEARCH = Params(form="k-d tree", points=1000)
RATIONAL = Params(form="patches", rational=True)
NEURAL = Params(form="neural", iterations=1000)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "binary",
        "Bits",
        "One bit for each cell, ever smaller cells. Compare volume, area and normals of what comes"
        " back with the truth.",
        BINARY,
        4,
        ALONE,
    ),
    Preset(
        "edges",
        "Sharp edges",
        "A box from its distances: marching cubes bevels every edge. Watch the worst error beside"
        " the edge of a cell.",
        Params(shape="box"),
        5,
        breaks=True,
    ),
    Preset(
        "thin",
        "Thinner than a cell",
        "A plate half a cell thick, lying somehow. Between two positive distances nobody looks for"
        " a surface.",
        Params(shape="plate"),
        -1,
        breaks=True,
    ),
    Preset(
        "union",
        "The smaller of two distances",
        "Two boxes that overlap by 10 cm, stored as the smaller of both distances. The surface is"
        " fine: look inside.",
        UNION,
        9,
        breaks=True,
    ),
    Preset(
        "cloud",
        "Points alone",
        "From 100 to 100,000 points: the largest hole closes, and slowly. Four times the points,"
        " half the distance.",
        Params(form="cloud", points=100_000),
        4,
        ALONE,
    ),
    Preset(
        "triangles",
        "Triangles",
        "Vertices on the torus, and flat triangles between them: twice the vertices, half the"
        " error.",
        Params(form="mesh"),
        2,
        ALONE,
    ),
    Preset(
        "octree",
        "Only where the surface is",
        "Cells that the surface may cross are cut in eight. Compare what the tree takes with bits"
        " for all cells.",
        OCTREE,
        4,
        WIDE,
    ),
    Preset(
        "neighbours",
        "Who is whose neighbour",
        "600 points, each joined to ever more of its nearest ones: pieces become one, and edges"
        " leave the surface.",
        Params(form="neighbours", shape="rabbit", points=600, neighbours=10),
        5,
        ALONE,
        breaks=True,
    ),
    Preset(
        "search",
        "The nearest of a thousand",
        "Points in no order, then cut at the median again and again: watch how few cells the search"
        " looks into.",
        SEARCH,
        3,
        NEAR,
    ),
    Preset(
        "twenty",
        "The same in twenty dimensions",
        "4,000 points with 20 coordinates, three of which are drawn. Watch the share that is"
        " looked at.",
        Params(form="k-d tree", dimensions=20),
        7,
        WIDE,
        breaks=True,
    ),
    Preset(
        "cubic",
        "A torus of Bézier patches",
        "16 patches from 144 control points. Watch one point come about by dividing legs, then the"
        " error of all.",
        Params(form="patches"),
        3,
        PATCH,
    ),
    Preset(
        "rational",
        "With weights",
        "Fewer control points, each with a weight: a circle is a quotient of polynomials, and no"
        " polynomial.",
        RATIONAL,
        0,
        PATCH,
    ),
    Preset(
        "neural",
        "A network learns the distance",
        "1,601 numbers, steps of Adam: the loss falls, and the surface where the field is zero"
        " takes shape.",
        NEURAL,
        4,
    ),
    Preset(
        "plain",
        "Without sines and cosines",
        "The same network is given the coordinates alone: it learns smooth things first. After 300"
        " iterations it is 78 mm off on average, where sines and cosines leave 19 mm.",
        Params(form="neural", features=0),
        -2,
        breaks=True,
    ),
    Preset(
        "clamp",
        "A loss that dies",
        "Distances clamped at 10 cm, as DeepSDF does: where the output is beyond that, its gradient"
        " is zero. What is left of the surface?",
        Params(form="neural", shape="box", target="clamped", seed=1),
        -1,
        breaks=True,
    ),
    Preset(
        "rabbit",
        "The rabbit in a network",
        "Three octaves of sines: ears and paws come last. Compare with a grid of distances of as"
        " many bytes.",
        Params(form="neural", shape="rabbit", features=3),
        6,
    ),
)


def _levels(states: Sequence[State]) -> list[Level]:
    return [state.now for state in states[:-1] if isinstance(state.now, Level)]


def _octree_factor(states: Sequence[State]) -> float:
    before, last = _levels(states)[-2:]
    return last.packed_bytes / before.packed_bytes


def _areas(states: Sequence[State]) -> list[float]:
    return [state.surface.area for state in states[:-1] if state.surface is not None]


def _looked(states: Sequence[State]) -> tuple[float, float]:
    growth = sure(states[-1].growth)
    return float(growth.looked[1]), float(growth.looked[-1])


def _middle(states: Sequence[State]) -> tuple[float, float]:
    return sure(field_error(states[-1]))


def _patch_error(states: Sequence[State]) -> float:
    surface = sure(states[-1].surface)
    return surface.worst


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "predict-half",
        "Cells with edges half as long: a grid of bits takes 8 times the bytes. How many times as"
        " many does the octree take?",
        answer=lambda states: float(
            np.argmin(np.abs(np.array([2, 4, 8]) - _octree_factor(states)))
        ),
        why=lambda states: (
            f"{brief(_octree_factor(states), 2)} times at the last cut. Only cells near the surface"
            " are cut, and a surface meets four times as many cells of half the edge."
        ),
        params=OCTREE,
        choices=(
            Choice(
                "about 2 times",
                why=(
                    "That is a curve: a line meets twice as many cells of half the edge. A surface"
                    " is more."
                ),
            ),
            "about 4 times",
            Choice(
                "8 times as well",
                why=(
                    "All of space has eight times as many cells. The octree leaves those whole that"
                    " the surface misses."
                ),
            ),
        ),
    ),
    Question(
        "predict-area",
        "A torus as bits, its surface by marching cubes. What becomes of the area with ever smaller"
        " cells?",
        answer=lambda states: float(np.digitize(_areas(states)[-1], [1.02, 1.2])),
        why=lambda states: (
            f"With 16 cells {percent(_areas(states)[2] - 1)} too much, with 64 cells"
            f" {percent(_areas(states)[-1] - 1)}. Bits know 26 directions at most: the surface goes"
            " up and down in facets that do not turn with the cells' size."
        ),
        params=BINARY,
        choices=(
            Choice(
                "It tends to the true area",
                why=(
                    "The position does. The teeth of the zigzag shrink, but their slope stays, and"
                    " slope makes area."
                ),
            ),
            "It stays some 9 % too large",
            Choice(
                "It grows without end",
                why=(
                    "There are ever more facets, but each is smaller by as much. Even the walls of"
                    " the cubes do not grow."
                ),
            ),
        ),
    ),
    Question(
        "predict-looked",
        "16 times as many points in 3 dimensions. How many times as many does a search in the tree"
        " look at, on average?",
        answer=lambda states: float(
            np.argmin(
                np.abs(np.log([16, 4, 1.1]) - np.log(_looked(states)[1] / _looked(states)[0]))
            )
        ),
        why=lambda states: (
            f"{_looked(states)[0]:.0f} of 1,000, {_looked(states)[1]:.0f} of 16,000. The tree is"
            " four cuts deeper; the cells around the query are as many as before, only smaller."
        ),
        params=SEARCH,
        choices=(
            Choice("16 times", why="That is a search without a tree, which looks at every point."),
            Choice(
                "4 times",
                why=(
                    "A root would be a share of all points. The tree leaves out whole branches at"
                    " each cut."
                ),
            ),
            "about as many",
        ),
    ),
    Question(
        "predict-middle",
        "Two boxes overlap by 10 cm; together they are a box, and its middle lies 30 cm deep. What"
        " is the smaller of the two distances there?",
        answer=lambda states: float(
            np.argmin(np.abs(np.array([-0.3, -0.05, 0.05]) - _middle(states)[0]))
        ),
        why=lambda states: (
            f"{length(_middle(states)[0], 2)} for {length(_middle(states)[1], 2)}. Each box knows"
            " its own walls, and those inside the other box are no walls of both. Outside the"
            " smaller one is true."
        ),
        params=UNION,
        choices=(
            Choice(
                "−30 cm",
                why=(
                    "That is the distance of the whole box. Neither box knows that the other goes"
                    " on behind its wall."
                ),
            ),
            "−5 cm",
            Choice(
                "+5 cm",
                why=(
                    "The size is right. But the middle is inside both boxes, and inside is below 0."
                ),
            ),
        ),
    ),
    Question(
        "predict-weights",
        "144 control points of cubic patches miss the torus by 0.28 mm at worst. 64 with a weight"
        " each: what do they miss it by?",
        answer=lambda states: float(
            np.argmin(
                np.abs(np.log10([1e-15, 1e-4, 1e-3]) - np.log10(_patch_error(states) + 1e-16))
            )
        ),
        why=lambda states: (
            "By nothing but rounding: a quotient of quadratic polynomials runs along a circle, and"
            " a torus is circles along a circle."
        ),
        params=RATIONAL,
        choices=(
            "nothing",
            Choice(
                "0.1 mm",
                why=(
                    "Weights gain more than that: a cubic can only come near a circle, a quotient"
                    " is one."
                ),
            ),
            Choice(
                "1 mm",
                why="Fewer numbers usually mean a larger error. Here the form fits the shape.",
            ),
        ),
    ),
)
