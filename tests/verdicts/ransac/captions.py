"""What captions of the RANSAC lesson say: which draw is clean, which fit stays, why a run ends, and
whether its answer is wrong.
"""

import re
from typing import Any

from lessons.ransac.captions import caption as caption_search
from lessons.ransac.flat import draw as draw_flat
from tests.truths.ransac import enough_for, is_right, most_trusted, share_for_stop
from tests.verdicts import Claim, Run
from tests.verdicts.ransac.values import flat
from workbench.lesson import Look
from workbench.scene import Caption, caption_of


def caption(look: Look) -> Caption:
    return caption_of(draw_flat(look)) if flat(look.now) else caption_search(look)


def chosen(run: Run, k: int) -> Any:
    """The fit that was kept last, before the final refit."""
    return next(state.best for state in run.states[k::-1] if state.phase == "best")


def stays(run: Run, k: int, m: re.Match[str]) -> bool:
    before = run.states[k]
    after = run.states[k + 1]
    replaced = after.phase == "best" and after.iteration == before.iteration
    return before.trial.score <= before.best.score and not replaced


def is_new_best(run: Run, k: int, m: re.Match[str]) -> bool:
    """It beats every best before it."""
    latest = run.states[k]
    return all(
        latest.best.score > state.best.score for state in run.states[:k] if state.best is not None
    )


def needs_more(run: Run, k: int, m: re.Match[str]) -> bool:
    enough = enough_for(
        share_for_stop(run, k), run.subject.model.sample_size, run.params.confidence
    )
    return enough >= run.params.most_samples


def stopped(run: Run, k: int, m: re.Match[str]) -> bool:
    last_best = max(i for i in range(k) if run.states[i].phase == "best")
    asked = enough_for(
        share_for_stop(run, last_best), run.subject.model.sample_size, run.params.confidence
    )
    drawn_here = run.states[k].iteration
    if m["why"] == "A":
        return drawn_here >= asked
    return drawn_here == run.params.most_samples <= asked


def clean_draw(run: Run, k: int, m: re.Match[str]) -> bool:
    return run.subject.is_inlier[run.states[k].sample].all() == (m["what"] == "clean")


CAPTIONS = (
    Claim(r"Draw \d+ is (?P<what>clean|spoilt)", clean_draw),
    Claim(r"The best of \d+ draws? has", None),
    Claim(r"Within [\d.]+ mm of the true line", None),
    Claim(r"The best has [\d,]+: it stays", stays),
    Claim(r"New best after", is_new_best),
    Claim(r"samples? allowed are too few", needs_more),
    Claim(
        r"So few of the most trusted vote for it that chance can explain it",
        lambda run, k, _: most_trusted(run, k) == (0, 0.0),
    ),
    Claim(r"(?P<why>number of samples is reached: a|A)fter \d+ samples? the best", stopped),
    Claim(
        r"the best [\w ]+ has",
        lambda run, k, _: all(
            state.trial.score <= chosen(run, k).score
            for state in run.states[:k]
            if state.phase == "inliers"
        ),
    ),
    Claim(
        r"It looks settled, and it is wrong",
        lambda run, k, _: (
            not is_right(run, k) and run.states[k].iteration < run.params.most_samples
        ),
    ),
    Claim(r"It is wrong", lambda run, k, _: not is_right(run, k)),
)
