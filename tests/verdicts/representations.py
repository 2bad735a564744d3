"""Decides what the representations lesson says: distances by nearest points, sizes by trimesh,
searches by scipy.
"""

import re

import numpy as np
import scipy

from lessons.representations.captions import caption as caption
from tests.readings import LENGTH, NUMBER, near, near_length, number, says_percent
from tests.truths.representations import distance, errors, mesh_of, sizes, surface_of
from tests.verdicts import Claim, Run
from workbench.algorithms.spatial.octree import Level

VALUE, WAY = rf"({NUMBER})", rf"({LENGTH})"
PERCENT = rf"({NUMBER} %|less than 0\.01 %)"
SIZE = r"([\d.,]+ (?:B|kB|MB))"
MORE = rf"(the same|(?:{NUMBER} %|less than 0\.01 %) (?:more|less))"
SURFACES = ("mesh", "voxels", "distances", "octree", "neural")


def right(run: Run, k: int) -> bool | None:
    """A surface that did not come back, or less than six tenths of it, is wrong; of the others
    nothing is claimed.
    """
    state = run.states[k]
    if not state.others or state.params.form not in SURFACES or state.surface is None:
        return None
    gone = not len(state.surface.faces) or mesh_of(state.surface).area / sizes(run.params)[0] < 0.6
    return False if gone else None


def says_size(text: str, count: float) -> bool:
    numeral, unit = text.split(" ")
    return near(numeral, count / {"B": 1, "kB": 1e3, "MB": 1e6}[unit], 3 if unit == "B" else 2)


def says_more(text: str, share: float) -> bool:
    if text == "the same":
        return abs(share - 1) < 1.01e-4
    percent, which = text.rsplit(" ", 1)
    return (which == "more") == (share > 1) and says_percent(percent, abs(share - 1))


def _errors(run: Run, k: int, m: re.Match[str]) -> bool:
    mean, worst = errors(run.states[k])
    return near_length(m[1], mean, 2) and near_length(m[2], worst, 2)


def _volume(run: Run, k: int, m: re.Match[str]) -> bool:
    mesh = mesh_of(surface_of(run.states[k]))
    return bool(mesh.is_winding_consistent) and says_more(m[1], mesh.volume / sizes(run.params)[1])


