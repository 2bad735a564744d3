"""The stages in the plane: balls, axioms, a scatter that is made round, and landmarks seen by a
stereo camera.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from lessons.distances.slots import Functions, Mahalanobis
from lessons.distances.state import Ball, Landmarks, Now, Params, Scatter, Trials
from workbench.errors import InputError
from workbench.geometry.points import metrics
from workbench.geometry.points.metrics import Distance, Metric
from workbench.geometry.polylines import circle
from workbench.tracing import traced

Steps = Iterator[tuple[None, Now]]
METRICS: tuple[Metric, ...] = (
    "euclid",
    "manhattan",
    "chebyshev",
    "squared",
    "cosine",
    "mahalanobis",
)
# half a side of the square, metres; points; queries
HALF = 1.0
DOTS = 30
QUERIES = 500
TRIPLES, ROUNDS = 500, 20
SHARE = 0.95
WITHIN = 2.0
FRESH = 4000
DIMENSIONS = 10
# towards the second cluster, and its standard deviation
SECOND = np.array([1.0, -1.0]) / np.sqrt(2)
SPREAD = 0.1
FOCAL, BASELINE, SIGMA = 700.0, 0.12, 0.5  # pixels, metres, pixels
LANDMARKS, SIGHTS, VIEWS = 60, 30, 8


def covariance_of(params: Params) -> np.ndarray:
    """Return the covariance of two coordinates of variance 1."""
    return np.array([[1.0, params.correlation], [params.correlation, 1.0]])


def distance_in(params: Params, metric: Metric) -> Distance:
    """Return a distance of the plane as the params have it, y in their unit."""
    units = np.array([1.0, float(params.stretch)])
    distance = metrics.distance_of(metric, order=params.p, covariance=covariance_of(params))
    return lambda a, b: distance(a * units, b * units)


def balls(params: Params, _: Functions) -> Steps:
    """Yield the ball of a metric about a point as it grows to the nearest other, and whose nearest
    it changes.
    """
    rng = np.random.default_rng(params.seed)
    p = np.concatenate([np.array([[0.15, 0.1]]), rng.uniform(-HALF, HALF, (DOTS - 1, 2))])
    query = max(params.source, 0) % len(p)
    ball = None
    for ball in grown(params, p, query):
        yield None, ball
    assert ball is not None
    asked = rng.uniform(-HALF, HALF, (QUERIES, 2))
    changed = _nearest(distance_in(params, params.metric), p, asked) != _nearest(
        metrics.distance_of("euclid"), p, asked
    )
    names = METRICS if params.metric in METRICS else (*METRICS, params.metric)
    nearest = {
        name: int(np.argmin(from_point(distance_in(params, name), p, query))) for name in names
    }
    straight = int(np.argmin(from_point(metrics.distance_of("euclid"), p, query)))
    yield None, replace(ball, queries=asked, changed=changed, nearest=nearest, straight=straight)


@traced
def grown(params: Params, p: np.ndarray, query: int) -> Iterator[Ball]:
    """Yield the ball about one point in steps, up to the nearest other."""
    d = from_point(distance_in(params, params.metric), p, query)
    straight = from_point(metrics.distance_of("euclid"), p, query)
    for share in np.linspace(0.2, 1.0, 5):
        radius = float(share * d.min())
        rims = outline(params, p[query], radius), p[query] + share * straight.min() * circle()
        yield Ball(p=p, query=query, d=d, radius=radius, rims=rims)


def from_point(distance: Distance, p: np.ndarray, query: int) -> np.ndarray:
    """Return how far all points are from one of them, itself being infinitely far."""
    d = np.array(distance(p, p[query]))
    d[query] = np.inf
    return d


def outline(params: Params, centre: np.ndarray, radius: float) -> np.ndarray:
    """Return where the distance from a centre is the radius: closed, but for the cosine, whose ball
    is a wedge.
    """
    if params.metric == "cosine":
        units = np.array([1.0, float(params.stretch)])
        towards = np.arctan2(*(centre * units)[::-1])
        turn = towards + np.arccos(1 - min(radius, 2.0)) * np.array([1.0, -1.0])
        ends = np.column_stack([np.cos(turn), np.sin(turn)]) / units
        ends *= HALF / np.abs(ends).max(axis=1, keepdims=True)
        return np.stack([ends[0], np.zeros(2), ends[1]])
    rays = circle(360)
    reach = distance_in(params, params.metric)(rays, np.zeros(2))
    # how the distance grows along a ray
    power = {"squared": 2.0, "p-sum": params.p}.get(params.metric, 1.0)
    return centre + rays * ((radius / reach) ** (1 / power))[:, None]


def _nearest(distance: Distance, p: np.ndarray, asked: np.ndarray) -> np.ndarray:
    return np.asarray(distance(p[None], asked[:, None])).argmin(axis=1)


def axioms(params: Params, _: Functions) -> Steps:
    """Yield more and more tries to break the axioms, by triples of points of the unit square."""
    distance = metrics.distance_of(params.metric, order=params.p, covariance=covariance_of(params))
    for trials in tried(distance, np.random.default_rng(params.seed)):
        yield None, trials


@traced
def tried(distance: Distance, rng: np.random.Generator) -> Iterator[Trials]:
    """Yield how many triples so far break the triangle inequality, and how often the other axioms
    are broken.
    """
    broken = 0
    names = ("d(a, a) = 0", "d(a, b) > 0", "d(a, b) = d(b, a)", "d(a, c) ≤ d(a, b) + d(b, c)")
    counts = np.zeros(3)
    for k in range(1, ROUNDS + 1):
        a, b, c = rng.random((3, TRIPLES, 2))
        excess, sides = metrics.triangle_excess(distance, a, b, c=c)
        broken += int((excess > 1e-9).sum())
        # other points on the same ray from the origin
        along = a * rng.uniform(0.2, 0.9, (TRIPLES, 1))
        counts += [
            (np.abs(distance(a, a)) > 1e-9).sum(),
            (distance(a, along) <= 1e-9).sum(),
            (np.abs(distance(a, b) - distance(b, a)) > 1e-9).sum(),
        ]
        worst = int(np.argmax(excess))
        parts = (*(counts / (k * TRIPLES)), broken / (k * TRIPLES))
        shares: dict[str, float] = dict(zip(names, parts, strict=True))
        yield Trials(
            tried=k * TRIPLES,
            broken=broken,
            corners=np.stack([a[worst], b[worst], c[worst]]),
            sides=sides[worst],
            axioms=shares,
        )


def whiten(params: Params, functions: Functions) -> Steps:
    """Yield a scatter as it is centred, turned and scaled to a round one, and which of its points
    lie far out.
    """
    rng = np.random.default_rng(params.seed)
    p = rng.multivariate_normal([0, 0], covariance_of(params), params.points)
    p = np.concatenate([p, params.away * SECOND + SPREAD * rng.normal(size=(params.outliers, 2))])
    scatter = None
    for scatter in rounded(params, p, rng, mahalanobis=functions.mahalanobis):
        yield None, scatter
    assert scatter is not None
    radii = [
        _finite(functions.mahalanobis(rng.normal(size=(FRESH, k)), np.zeros(k), np.eye(k)))
        for k in range(1, DIMENSIONS + 1)
    ]
    counted = np.array([(d <= WITHIN).mean() for d in radii])
    true = np.array([metrics.share_within(WITHIN, k) for k in range(1, DIMENSIONS + 1)])
    yield None, replace(scatter, phase="dimensions", shares=(counted, true))


@traced
def rounded(
    params: Params, p: np.ndarray, rng: np.random.Generator, *, mahalanobis: Mahalanobis
) -> Iterator[Scatter]:
    """Yield the steps that turn Mahalanobis' distance into Euclid's."""
    try:
        mean, C = (
            metrics.robust_mean_and_covariance(p, rng)
            if params.estimate == "robust"
            else metrics.mean_and_covariance(p)
        )
        d = _finite(mahalanobis(p, mean, C))
    except ValueError as error:
        raise InputError(str(error)) from None
    limit = metrics.radius_of_share(SHARE, 2)
    variances, axes = np.linalg.eigh(C)
    rim = mean + limit * circle() * np.sqrt(variances) @ axes.T
    outlier = np.arange(len(p)) >= params.points
    scatter = Scatter(phase="points", p=p, outlier=outlier, d=d, limit=limit, rim=rim)
    yield scatter
    yield replace(scatter, phase="centred", p=p - mean, rim=rim - mean)
    turned = (p - mean) @ axes, (rim - mean) @ axes
    yield replace(scatter, phase="turned", p=turned[0], rim=turned[1])
    yield replace(
        scatter,
        phase="scaled",
        p=turned[0] / np.sqrt(variances),
        rim=turned[1] / np.sqrt(variances),
    )
    yield replace(scatter, phase="told")


def _finite(d: np.ndarray) -> np.ndarray:
    values = np.asarray(d, float)
    if not np.isfinite(values).all():
        raise InputError("mahalanobis returned values that are not finite")
    return values


def stereo(params: Params, functions: Functions) -> Steps:
    """Yield measurements of landmarks by a stereo camera, and for which landmark each is taken."""
    for sights in sighted(np.random.default_rng(params.seed), functions.mahalanobis):
        yield None, sights


@traced
def sighted(rng: np.random.Generator, mahalanobis: Callable) -> Iterator[Landmarks]:
    """Yield sights of random landmarks from above, thirty at a time, with the covariance of depth
    by disparity.
    """
    landmarks = np.column_stack([rng.uniform(-1, 1, LANDMARKS), rng.uniform(4, 6, LANDMARKS)])
    seen = [np.empty((0, 2))]
    true = []
    near = []
    told = []
    for _ in range(VIEWS):
        k = rng.integers(LANDMARKS, size=SIGHTS)
        x, z = landmarks[k].T
        disparity = FOCAL * BASELINE / z + SIGMA * rng.normal(size=SIGHTS)
        depth = FOCAL * BASELINE / disparity
        across = (x * FOCAL / z + SIGMA * rng.normal(size=SIGHTS)) * depth / FOCAL
        rims = []
        for q in np.column_stack([across, depth]):
            ahead = q[1] / (FOCAL * BASELINE)
            J = np.array([[q[1] / FOCAL, -q[0] * ahead], [0.0, -q[1] * ahead]])  # of (u, disparity)
            C = SIGMA**2 * J @ J.T
            near.append(int(np.argmin(np.linalg.norm(landmarks - q, axis=1))))
            told.append(int(np.argmin(_finite(mahalanobis(landmarks, q, C)))))
            rims.append(
                q + metrics.radius_of_share(SHARE, 2) * circle(32) @ np.linalg.cholesky(C).T
            )
        seen.append(np.column_stack([across, depth]))
        true.extend(k.tolist())
        yield Landmarks(
            landmarks=landmarks,
            seen=np.concatenate(seen),
            true=np.array(true),
            euclid=np.array(near),
            mahalanobis=np.array(told),
            rims=np.array(rims),
        )
