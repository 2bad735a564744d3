"""What a step of the search says: what just happened, with the number that changed."""

import numpy as np

from lessons.ransac.inputs import Input
from lessons.ransac.rows import Subject
from lessons.ransac.search import chosen_sample
from workbench.algorithms.robust.ransac import Fit, State, Stop
from workbench.captions import Quantity, counted, metres, pixels, share
from workbench.certain import sure
from workbench.lesson import Look, say
from workbench.numerals import brief
from workbench.scene import Caption

SearchLook = Look[Input, Subject, State]
COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven")
BY_CHANCE = (
    " So few of the most trusted vote for it that chance can explain it: it cannot end the run."
)


def caption(look: SearchLook) -> Caption:
    """Return the caption of a step."""
    return {
        "sample": _sample,
        "degenerate": _degenerate,
        "model": _model,
        "inliers": _votes,
        "best": _best,
        "refit": _refit,
        "stop": _stop,
    }[look.now.phase](look)


def is_right(params: Input, subject: Subject, state: State) -> bool:
    """Tell whether the best is nearer to the truth than the noise lets single rows be."""
    in_pixels = subject.model.unit == "px"
    sigma = max(params.noise_pixels, 0.5) if in_pixels else max(params.noise, 0.005)
    return bool(subject.error(state.best.estimate if state.best else None) < sigma)


def distance(subject: Subject, value: float) -> Quantity:
    """Return a distance in the unit of the rows; of thousands of pixels two digits."""
    if subject.model.unit != "px":
        return metres(value)
    return pixels(value) if value < 1e3 else Quantity(value, pixels(float(f"{value:.1e}")).text)


def _sample(look: SearchLook) -> Caption:
    params = look.params
    state = look.now
    noun = look.subject.noun
    how = "drawn by chance" if params.sampler == "uniform" else "drawn by trust"
    if state.iteration == 1 and chosen_sample(params, look.subject):
        how = "you picked"
    words = f"Sample {{n}}: {COUNTS[len(state.sample)]} {noun}, {how}."
    return say(words + _proportion(look, first=True), n=state.iteration, place="draw")


def _degenerate(look: SearchLook) -> Caption:
    model = look.subject.model
    words = f"Sample {{n}} gives no {model.name}: {model.degenerate_when}. It counts as drawn."
    return say(words, n=look.now.iteration)


def _model(look: SearchLook) -> Caption:
    subject = look.subject
    words = f"Sample {{n}} gives a {subject.model.name}. All {subject.noun} within {{limit}}"
    limit = distance(subject, subject.limit)
    return say(words + " of it vote for it.", n=look.now.iteration, limit=limit)


def _votes(look: SearchLook) -> Caption:
    state = look.now
    trial = sure(look.now.trial)
    words = f"Sample {{n}} gets {{votes}} votes of {{all}} {look.subject.noun}{_score(look)}"
    values: dict = {"n": state.iteration, "votes": trial.count, "all": len(trial.inliers)}
    if look.params.score != "count":
        values["score"] = Quantity(trial.score, brief(trial.score))
    if state.best is not None and trial.score <= state.best.score:
        return say(f"{words}. The best has {{best}}: it stays.", best=state.best.count, **values)
    return say(words + ".", **values)


def _score(look: SearchLook) -> str:
    name = look.params.score
    return "" if name == "count" else f" ({name} score {{score}})"


def _best(look: SearchLook) -> Caption:
    params = look.params
    state = look.now
    best = sure(look.now.best)
    values: dict = {"n": counted(state.iteration, "sample"), "votes": counted(best.count, "vote")}
    words = "New best after {n}: {votes}."
    if params.sampler == "PROSAC":
        length, part = look.subject.trusted(best)
        if not length:
            return say(words + BY_CHANCE, place="new best", **values)
        words += " Of the {trusted} most trusted {part} vote for it."
        values |= {"trusted": length, "part": share(part, 0)}
    too_few = state.needed >= params.most_samples
    words += " At that share the {needed} allowed are too few." if too_few else ""
    words += "" if too_few else " At that share {needed} are enough."
    needed = counted(round(min(state.needed, params.most_samples)), "sample")
    return say(words, needed=needed, place="new best", **values)


def _refit(look: SearchLook) -> Caption:
    subject = look.subject
    best = sure(look.now.best)
    before = look.before.best if look.before is not None else None
    values: dict = {"votes": best.count}
    words = "Refit to the voters: {votes} votes"
    if before is not None:
        words = "Refit to the {before} voters: {votes} vote now"
        values["before"] = before.count
    error = subject.error(best.estimate)
    if not np.isfinite(error):
        return say(words + ".", place="refit", **values)
    values["error"] = distance(subject, error)
    return say(words + ", and it is {error} from the truth.", place="refit", **values)


def _stop(look: SearchLook) -> Caption:
    subject = look.subject
    state = look.now
    best = look.now.best
    settled = state.stop is Stop.ENOUGH
    reason = sure(state.stop).message
    values: dict = {"n": counted(state.iteration, "sample")}
    if best is None:
        words = "It stops after {n}" + ("" if settled else f": {reason}")
        return say(f"{words}. {_why_none(look)}", tone="wrong", place="compare", **values)
    values["votes"] = counted(best.count, "vote")
    begun = "After" if settled else f"{reason[:1].upper()}{reason[1:]}: after"
    words = f"{begun} {{n}} the best {subject.model.name} has {{votes}}"
    error = subject.error(best.estimate)
    if not np.isfinite(error):
        values["rms"] = distance(subject, best.rms)
        words += f", and its voters lie {{rms}} from it (RMS).{_proportion(look)}"
        return say(words, place="compare", **values)
    of = voters_of(subject, best)
    if of:
        words += ": {wall} of the wall, {table} of the table and {clutter} of clutter."
        values |= of
    else:
        words += " and is {error} off."
        values["error"] = distance(subject, error)
    right = is_right(look.params, subject, state)
    return say(words, right=right, settled=settled, place="compare", **values)


def voters_of(subject: Subject, fit: Fit) -> dict[str, int]:
    """Return how many points of the wall, of the table and of the clutter vote for a fit; nothing
    where there is no wall.
    """
    if subject.is_other is None or subject.is_inlier is None:
        return {}
    wall, table = (int(fit.inliers[rows].sum()) for rows in (subject.is_other, subject.is_inlier))
    return {"wall": wall, "table": table, "clutter": int(fit.inliers.sum()) - wall - table}


def _why_none(look: SearchLook) -> str:
    model, noun = look.subject.model, look.subject.noun
    if all(state.phase != "inliers" for state in look.past):
        return (
            f"Every sample was degenerate ({model.degenerate_when}): such {noun} determine no"
            f" {model.name}."
        )
    return "A larger inlier distance or more samples may help."


def _proportion(look: SearchLook, *, first: bool = False) -> str:
    """Warn where the inlier distance and the size of somebody's own rows hardly belong together."""
    params, subject = look.params, look.subject
    if params.cloud is None and params.matches is None:
        return ""
    size = float(np.linalg.norm(np.ptp(subject.p, axis=0)))
    limit = subject.limit
    if (first and look.now.iteration > 1) or not size or size / 5000.0 <= limit <= size / 10.0:
        return ""
    few = "few" if limit < size / 10.0 else "nearly all"
    unsure = "Are the matches in pixels?"
    if subject.model.unit != "px":
        unsure = f"Is the cloud in {params.cloud_unit} (cloud_unit)?"
    return (
        f" Mind: the {subject.noun} extend over {distance(subject, size)}, so {few} of them can be"
        f" expected within {distance(subject, limit)} of any {subject.model.name}. {unsure}"
    )
