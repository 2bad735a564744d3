"""What captions of the measures lesson say, held to closed forms, trimesh and sums of
determinants.
"""

import functools
import re

import numpy as np
import scipy

from tests.readings import NUMBER, near, number, says_percent
from tests.truths.measures import (
    closed,
    determinants,
    lantern_area,
    mesh_of,
    near_first,
    random_hits,
    sums,
    truth,
    walls,
)
from tests.verdicts import Claim, Run

VALUE = rf"({NUMBER})"
ERROR = rf"(exact|off by less than 0\.01 %|\+?{NUMBER} %)"
PERCENT = rf"({NUMBER} %|less than 0\.01 %)"


def off(text: str, error: float) -> bool:
    """Whether "exact", "+17 %" or "off by less than 0.01 %" says a relative error."""
    if text == "exact":
        return abs(error) < 1e-8
    if text.startswith("off"):
        return abs(error) < 1.01e-4
    return abs(number(text.removesuffix(" %").removeprefix("+")) - 100 * error) <= 0.051 * max(
        1.0, abs(100 * error)
    )


def _count(run: Run, k: int, m: re.Match[str]) -> bool:
    subject = run.states[k].subject
    return (number(m[1]), number(m[2])) == (len(subject.p), len(subject.faces))


def _one(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    nearest = near_first(state, 1)
    area, part = sums(state, nearest)
    return near(m[1], area, 4) and near(m[2], part, 4) and (m[3] == "minus") == (part < 0)


def _so_far(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    return near(m[2], sums(state, near_first(state, int(number(m[1]))))[1], 3)


def _new(run: Run, k: int, m: re.Match[str]) -> bool:
    before = run.states[k - 1].now.count
    new = determinants(run.states[k])[near_first(run.states[k], run.states[k].now.count)[before:]]
    return (number(m[1]), number(m[2])) == (int((new >= 0).sum()), int((new < 0).sum()))


def _all_area(run: Run, k: int, m: re.Match[str]) -> bool:
    area = sums(run.states[k])[0]
    return near(m[1], area, 4) and off(m[2], area / truth(run.states[k])[0] - 1)


def _all_volume(run: Run, k: int, m: re.Match[str]) -> bool:
    volume = sums(run.states[k])[1]
    return near(m[1], volume, 4) and off(m[2], volume / truth(run.states[k])[1] - 1)


def _cells(run: Run, k: int, m: re.Match[str]) -> bool:
    result = run.states[k].now
    count = int(result.bits.sum())
    edge = float(result.grid.spacing[0])
    side = np.ptp([run.states[k].subject.low, run.states[k].subject.high], axis=0).max()
    volume = count * edge**3
    agrees = number(m[1]) == round(side / edge) and number(m[2]) == count and near(m[3], volume, 4)
    return agrees and off(m[4], volume / truth(run.states[k])[1] - 1)


def _walls(run: Run, k: int, m: re.Match[str]) -> bool:
    result = run.states[k].now
    area = walls(result.bits, float(result.grid.spacing[0]))
    return near(m[1], area, 4) and abs(number(m[2]) - area / truth(run.states[k])[0]) < 0.0051


def _throws(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    n, hits = int(number(m[1])), int(number(m[2]))
    share = hits / n
    box = float(np.prod(state.subject.high - state.subject.low))
    if (
        state.params.draw == "random"
        and state.subject.name == "the sphere"
        and random_hits(state, n) != hits
    ):
        return False
    half = 1.96 * box * np.sqrt(share * (1 - share) / n)
    return (
        near(m[3], box * share, 4)
        and near(m[4], half, 2)
        and near(m[5], truth(state)[1], 4)
        and off(m[6], box * share / truth(state)[1] - 1)
    )


def _interval(run: Run, k: int, m: re.Match[str]) -> bool:
    estimates = run.states[k].now.estimates
    true = truth(run.states[k])[1]
    return (m[1] == "holds") == (abs(estimates.values[-1] - true) <= 1.96 * estimates.errors[-1])


def _too_wide(run: Run, k: int, m: re.Match[str]) -> bool:
    """One point in each small cube scatters less than the interval says: sqrt(sum p (1 - p)) over
    the cubes' shares p.
    """
    state = run.states[k]
    subject = state.subject
    estimates = state.now.estimates
    count = estimates.counts[-1]
    size = np.prod(subject.high - subject.low)
    if (
        state.params.draw != "stratified"
    ):  # an even sequence: one run shows its error, about which nothing is known
        return abs(estimates.values[-1] - truth(state)[1]) < 1.2 * estimates.errors[-1]
    side = round(count ** (1 / 3))
    rng = np.random.default_rng(k)
    cube = np.stack(np.meshgrid(*[np.arange(side)] * 3, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    q = subject.low + (subject.high - subject.low) * (cube + rng.random((len(cube), 16, 3))) / side
    p = subject.inside(q.reshape(-1, 3)).reshape(-1, 16).mean(axis=1)
    scatter = size / len(cube) * np.sqrt(16 / 15 * np.sum(p * (1 - p)))
    return scatter < 0.9 * estimates.errors[-1]


def _lines(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    n, total, area = number(m[1]), number(m[2]), number(m[4])
    radius = (
        1.001
        * np.linalg.norm(
            state.subject.p - (state.subject.low + state.subject.high) / 2, axis=1
        ).max()
    )
    agrees = (
        abs(number(m[3]) - total / n) < 0.0051
        and abs(area / (2 * np.pi * radius**2 * total / n) - 1) < 1e-3
    )
    return agrees and near(m[6], truth(state)[0], 4) and off(m[7], area / truth(state)[0] - 1)


def _quarters(run: Run, k: int, m: re.Match[str]) -> bool:
    """A point nearer than half the height to a corner's side lies in that corner's quarter."""
    q = run.states[k].now.q
    a, b, c = np.array([[-1.0, 0.0, -0.6], [1.0, 0.0, -0.6], [0.0, 0.0, 1.1]])
    whole = np.linalg.norm(np.cross(b - a, c - a))
    at = [
        np.linalg.norm(np.cross(y - q, z - q), axis=1) / whole > 0.5
        for y, z in ((b, c), (c, a), (a, b))
    ]
    shares = [100 * quarter.mean() for quarter in at] + [100 * (1 - np.any(at, axis=0).mean())]
    return all(
        abs(number(text) - share) < 0.51 for text, share in zip(m.groups(), shares, strict=True)
    )


def _samples(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    mesh = mesh_of(state.subject, whole=True)
    q = state.now.q
    right_half = mesh.area_faces[mesh.triangles_center[:, 0] > 0].sum() / mesh.area
    gap = np.linalg.norm(q.mean(axis=0) - mesh.centroid) / np.linalg.norm(mesh.extents)
    agrees = number(m[1]) == len(q) and abs(number(m[2]) - 100 * (q[:, 0] > 0).mean()) < 0.51
    return agrees and abs(number(m[3]) - 100 * right_half) < 0.51 and says_percent(m[4], float(gap))


def ball_share(d: int) -> float:
    return np.pi ** (d / 2) / scipy.special.gamma(d / 2 + 1) / 2**d


def _ball(run: Run, k: int, m: re.Match[str]) -> bool:
    d, n, hits = int(m[1]), number(m[2]), number(m[3])
    deviation = np.sqrt(n * ball_share(d) * (1 - ball_share(d)))
    if d != k + 2 or abs(hits - n * ball_share(d)) > 5 * deviation + 2:
        return False
    if m[4]:
        return says_percent(m[4], ball_share(d))
    return near(m[5], 1 / ball_share(d))


def _known_to(run: Run, k: int, m: re.Match[str]) -> bool:
    hits = run.states[k].now.hits[-1]
    n = run.states[k].now.throws
    return says_percent(m[1], 1.96 * float(np.sqrt((1 - hits / n) / hits)))


def _study(run: Run, k: int, m: re.Match[str]) -> bool:
    area, volume = (run.states[k].study.errors[name] for name in ("area", "volume"))
    fine = says_percent(m[1], area[-1]) and says_percent(m[2], volume[-1])
    return (
        fine
        and abs(number(m[3]) - area[-2] / area[-1]) < 0.051
        and abs(number(m[4]) - volume[-2] / volume[-1]) < 0.051
    )


CAPTIONS = [
    Claim(r"([\d,]+) vertices, ([\d,]+) triangles", _count),
    Claim(
        r"(\d+) triangles? cut out",
        lambda run, k, m: (
            number(m[1]) == len(run.states[k].subject.whole) - len(run.states[k].subject.faces)
        ),
    ),
    Claim(
        rf"its area, {VALUE} m²; a · \(b × c\) / 6 is its tetrahedron, {VALUE} m³: (plus|minus)",
        _one,
    ),
    Claim(rf"^([\d,]+) of [\d,]+ triangles, near ones first: {VALUE} m³ so far", _so_far),
    Claim(
        rf"^([\d,]+) of [\d,]+ triangles, near ones first: area {VALUE} m² so far",
        lambda run, k, m: near(
            m[2], sums(run.states[k], near_first(run.states[k], int(number(m[1]))))[0], 3
        ),
    ),
    Claim(r"count plus: ([\d,]+); that count minus: ([\d,]+)", _new),
    Claim(rf"triangles: area {VALUE} m² \({ERROR}\)", _all_area),
    Claim(rf", volume {VALUE} m³ \({ERROR}\)\. (?=E)", _all_volume),
    Claim(
        r"Every edge has its partner: any other origin gives the same",
        lambda run, k, m: closed(run.states[k]),
    ),
    Claim(r"Edges lack a partner", lambda run, k, m: not closed(run.states[k])),
    Claim(
        r"It encloses nothing",
        lambda run, k, m: not mesh_of(run.states[k].subject, whole=True).is_watertight,
    ),
    Claim(rf"(\d+) cells across, ([\d,]+) full: volume {VALUE} m³ \({ERROR}\)", _cells),
    Claim(rf"full and empty: {VALUE} m², {VALUE} times the true area", _walls),
    Claim(
        rf"marching cubes: {VALUE} times",
        lambda run, k, m: (
            abs(number(m[1]) - run.states[k].now.marched[-1] / truth(run.states[k])[0]) < 0.0051
        ),
    ),
    Claim(
        rf"([\d,]+) throws, ([\d,]+) hits: {VALUE} ± {VALUE} m³; truth {VALUE} m³, {ERROR}", _throws
    ),
    Claim(r"The interval \(95 %\) (holds|misses) the truth", _interval),
    Claim(r"It is that of random throws: too wide here", _too_wide),
    Claim(
        r"Of 4,000 such runs (\d+) % miss it at this step, and (\d+) % missed it at one or more of"
        r" the (\d+) looks",
        lambda run, k, m: _peeked(run, k, m),
    ),
    Claim(r"Without a hit the interval is empty", lambda run, k, m: run.states[k].now.hits == 0),
    Claim(
        r"Without a miss the interval is empty",
        lambda run, k, m: run.states[k].now.hits == run.states[k].now.estimates.counts[-1],
    ),
    Claim(
        rf"([\d,]+) lines through the ball around it cross the surface ([\d,]+) times, {VALUE}"
        r" each; times 2πR² that is"
        rf" {VALUE} ± {VALUE} m²; truth {VALUE} m², {ERROR}",
        _lines,
    ),
    Claim(rf"the corners got {VALUE} %, {VALUE} %, {VALUE} %, the middle {VALUE} %", _quarters),
    Claim(
        rf"([\d,]+) points on [\w ]+: {VALUE} % of them on the half whose faces were cut in four,"
        rf" which has {VALUE} % of"
        rf" the area\. Their mean is {PERCENT} of",
        _samples,
    ),
    Claim(
        rf"(\d+) dimensions: ([\d,]+) throws, ([\d,]+) hits?; the ball fills (?:{PERCENT} of|one"
        rf" part in {VALUE} of)",
        _ball,
    ),
    Claim(rf"The volume is known to ±{PERCENT}", _known_to),
    Claim(
        r"The estimate is 0, and its interval too",
        lambda run, k, m: run.states[k].now.hits[-1] == 0,
    ),
    Claim(
        rf"the area is {PERCENT} too small, the volume {PERCENT}\. Edges half as long divide the"
        rf" errors by {VALUE} and"
        rf" {VALUE}",
        _study,
    ),
    Claim(
        rf"(\d+) sectors, all vertices on the cylinder: with as many rings {VALUE} times its area,"
        r" with sectors² rings"
        rf" {VALUE} times, with sectors³ rings {VALUE} times",
        lambda run, k, m: all(
            abs(number(m[power + 1]) / lantern_area(int(m[1]), int(m[1]) ** power) - 1) < 0.005
            for power in (1, 2, 3)
        ),
    ),
]


@functools.cache
def _watched(share: float, counts: tuple[int, ...]) -> tuple[float, float]:
    """The shares of 400 runs, throw by throw, that miss the truth at the last step and at any."""
    rng = np.random.default_rng(5)
    last_ = 0
    ever = 0
    for _ in range(400):
        hit = np.cumsum(rng.random(counts[-1]) < share)
        p = np.array([hit[n - 1] / n for n in counts])
        out = np.abs(p - share) > 1.96 * np.sqrt(p * (1 - p) / np.array(counts))
        last_ = last_ + out[-1]
        ever = ever + out.any()
    return last_ / 400, ever / 400


def _peeked(run: Run, k: int, m: re.Match[str]) -> bool:
    s = run.states[k].subject
    counts = run.states[k].now.estimates.counts
    at_end, ever = _watched(truth(run.states[k])[1] / float(np.prod(s.high - s.low)), counts)
    close = abs(number(m[1]) / 100 - at_end) < 0.04 and abs(number(m[2]) / 100 - ever) < 0.08
    return close and number(m[3]) == len(counts)
