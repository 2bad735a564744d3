"""The captions: what a step did, with its numbers, and whether its end is right."""

import numpy as np

from lessons.learning.labelled_shapes import NAMES
from lessons.learning.state import Clouds, Looks, Params, State, Target, Turns
from workbench.algorithms.learning.mesh_fitting import MeshFitted
from workbench.algorithms.learning.point_net import Classified
from workbench.algorithms.learning.radiance_field import Reconstructed
from workbench.algorithms.learning.rotation_regression import Regressed
from workbench.algorithms.learning.set_regression import SetLearned
from workbench.numerals import angle, brief, counted, fixed, length, percent
from workbench.scene import Caption

NEAR, FAR = 15.0, 90.0  # degrees: the worst error of a turn that was learned; of one that was not
ROUND, SMEARED = 0.02, 0.05  # m: spread of the radii of a circle, and of what is none
SMOOTH, CRUMPLED = 0.02, 0.2  # shares of folded edges
WHOLE = 0.05  # m: how far the true surface may be from a mesh that has all of its parts
KNOWN, LOST = 0.9, 0.6  # shares of clouds named rightly
CLEAR, BLIND = 18.0, 12.0  # dB of new views


def caption(state: State) -> Caption:
    """Return what happened until this step; at the end, whether what was learned is right."""
    text, value, good, bad = _told(state)
    if not state.last or good is bad is None:
        return Caption(text)
    if good <= value if good > bad else good >= value:
        return Caption.verdict(text, right=True)
    if bad >= value if good > bad else bad <= value:
        return Caption.verdict(text, right=False)
    return Caption(text)


def _told(state: State) -> tuple[str, float, float, float]:
    """Return the sentence, and a number with where it is right and where it is wrong."""
    fit, params, about = state.now, state.params, state.about
    done = "Untrained" if fit.updates == 0 else f"After {counted(fit.updates, 'update')}"
    match fit, about:
        case Regressed(), Turns():
            return f"{done}: {_of_turns(params, about, fit)}", float(fit.errors.max()), NEAR, FAR
        case SetLearned(), _:
            radii = np.linalg.norm(fit.p, axis=1)
            text = (
                f"{done}: {params.set_loss} loss {fixed(fit.loss, 3)} m². The {len(fit.p)} points"
                f" have radii from {fixed(radii.min(), 2)} to {fixed(radii.max(), 2)} m,"
                f" {fixed(radii.mean(), 2)} on average, with a spread of {fixed(radii.std(), 3)} m."
            )
            return text, float(radii.std()), ROUND, SMEARED
        case MeshFitted(), Target():
            text = (
                f"{done}: {length(float(np.sqrt(fit.to_given)))} from the given points of"
                f" {about.name}, {length(float(np.sqrt(fit.to_truth)))} from its true surface"
                f" (roots of Chamfer). The farthest part of that surface is {length(fit.farthest)}"
                f" from the mesh. Folded by over 90°: {percent(fit.folded)} of the edges."
            )
            if about.euler != 2 and fit.updates == 0:
                kind = f"{about.name} is not like a sphere (V − E + F = {about.euler}, not 2)"
                text = (
                    f"{done}, a sphere: it has one piece, no hole and no border, and keeps that."
                    f" {kind}. What will it do?"
                )
            # never good without its ears
            return (text, fit.folded, SMOOTH if fit.farthest <= WHOLE else -1.0, CRUMPLED)
        case Classified(), Clouds():
            plain, changed = shares_right(fit, about)
            if fit.updates == 0:
                return (
                    f"{done}: loss {fixed(fit.loss, 2)}. Of {len(NAMES)} shapes it guesses one.",
                    changed,
                    KNOWN,
                    LOST,
                )
            text = (
                f"{done}: loss {fixed(fit.loss, 2)}; {percent(plain, 0)} of {len(about.of)} new"
                " clouds are named rightly"
            )
            if changes := changes_of(params):
                text += f". {changes}: {percent(changed, 0)}"
            return f"{text}.", changed, KNOWN, LOST
        case Reconstructed(), Looks():
            text = (
                f"{done}: the {params.views} photographs are matched with {fixed(about.trained, 1)}"
                f" dB, new views with {fixed(about.unseen, 1)} dB. Density and discs share"
                f" {percent(about.overlap, 0)} of what they cover."
            )
            return text, about.unseen, CLEAR, BLIND
    raise AssertionError


def _of_turns(params: Params, about: Turns, fit: Regressed) -> str:
    k = params.picked % len(fit.errors)
    worst = int(fit.errors.argmax())
    mean = f"loss {brief(fit.loss, 2)}; wrong by {angle(float(fit.errors.mean()))} on average"
    if fit.updates == 0:
        return f"{mean}."
    of = "a turn of" if params.task == "angle" else "a rotation by"
    return (
        f"{mean}, at most by {angle(float(fit.errors[worst]))}, for {of}"
        f" {fixed(float(about.degrees[worst]), 0)}°. For the picked one,"
        f" {fixed(float(about.degrees[k]), 0)}°: {angle(float(fit.errors[k]))}."
    )


def shares_right(classified: Classified, about: Clouds) -> tuple[float, float]:
    """Return which shares of the test clouds are named rightly: as in training, and changed."""
    plain, changed = (
        float((classified.scores[name].argmax(axis=1) == about.of).mean())
        for name in ("plain", "changed")
    )
    return plain, changed


def changes_of(params: Params) -> str:
    """Return how the tried clouds differ from those of training; nothing where they do not."""
    done = []
    if params.turned != params.trained:
        done.append(f"turned {params.turned}")
    if any(params.stray):
        done.append("with one stray point")
    if params.shuffled:
        done.append("listed in another order")
    return f"The same {', '.join(done)}" if done else ""


def said(classified: Classified, k: int) -> str:
    """Return which shape the network takes a changed test cloud for."""
    return NAMES[int(classified.scores["changed"][k].argmax())]
