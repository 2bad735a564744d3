"""What to predict before looking, with what is said to known wrong answers."""

from collections.abc import Iterable, Sequence

import numpy as np

from lessons.icp.flat import Outlines
from lessons.icp.presets import BY_HAND, FAR, FROM_45, FROM_75, KEEP_70, PLANE, START, VASE
from lessons.icp.scans import Scans
from workbench.algorithms import turning
from workbench.algorithms.registration import icp
from workbench.algorithms.turning import within_half
from workbench.certain import as_a
from workbench.lesson import Choice, Question, States
from workbench.numerals import angle, length


def end(states: Iterable) -> icp.State:
    """Return the last step of ICP itself in space, before other starts are tried."""
    return next(s for s in states if isinstance(s, icp.State) and s.stop is not None)


def flat_end(states: Sequence) -> turning.State:
    """Return the last step of a run in the flat."""
    return as_a(turning.State, states[-1])


def fits(states: Iterable) -> list[float]:
    """Return the RMSE after each fit in space, metres."""
    return [s.rmse for s in states if isinstance(s, icp.State) and s.phase == "fit"]


def rmse_falls(states: Iterable) -> bool:
    """Tell whether no fit raised the RMSE of the fit before."""
    return bool(np.all(np.diff(fits(states)) <= 1e-12))


def came_home(states: States) -> bool:
    """Tell whether ICP itself, in space, ended at the truth, but for sampling."""
    scans = as_a(Scans, states.subject)
    return scans.at_home(scans.error(end(states).T_target_source))


def off(states: States) -> str:
    """Return how far the end of ICP itself, in space, is from the truth: turn and shift."""
    error = as_a(Scans, states.subject).error(end(states).T_target_source)
    return f"{angle(error.rotation)} and {length(error.translation)}"


def valleys(states: States) -> int:
    """Return how many angles have a lower RMSE than both of their neighbours, once around."""
    rmse = np.array([as_a(turning.State, state).rmse for state in states])[:-1]
    return int(np.sum((rmse < np.roll(rmse, 1)) & (rmse <= np.roll(rmse, -1))))


def right_at_first(states: States) -> int:
    """Return how many of the first partners in the flat are right."""
    first = as_a(turning.State, states[0])
    return int(as_a(Outlines, states.subject).right(first.partners).sum())


def _why_valleys(states: States) -> str:
    lines = as_a(Outlines, states.subject)
    return (
        f"{valleys(states)} of them, most of them shallow. One is deep: it reaches down to"
        f" {length(float(lines.rmse.min()), 2)}. Partners change while you turn, and each new set"
        " of partners brings a valley of its own."
    )


def _which_matches(states: States) -> float:
    share = right_at_first(states) / len(as_a(Outlines, states.subject).p_source)
    return float(np.digitize(-share, [-0.75, -0.35, -0.12]))


def _why_matches(states: States) -> str:
    n = len(as_a(Outlines, states.subject).p_source)
    at = within_half(flat_end(states).angle)
    return (
        f"{right_at_first(states)} of {n}. And still it ends at {angle(at)}: wrong partners turn"
        " the rabbit too little, but together they turn it the right way."
    )


def _why_rest(states: States) -> str:
    last = flat_end(states)
    return (
        f"{angle(within_half(last.angle), 2)}. From 75° the way down leads to the right, away from"
        " home."
    )


def _which_far(states: States) -> float:
    if came_home(states):
        return 0.0
    return 2.0 if rmse_falls(states) else 1.0


def _why_far(states: States) -> str:
    return (
        f"It ended {off(states)} from the truth, at an RMSE of {length(end(states).rmse)}. No match"
        " and no fit raised the cost, and nothing in them knows of other valleys."
    )


def _why_plane(states: States) -> str:
    return (
        f"{end(states).iteration} rounds. A point may slide along its partner's tangent plane at no"
        " cost, so one fit turns the source as far as many point-to-point fits."
    )


def _which_share(states: States) -> float:
    return 2.0 if came_home(states) else 0.0


def _why_share(states: States) -> str:
    return (
        f"With 70 % it ends {off(states)} from the truth. Now the outliers are left out and nearly"
        " all others are kept."
    )


def _which_vase(states: States) -> float:
    small = end(states).rmse < 2.0 * as_a(Scans, states.subject).spacing
    if not small:
        return 2.0
    return 0.0 if came_home(states) else 1.0


def _why_vase(states: States) -> str:
    scans = as_a(Scans, states.subject)
    left = scans.error(end(states).T_target_source).rotation
    return (
        f"The RMSE is {length(end(states).rmse)}, where neighbouring target points lie"
        f" {length(scans.spacing)} apart, and {left:.0f}° of the turn are left. No point of a vase"
        " can tell how far it was turned, so no method can."
    )


