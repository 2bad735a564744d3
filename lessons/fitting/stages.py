"""The steps of each stage."""

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from lessons.fitting.state import Now, Params, Subject, Trusted, Walked
from lessons.fitting.subjects import windows
from workbench.algorithms.fit_studies import (
    Basin,
    Lines,
    Rivals,
    compare_circles,
    compare_lines,
    repeat_fit,
    try_starts,
)
from workbench.algorithms.least_squares import FIRST_DAMPING, DampedStep, Stop, along_step, descend
from workbench.algorithms.models import PLANE, rms_distance
from workbench.algorithms.robust import HUBER, LOSSES, reweighted_fit
from workbench.data.fit_scenes import arc_points, errors
from workbench.errors import InputError
from workbench.geometry.lines_planes import hyperplane_distances

Linearised = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
Weights = Callable[[np.ndarray, float], np.ndarray]
SHOWN_IN_PARTS, ITERATIONS = 2, 40
RESTS = {"a millionth": 1e-6, "a trillionth": 1e-12}
REPEATS = (30, 300)
LARGEST = 50.0  # metres of radius up to which a covariance says anything
GRID, WALL = 21, 4.0  # starts to a side, metres
SHOWN_ITERATIONS = (0, 1, 2, 3, 4, 6, 8, 10, 15, 20, 30, 40, 60)
ARCS, MOST_DRAWS = (360.0, 270.0, 180.0, 120.0, 90.0, 60.0, 45.0, 30.0, 20.0), 2000
FEWER_DRAWS = 1200  # where there are several arcs
ROUNDS, CALM = 100, 0.01  # of a reweighted fit: at most, and by which share of the corner distances still change
FIRST_ROUNDS, EVERY = 6, 6  # that become steps: all up to that one, then some
PLANE_PLACES = np.stack([*np.meshgrid(*2 * [np.linspace(-1.0, 1.0, 9)]), np.zeros((9, 9))], axis=-1).reshape(-1, 3)


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
    params: Params, subject: Subject, rng: np.random.Generator, linearise: Linearised, step: DampedStep
) -> Iterator[Now]:
    """Yield the moments of a descent, and what its end is worth: made points get other errors, own points are drawn anew."""
    kind, p, now = subject.kind, subject.p, None
    assert kind is not None
    kept, taken_back = start_of(params)[None], np.empty((0, len(start_of(params))))
    for now in descend(
        lambda unknown: linearise(unknown, p),
        kind.retract,
        start_of(params),
        step,
        damping_of(params),
        iterations=ITERATIONS,
        tolerance=RESTS[params.rest],
    ):
        if now.phase == "accepted":
            kept = np.vstack([kept, now.unknown])
        elif now.phase == "rejected" and now.trial is not None:
            taken_back = np.vstack([taken_back, now.trial])
        if now.iteration > SHOWN_IN_PARTS and now.phase in ("linearised", "tried"):
            continue
        tried = now.phase == "tried"
        shares = np.linspace(0.0, 1.5, 31)
        along = along_step(now, lambda c: kind.linearise(c, p), kind.retract, shares) if tried else None
        yield Walked(now, kept, taken_back, along)
    assert now is not None
    if now.stop is not Stop.CONVERGED or abs(now.unknown[-1]) > LARGEST:
        return
    if subject.p_true is None:
        p_anew = p[rng.integers(0, len(p), (REPEATS[-1], len(p)))]
    else:
        p_anew = subject.p_true + errors(rng, (REPEATS[-1], *p.shape), params.noise, params.errors)
    yield from repeat_fit(kind, now, p_anew, REPEATS)


def basin(params: Params, subject: Subject) -> Iterator[Basin]:
    """Yield what becomes of a grid of starts."""
    side = np.linspace(-WALL, WALL, GRID)
    starts = np.stack([*np.meshgrid(side, side), np.full((GRID, GRID), params.start_radius)], axis=-1).reshape(-1, 3)
    assert subject.best is not None
    return try_starts(subject.p, starts, subject.best, damping_of(params), SHOWN_ITERATIONS)


def rivals(params: Params, subject: Subject, rng: np.random.Generator) -> Iterator[Rivals]:
    """Yield the circles of the points, and medians over draws from ever shorter arcs, or over windows of a coin's rim."""
    if subject.photograph is not None:
        assert subject.p_true is not None
        return compare_circles(subject.p, iter([(params.arc, windows(subject.p_true, params.arc))]))
    arcs = [] if subject.truth is None else [arc for arc in ARCS if arc > params.arc] + [params.arc]

    def drawn(arc: float) -> np.ndarray:
        count = FEWER_DRAWS // len(arcs) if len(arcs) > 1 else MOST_DRAWS
        shape = (count, params.points, 2)
        return arc_points(np.radians(arc), params.points) + errors(rng, shape, params.noise)

    return compare_circles(subject.p, ((arc, drawn(arc)) for arc in arcs))


def lines(params: Params, subject: Subject, rng: np.random.Generator) -> Iterator[Lines]:
    """Yield lines by three kinds of distances."""
    assert subject.p_true is not None
    return compare_lines(subject.p, subject.p_true + errors(rng, (REPEATS[-1], *subject.p.shape), params.noise))


def trust(params: Params, subject: Subject, huber_weights: Weights) -> Iterator[Trusted]:
    """Yield the rounds of a reweighted fit of a plane, by one loss or by two, the second from the end of the first."""
    sigma = max(params.noise / subject.scale, 1e-4)
    losses = {**LOSSES, "Huber": replace(HUBER, weights=huber_weights)}
    model, names = replace(PLANE, distances=hyperplane_distances), params.loss.split(" then ")
    start, now, squares_error = None, None, np.nan
    for name in names:
        loss = losses[name]
        corner = sigma * (params.corner if params.corner and name == names[0] else min(loss.efficient_corner, 6.0))
        rounds = reweighted_fit(
            subject.p, model, loss, corner=corner, start=start, max_iterations=ROUNDS, tolerance=CALM
        )
        try:
            for now in rounds:
                error = np.nan if subject.truth is None else rms_distance(PLANE, now.estimate, PLANE_PLACES)
                squares_error = error if np.isnan(squares_error) else squares_error
                wanted = now.iteration <= FIRST_ROUNDS or now.iteration % EVERY == 0 or now.stop is not None
                if wanted and (start is None or now.iteration > 0):
                    last = now.stop is not None and name == names[-1]
                    yield Trusted(name, corner, now, error, squares_error, last)
        except ValueError as reason:
            raise InputError(f"nothing is left to fit: {reason}") from None
        start = now.estimate if now else None
