"""How far off the finished fit is by the width of the band, over many scenes."""

import numpy as np

from lessons.ransac.inputs import Input
from lessons.ransac.robust_scenes import RobustScene, scattered_line_scene
from lessons.ransac.shapes import MM
from workbench.algorithms.robust.models import LINE
from workbench.algorithms.robust.samplers import draw_samples
from workbench.geometry.shapes.lines_planes import fit_hyperplanes
from workbench.lesson import cached

WIDTHS = np.arange(5.0, 301.0, 5.0) / MM
STUDIED = np.append(np.arange(5.0, 131.0, 5.0), np.arange(150.0, 301.0, 25.0)) / MM
AMONG_WIDTHS = np.flatnonzero(np.isin(WIDTHS, STUDIED))
MOST_STUDIES, STUDIED_POINTS = 60, 12_000  # scenes; fewer where these have so many points in all
TOGETHER = 4  # of these scenes
SMALL = 36_000  # numbers in an array: larger ones cost more than the calls that they save


def line_scene(params: Input, seed: int) -> RobustScene:
    """Return points of a line and clutter all over its window."""
    return scattered_line_scene(
        np.random.default_rng(seed),
        count=params.points,
        outlier_ratio=params.outliers,
        sigma=params.noise,
    )


def studies(params: Input) -> int:
    """Return over how many scenes a median is taken: of fewer where each has many points."""
    return TOGETHER * min(
        MOST_STUDIES // TOGETHER, STUDIED_POINTS // (TOGETHER * params.points) + 1
    )


@cached
def errors_by_width(params: Input) -> np.ndarray:
    """Return the median error of the finished fit over such scenes (m), for each of STUDIED."""
    errors = []
    off = np.empty((TOGETHER, len(STUDIED), params.points))
    for first in range(0, studies(params), TOGETHER):
        seeds = range(first, first + TOGETHER)
        scenes = [line_scene(params, seed) for seed in seeds]
        p, p_true = (np.stack([getattr(made, name) for made in scenes]) for name in ("p", "p_true"))
        p_h = np.concatenate([p, np.ones((*p.shape[:2], 1))], axis=-1).swapaxes(-1, -2)
        lines = np.stack([_most_votes(*scene) for scene in zip(_drawn(p, seeds), p_h, strict=True)])
        for _ in range(5):
            np.abs(np.matmul(lines, p_h, out=off), out=off)
            lines = fit_hyperplanes(p, np.less_equal(off, STUDIED[:, None], out=off))
        errors.append(np.sqrt((LINE.distances(lines, p_true) ** 2).mean(axis=-1)))
    return np.median(np.concatenate(errors), axis=0)


def _drawn(p: np.ndarray, seeds: range) -> np.ndarray:
    """Return two hundred lines of each scene, through two of its points."""
    rngs = [np.random.default_rng(seed) for seed in seeds]
    rows = [draw_samples(p.shape[1], 2, 200, rng=rng) for rng in rngs]
    pairs = [points[pair] for points, pair in zip(p, rows, strict=True)]
    return LINE.solve(np.concatenate(pairs)).reshape(len(p), -1, 3)


def _most_votes(lines: np.ndarray, p_h: np.ndarray) -> np.ndarray:
    """Return for each of STUDIED the line with the most votes."""
    pieces = np.array_split(lines / WIDTHS[0], _pieces(len(lines) * p_h.shape[1]))
    votes = np.concatenate([_votes_by_width(some @ p_h) for some in pieces])
    return lines[votes[:, AMONG_WIDTHS].argmax(axis=0)]


def _pieces(numbers: int) -> int:
    """Return in how many pieces so many numbers are computed, each of SMALL at most."""
    return -(-numbers // SMALL)


def _votes_by_width(steps: np.ndarray) -> np.ndarray:
    """Return how many points lie within each of WIDTHS, of signed distances in steps of them."""
    n, bands = len(steps), len(WIDTHS)
    np.abs(steps, out=steps)
    np.minimum(steps, bands, out=steps)
    steps += (bands + 1) * np.arange(n)[:, None]
    cells = steps.astype(np.intp)  # of each row the narrowest width that holds it
    new = np.bincount(cells.ravel(), minlength=n * (bands + 1))
    return new.reshape(n, bands + 1)[:, :-1].cumsum(axis=1)