QUESTIONS: tuple[Question, ...] = (
    Question(
        name="how-many-now",
        text="Turn the rabbit once all the way round. How many valleys will this curve have?",
        answer=lambda states: 0.0 if valleys(states) > 1 else 1.0,
        why=_why_valleys,
        params=BY_HAND,
        start=START,
        choices=(
            Choice("More than one"),
            Choice(
                "One, as with the rubber bands",
                "The bands kept their partners, and then there is one valley. Here every point"
                " takes a new partner as soon as another one is nearer.",
            ),
        ),
    ),
    Question(
        name="predict-matches",
        text=(
            "How many of these 50 partners are right, so that they lie within one gap of where the"
            " orange point belongs?"
        ),
        answer=_which_matches,
        why=_why_matches,
        params=FROM_45,
        step=1,
        choices=(
            Choice(
                "Nearly all",
                "Then one fit would be enough. At 45° most points have moved much farther than"
                " their neighbours are apart.",
            ),
            Choice(
                "About half",
                "You may have counted those that pull the right way. Only a few end where they"
                " belong.",
            ),
            Choice(
                "About a fifth",
                "Still too many. The outlines cross at some places, and there the nearest point"
                " is another part of the rabbit.",
            ),
            Choice("Fewer than one in ten"),
        ),
    ),
    Question(
        name="where-it-rests",
        text="This time the ball starts at 75°. Where will it come to rest? Put the flag there.",
        answer=lambda states: within_half(flat_end(states).angle),
        why=_why_rest,
        params=FROM_75,
        step=-1,
        unit="°",
        tolerance=8.0,
        low=-180.0,
        high=180.0,
        stride=1.0,
        mark="ball",
        wrong=(
            (
                -30.0,
                63.0,
                (
                    "To get there the ball would have to climb over the ridge at 68° first, and it"
                    " never climbs."
                ),
            ),
            (
                64.0,
                85.0,
                (
                    "The ball stops only where new partners change nothing any more. Here they"
                    " still do."
                ),
            ),
            (
                105.0,
                180.0,
                "It would have to leave the first valley on its way, and to climb for that.",
            ),
        ),
    ),
    Question(
        name="predict-far",
        text="In space, the rabbit starts 120° away. What will ICP do?",
        answer=_which_far,
        why=_why_far,
        params=FAR,
        choices=(
            Choice(
                "Come home, only more slowly",
                "Every run comes to rest in a valley of the cost. From far away it may be another"
                " one than the true one.",
            ),
            Choice(
                "Stop because the RMSE rises",
                "It cannot rise here. The nearest partners lower the cost, and so does the best"
                " motion for these partners.",
            ),
            Choice("Lower the RMSE to the end and be wrong"),
        ),
    ),
    Question(
        name="predict-plane",
        text="From 35° the rabbit took 61 rounds. How many will it take with planes?",
        answer=lambda states: float(end(states).iteration),
        why=_why_plane,
        params=PLANE,
        tolerance=3.0,
        low=1.0,
        high=80.0,
        stride=1.0,
        wrong=(
            (
                1,
                4,
                (
                    "One fit would do if the partners were right. They are not, so even planes need"
                    " new matches some times."
                ),
            ),
            (
                20,
                40,
                (
                    "Half as many would be the gain if each swing were twice as long. The first fit"
                    " turns the source by 8.6° with planes and by 1.65° without."
                ),
            ),
            (
                41,
                200,
                (
                    "The matches are made in the same way, but the fit differs: without a price for"
                    " sliding along the surface each fit turns the source farther."
                ),
            ),
        ),
    ),
    Question(
        name="best-share",
        text=(
            "Three in ten points belong to nothing. Which share of the closest matches would"
            " you keep?"
        ),
        answer=_which_share,
        why=_why_share,
        params=KEEP_70,
        choices=(
            Choice(
                "100 %",
                "Then every outlier pulls, and the farthest pull most: the rabbit ends 15° off.",
            ),
            Choice(
                "90 %",
                "A third of the outliers is gone, but the others still pull: the rabbit ends 4°"
                " off.",
            ),
            Choice("70 %"),
            Choice(
                "30 %",
                "The closest matches are those that hold the rabbit where it stands now. Too few"
                " are left that could pull it home: it ends 30° off.",
            ),
        ),
    ),
    Question(
        name="predict-vase",
        text="A vase starts turned by 90° about its own axis. What will the end look like?",
        answer=_which_vase,
        why=_why_vase,
        params=VASE,
        choices=(
            Choice(
                "Small RMSE, right turn",
                "The RMSE is small, but it does not say that the turn is right: turned about its"
                " axis, the vase looks the same, so no match pulls it back.",
            ),
            Choice("Small RMSE, wrong turn"),
            Choice(
                "Large RMSE",
                "A wrong turn raises the RMSE only where the turned shape looks different. A vase"
                " turned about its axis looks the same.",
            ),
        ),
    ),
)
