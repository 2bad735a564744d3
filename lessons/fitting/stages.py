"""The steps of each stage."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from lessons.fitting.fit_scenes import arc_points, errors
from lessons.fitting.fit_studies import (
    Basin,
    Lines,
    Rivals,
    compare_circles,
    compare_lines,
    repeat_fit,
    try_starts,
)
from lessons.fitting.state import Now, Params, Subject
from workbench.algorithms.least_squares import (
    FIRST_DAMPING,
    DampedStep,
    Stop,
    descend,
    with_its_way,
)
from workbench.algorithms.robust import HUBER, LOSSES, Trusted, cascade
from workbench.algorithms.robust.models import PLANE
from workbench.certain import sure
from workbench.errors import InputError
from workbench.geometry.shapes.lines_planes import hyperplane_distances

Linearised = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
Weights = Callable[[np.ndarray, float], np.ndarray]
SHOWN_IN_PARTS, ITERATIONS = 2, 40
RESTS = {"a millionth": 1e-6, "a trillionth": 1e-12}
REPEATS = (30, 300)
LARGEST = 50.0  # metres of radius up to which a covariance says anything
# starts to a side, metres
GRID = 21
WALL = 4.0
SHOWN_ITERATIONS = (0, 1, 2, 3, 4, 6, 8, 10, 15, 20, 30, 40, 60)
ARCS = (360.0, 270.0, 180.0, 120.0, 90.0, 60.0, 45.0, 30.0, 20.0)
MOST_DRAWS = 2000
FEWER_DRAWS = 1200  # where there are several arcs
# of a reweighted fit: at most, and by which share of the corner distances still change
ROUNDS = 100
CALM = 0.01
FIRST_ROUNDS, EVERY = 6, 6  # that become steps: all up to that one, then some


def damping_of(params: Params) -> float:
    """Return the first damping of the method."""
    return FIRST_DAMPING if params.method == "Levenberg-Marquardt" else 0.0


def start_of(params: Params) -> np.ndarray:
    """Return the unknowns to start from."""
    x, y, z = params.start
    if params.shape == "circle":
        return np.array([x, y, params.start_radius])
    if params.shape == "sphere":
        return np.array([x, y, z, params.start_radius])
    lean = np.radians(params.start_tilt)
    return np.array([x, y, z, np.sin(lean), 0.0, np.cos(lean), params.start_radius])


def walk(
    params: Params,
    subject: Subject,
    rng: np.random.Generator,
    *,
    linearise: Linearised,
    step: DampedStep,
) -> Iterator[Now]:
    """Yield the moments of a descent, and what its end is worth: made points get other errors, own
    points are drawn anew.
    """
    kind = sure(subject.kind)
    p = subject.p
    last = None
    moments = descend(
        lambda unknown: linearise(unknown, p),
        kind.retract,
        start_of(params),
        damped_step=step,
        damping=damping_of(params),
        iterations=ITERATIONS,
        tolerance=RESTS[params.rest],
    )
    shown = (
        m
        for m in moments
        if m.iteration <= SHOWN_IN_PARTS or m.phase not in ("linearised", "tried")
    )
    for walked in with_its_way(
        shown, lambda c: kind.linearise(c, p), kind.retract, shares=np.linspace(0.0, 1.5, 31)
    ):
        last = walked.now
        yield walked
    assert last is not None
    if last.stop is not Stop.CONVERGED or abs(last.unknown[-1]) > LARGEST:
        return
    if subject.p_true is None:
        p_anew = p[rng.integers(0, len(p), (REPEATS[-1], len(p)))]
    else:
        p_anew = subject.p_true + errors(
            rng, (REPEATS[-1], *p.shape), params.noise, kind=params.errors
        )
    yield from repeat_fit(kind, last, p_anew, counts=REPEATS)


def basin(params: Params, subject: Subject) -> Iterator[Basin]:
    """Yield what becomes of a grid of starts."""
    side = np.linspace(-WALL, WALL, GRID)
    starts = np.stack(
        [*np.meshgrid(side, side), np.full((GRID, GRID), params.start_radius)], axis=-1
    ).reshape(-1, 3)
    assert subject.best is not None
    return try_starts(
        subject.p, starts, subject.best, damping=damping_of(params), shown=SHOWN_ITERATIONS
    )


def rivals(params: Params, subject: Subject, rng: np.random.Generator) -> Iterator[Rivals]:
    """Yield the circles of the points, and medians over draws from ever shorter arcs, or over
    windows of a coin's rim.
    """
    if subject.rim is not None:
        return compare_circles(subject.p, iter([(params.arc, subject.rim.windows(params.arc))]))
    arcs = [] if subject.truth is None else [arc for arc in ARCS if arc > params.arc] + [params.arc]

    def drawn(arc: float) -> np.ndarray:
        count = FEWER_DRAWS // len(arcs) if len(arcs) > 1 else MOST_DRAWS
        shape = (count, params.points, 2)
        return arc_points(np.radians(arc), params.points) + errors(rng, shape, params.noise)

    return compare_circles(subject.p, ((arc, drawn(arc)) for arc in arcs))


def lines(params: Params, subject: Subject, rng: np.random.Generator) -> Iterator[Lines]:
    """Yield lines by three kinds of distances."""
    assert subject.p_true is not None
    return compare_lines(
        subject.p, subject.p_true + errors(rng, (REPEATS[-1], *subject.p.shape), params.noise)
    )


def trust(params: Params, subject: Subject, huber_weights: Weights) -> Iterator[Trusted]:
    """Yield the rounds of a reweighted fit of a plane, by one loss or by two, the second from the
    end of the first.
    """
    sigma = max(params.noise / subject.scale, 1e-4)
    losses = [
        {**LOSSES, "Huber": replace(HUBER, weights=huber_weights)}[name]
        for name in params.loss.split(" then ")
    ]
    corners = [sigma * min(loss.efficient_corner, 6.0) for loss in losses]
    if params.corner:
        corners[0] = sigma * params.corner
    model = replace(PLANE, distances=hyperplane_distances)
    by = list(zip(losses, corners, strict=True))
    try:
        for trusted in cascade(subject.p, model, by, max_iterations=ROUNDS, tolerance=CALM):
            k = trusted.now.iteration
            if k <= FIRST_ROUNDS or k % EVERY == 0 or trusted.now.stop is not None:
                yield trusted
    except ValueError as reason:
        raise InputError(f"nothing is left to fit: {reason}") from None