def _cloud(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    away = np.asarray(scipy.spatial.KDTree(state.now.p).query(state.subject.on)[0])
    agrees = near_length(m[3], away.mean(), 2) and near_length(m[4], away.max(), 2)
    return agrees and number(m[1]) == len(state.now.p) and says_size(m[2], 12 * len(state.now.p))


def _edges(run: Run, k: int, m: re.Match[str]) -> bool:
    form = run.states[k].now
    count = 1 if m[1] == "nearest one" else int(m[1].split(" ")[0])
    rows = np.asarray(scipy.spatial.KDTree(form.p).query(form.p, count + 1)[1])
    pairs = np.unique(
        np.sort(np.column_stack([np.repeat(rows[:, 0], count), rows[:, 1:].ravel()]), axis=1),
        axis=0,
    )
    n = len(form.p)
    ones = np.ones(len(pairs))
    pieces, _ = scipy.sparse.csgraph.connected_components(
        scipy.sparse.coo_array((ones, pairs.T), (n, n)), directed=False
    )
    away = np.abs(distance(run.params, form.p[pairs].mean(axis=1)))
    agrees = (
        number(m[2]) == len(pairs)
        and number(m[3]) == pieces
        and says_size(m[4], 4 * n * (3 + count))
    )
    return agrees and near_length(m[5], away.mean(), 2) and near_length(m[6], away.max(), 2)


def _bits(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    n = int(m[1])
    h = 2 / int(m[1])
    middles = -1 + h * (np.arange(n) + 0.5)
    q = np.stack(np.meshgrid(middles, middles, middles, indexing="ij"), axis=-1).reshape(-1, 3)
    full = (distance(run.params, q) < 0).reshape(n, n, n)
    walls = h**2 * sum(
        int((np.pad(full, 1) != np.roll(np.pad(full, 1), 1, axis)).sum()) for axis in range(3)
    )
    area, volume = sizes(run.params)
    agrees = says_size(m[2], n**3 // 8) and number(m[3]) == full.sum() == state.now.values.sum()
    return (
        agrees
        and says_more(m[4], full.sum() * h**3 / volume)
        and abs(number(m[5]) - walls / area) < 0.0051
    )


def _middle(run: Run, k: int, m: re.Match[str]) -> bool:
    true = float(distance(run.params, np.zeros((1, 3)))[0])
    return near_length(m[2], true, 2) and near_length(m[1], -0.05, 2) and abs(true + 0.3) < 1e-12


def _level(run: Run, k: int, m: re.Match[str]) -> bool:
    form = run.states[k].now
    assert isinstance(form, Level)
    h = 2 / 2 ** int(m[1])
    away = np.abs(distance(run.params, -1 + h * (form.cells + 0.5)))
    mixed = int((away <= h * np.sqrt(3) / 2).sum())
    return near_length(m[2], h, 2) and number(m[3]) == mixed and number(m[4]) == len(form.cells)


def _bytes(run: Run, k: int, m: re.Match[str]) -> bool:
    before = [int(state.now.mixed.sum()) for state in run.states[:k]]
    n = 2 ** run.states[k].now.depth
    return (
        says_size(m[1], 2 * sum(before))
        and says_size(m[2], 72 * sum(before))
        and says_size(m[3], max(1, n**3 // 8))
    )


def _built(run: Run, k: int, m: re.Match[str]) -> bool:
    form = run.states[k].now
    tree = form.tree
    cells = [
        c
        for c in range(len(tree.axis))
        if tree.depth[c] == form.depth or (tree.depth[c] < form.depth and tree.axis[c] < 0)
    ]
    spans = [int(tree.last[c] - tree.first[c]) for c in cells]
    return (
        number(m[1]) == form.depth
        and number(m[2]) == len(cells)
        and number(m[3]) == max(spans)
        and sum(spans) == len(tree.p)
    )


def _searched(run: Run, k: int, m: re.Match[str]) -> bool:
    search = run.states[k].now
    cells = [visit.cell for visit in search.visits]
    rows = np.concatenate([np.arange(search.tree.first[c], search.tree.last[c]) for c in cells])
    nearest = np.linalg.norm(search.tree.p[rows] - search.query, axis=1).min()
    agrees = (
        number(m[1]) == len(cells)
        and number(m[2]) == len(rows)
        and number(m[3]) == len(search.tree.p)
    )
    return (
        agrees
        and says_percent(m[4], len(rows) / len(search.tree.p))
        and near_length(m[5], nearest, 2)
    )


def _passed(run: Run, k: int, m: re.Match[str]) -> bool:
    search = run.states[k].now
    tree = search.tree
    visit = search.visits[-1]
    away = [
        np.linalg.norm(tree.p[tree.first[c] : tree.last[c]] - search.query, axis=1).min()
        for c in visit.passed
    ]
    return number(m[1]) == len(away) and min(away) >= visit.distance


def _done(run: Run, k: int, m: re.Match[str]) -> bool:
    search = run.states[k].now
    return (
        abs(np.linalg.norm(search.tree.p - search.query, axis=1).min() - search.visits[-1].distance)
        < 1e-9
    )


def _growth(run: Run, k: int, m: re.Match[str]) -> bool:
    growth = run.states[k].growth
    looked = dict(zip(growth.counts.tolist(), growth.looked, strict=True))
    shares = dict(zip(growth.dimensions.tolist(), growth.shares, strict=True))
    agrees = (
        abs(number(m[1]) - looked[number(m[2])]) < 0.51
        and abs(number(m[3]) - looked[number(m[4])]) < 0.51
    )
    return agrees and all(says_percent(m[j], shares[d]) for j, d in ((5, 3), (6, 10), (7, 20)))


def _control_points(run: Run, k: int, m: re.Match[str]) -> bool:
    control = run.states[k].now.control
    shown = np.concatenate(
        [control[..., :3] / control[..., 3:], control[..., 3:]], axis=-1
    ).reshape(-1, 4)
    return number(m[1]) == len(np.unique(shown.round(6) + 0.0, axis=0))


CAPTIONS = [
    Claim(
        rf"{VALUE} points, {SIZE}\. The surface is {WAY} from the nearest of them on average, {WAY}"
        r" in the"
        r" largest hole",
        _cloud,
    ),
    Claim(
        rf"joined to its (nearest one|\d+ nearest): {VALUE} edges?, {VALUE} pieces?, {SIZE}\."
        rf" Middles of edges are {WAY}"
        rf" off the surface on average, {WAY} at worst",
        _edges,
    ),
    Claim(rf"{WAY} off on average, {WAY} at worst", _errors),
    Claim(r"nothing but rounding is off", lambda run, k, m: errors(run.states[k])[1] < 1e-9),
    Claim(
        rf"Area: {MORE}",
        lambda run, k, m: says_more(
            m[1], mesh_of(surface_of(run.states[k])).area / sizes(run.params)[0]
        ),
    ),
    Claim(rf"volume: {MORE}", _volume),
    Claim(
        rf"(\d+) cells along each edge, one bit each: {SIZE}\. ([\d,]+) have their middle inside:"
        rf" volume {MORE}\. The"
        rf" walls around them have {VALUE} times the area",
        _bits,
    ),
    Claim(rf"in the middle {WAY} where {WAY} is true", _middle),
    Claim(rf"Level (\d+), edges of {WAY}: ([\d,]+) of ([\d,]+) cells? may be crossed", _level),
    Claim(rf"Packed {SIZE}, with pointers {SIZE}; dense bits {SIZE}", _bytes),
    Claim(
        rf"{VALUE} cuts? deep: each cell is cut at the median of its longest side\. {VALUE} cells"
        r" with at"
        rf" most {VALUE}",
        _built,
    ),
    Claim(
        rf"Cell {VALUE} of the search: {VALUE} of {VALUE} points looked at \({PERCENT}\), the"
        rf" nearest so far {WAY}"
        r" away",
        _searched,
    ),
    Claim(rf"{VALUE} branch(?:es)? passed over: no point of theirs can be nearer", _passed),
    Claim(r"Nothing is left to look at", _done),
    Claim(
        rf"looks at {VALUE} of {VALUE} points on average, and at {VALUE} of {VALUE}\. Of 4,000"
        rf" points: {PERCENT} in 3"
        rf" dimensions, {PERCENT} in 10, {PERCENT} in 20",
        _growth,
    ),
    Claim(rf"{VALUE} (?:weighted )?control points", _control_points),
    Claim(
        r"No surface: the field is nowhere zero",
        lambda run, k, m: bool(
            (run.states[k].now.values < 0).all() or (run.states[k].now.values >= 0).all()
        ),
    ),
    Claim(r"no surface comes? back", lambda run, k, m: not len(surface_of(run.states[k]).faces)),
    Claim(
        rf"only {PERCENT} of the area came back",
        lambda run, k, m: says_percent(
            m[1], mesh_of(surface_of(run.states[k])).area / sizes(run.params)[0]
        ),
    ),
]


def shares(run: Run) -> list[float]:
    """The area of each surface that came back over the true one."""
    area = sizes(run.params)[0]
    return [
        mesh_of(state.surface).area / area for state in run.states[:-1] if state.surface is not None
    ]


def _half(run: Run, k: int, m: re.Match[str]) -> bool:
    mixed = [int(state.now.mixed.sum()) for state in run.states[:-1]]
    return near(m[1], sum(mixed[:-1]) / sum(mixed[:-2]), 2)


def _deep(run: Run, k: int, m: re.Match[str]) -> bool:
    return abs(float(distance(run.params, np.zeros((1, 3)))[0]) + 0.3) < 1e-12


LINES = {
    "edges": [
        Claim(
            r"Watch the worst error beside the edge of a cell",
            lambda run, k, m: all(
                0.2 < errors(state)[1] / float(state.now.grid.spacing[0]) < 0.6
                for state in run.states[:-1]
                if state.surface is not None
            ),
        ),
    ],
    "thin": [
        Claim(r"half a cell thick", lambda run, k, m: run.params.thickness == 0.5),
    ],
    "union": [
        Claim(
            r"The surface is fine",
            lambda run, k, m: (
                errors(run.states[-1])[0] < 0.1 * float(run.states[-1].now.grid.spacing[0])
            ),
        ),
    ],
    "neighbours": [
        Claim(
            r"pieces become one",
            lambda run, k, m: run.states[1].now.pieces > 1 == run.states[-1].now.pieces,
        ),
        Claim(
            r"edges leave the surface",
            lambda run, k, m: (
                float(
                    distance(
                        run.params, run.states[-1].now.p[run.states[-1].now.edges].mean(axis=1)
                    ).max()
                )
                > 0.05
            ),
        ),
    ],
    "cloud": [
        Claim(
            r"Four times the points, half the distance",
            lambda run, k, m: all(
                1.7 < a / b < 2.3
                for a, b in zip(
                    run.states[-1].errors[:-3], run.states[-1].errors[2:-1], strict=True
                )
            ),
        ),
    ],
    "triangles": [
        Claim(
            r"twice the vertices, half the error",
            lambda run, k, m: all(
                1.6 < a / b < 2.4
                for a, b in zip(
                    run.states[-1].errors[:-2], run.states[-1].errors[1:-1], strict=True
                )
            ),
        ),
    ],
}

WHYS = {
    "predict-half": [Claim(rf"{VALUE} times at the last cut", _half)],
    "predict-area": [
        Claim(
            rf"With 16 cells {PERCENT} too much, with 64 cells {PERCENT}",
            lambda run, k, m: (
                says_percent(m[1], shares(run)[2] - 1) and says_percent(m[2], shares(run)[-1] - 1)
            ),
        ),
    ],
    "predict-looked": [
        Claim(
            rf"{VALUE} of 1,000, {VALUE} of 16,000",
            lambda run, k, m: (
                abs(number(m[1]) - run.states[-1].growth.looked[1]) < 0.51
                and abs(number(m[2]) - run.states[-1].growth.looked[-1]) < 0.51
            ),
        ),
    ],
    "predict-middle": [
        Claim(
            rf"{WAY} for {WAY}",
            lambda run, k, m: near_length(m[1], -0.05, 2) and near_length(m[2], -0.3, 2),
        ),
        Claim(r"Outside the smaller one is true", lambda run, k, m: _outside(run)),
    ],
    "predict-weights": [
        Claim(r"By nothing but rounding", lambda run, k, m: errors(run.states[-1])[1] < 1e-12),
    ],
}


def _outside(run: Run) -> bool:
    q = np.random.default_rng(0).uniform(-1, 1, (2000, 3))
    true = distance(run.params, q)
    return bool(np.abs(run.states[-1].subject.field(q) - true)[true > 0].max() < 1e-12)
