"""The values that captions of the RANSAC lesson carry, found anew from the rows and the truth that
a run carries.
"""

import numpy as np

from lessons.ransac.flat import Draw, Fan, Width
from tests.truths.ransac import (
    apart,
    enough_for,
    error,
    limit_of,
    line_through,
    most_trusted,
    rms,
    share_for_stop,
    votes_on,
)
from tests.verdicts import Run


def flat(state) -> bool:
    return isinstance(state, Draw | Width | Fan)


def votes(run: Run, k: int) -> float:
    """Of the model in question, counted anew; of a fan the median over its lines, whose noise is
    drawn anew.
    """
    state = run.states[k]
    if isinstance(state, Draw):
        return votes_of_draw(run, k)
    if isinstance(state, Fan):
        a, b, c = run.subject.truth
        ends = np.array([0.0, -c / b]) + state.apart * np.array([[-0.5], [0.5]]) * [b, -a]
        noise = run.params.noise * np.random.default_rng(run.params.seed).normal(size=(30, 2, 2))
        return float(np.median([votes_on(run, line_through(ends + errors)) for errors in noise]))
    return votes_on(run, state.estimate if state.phase == "inliers" else state.best.estimate)


def votes_of_draw(run: Run, k: int) -> int:
    return votes_on(run, line_through(run.subject.p[run.states[k].sample]))


def best(run: Run, k: int) -> float:
    if isinstance(run.states[k], Draw):
        return max(votes_of_draw(run, i) for i in range(k + 1))
    return votes_on(run, run.states[k].best.estimate)


def clean_so_far(run: Run, k: int) -> int:
    return sum(run.subject.is_inlier[state.sample].all() for state in run.states[: k + 1])


def in_band(run: Run, k: int) -> np.ndarray:
    return apart("line", run.subject.truth, run.subject.p) <= run.states[k].width


def needed(run: Run, k: int) -> float:
    enough = enough_for(
        share_for_stop(run, k), run.subject.model.sample_size, run.params.confidence
    )
    return min(run.params.most_samples, enough)


def msac(run: Run, k: int) -> float:
    assert run.params.score == "MSAC"
    off = apart(run.subject.model.name, run.states[k].estimate, run.subject.p)
    return float(np.maximum(0.0, 1.0 - (off / limit_of(run)) ** 2).sum())


def rms_of_voters(run: Run, k: int) -> float:
    off = apart(run.subject.model.name, run.states[k].best.estimate, run.subject.p)
    return rms(off[off <= limit_of(run)])


def voters_among(run: Run, k: int, rows: np.ndarray) -> int:
    """How many of these rows lie in the band of the best."""
    return int((band_of_best(run, k) & rows).sum())


def band_of_best(run: Run, k: int) -> np.ndarray:
    off = apart(run.subject.model.name, run.states[k].best.estimate, run.subject.p)
    return off <= limit_of(run)


VALUES = {
    "n": lambda run, k: k + 1 if flat(run.states[k]) else run.states[k].iteration,
    "draws": lambda run, k: k + 1,
    "votes": votes,
    "best": best,
    "all": lambda run, k: len(run.subject.p),
    "clean": clean_so_far,
    "width": lambda run, k: 5e-3 * (k + 1),
    "ringed": lambda run, k: in_band(run, k)[run.subject.is_inlier].sum(),
    "others": lambda run, k: in_band(run, k)[~run.subject.is_inlier].sum(),
    "points": lambda run, k: run.subject.is_inlier.sum(),
    "apart": lambda run, k: 0.05 * (k + 1) if k < 9 else 0.5 + 0.1 * (k - 9),
    "limit": lambda run, k: limit_of(run),
    "score": msac,
    "share": lambda run, k: votes(run, k) / len(run.subject.p),
    "trusted": lambda run, k: most_trusted(run, k)[0],
    "part": lambda run, k: most_trusted(run, k)[1],
    "confidence": lambda run, k: run.params.confidence,
    "needed": needed,
    "before": lambda run, k: votes_on(run, run.states[k - 1].best.estimate),
    "error": lambda run, k: error(run, run.states[k].best.estimate),
    "rms": rms_of_voters,
    "wall": lambda run, k: voters_among(run, k, run.subject.is_other),
    "table": lambda run, k: voters_among(run, k, run.subject.is_inlier),
    "clutter": lambda run, k: voters_among(run, k, ~(run.subject.is_other | run.subject.is_inlier)),
}
