"""Experiments that break descriptors, and what to predict before looking."""

from collections.abc import Sequence

from lessons.features.state import Params, Scanned, State
from workbench.certain import as_a
from workbench.lesson import Choice, Preset, Question, View
from workbench.numerals import angle, counted, percent

HOME = Params()
SMALL = Params(radius=0.07)
ROOT = Params(compare="square root")
FLIPPED = Params(normals="source flipped")
RANDOM_ONE, RANDOM = Params(normals="random in source"), Params(normals="random in both")
VASE = Params(shape="vase")
PATCHES = Params(part="pictures", turn=0.0)
TURNED = Params(part="pictures", turn=30.0)
SIFT = Params(part="pictures", turn=30.0, describe="SIFT")
OUTLINE_X = Params(part="outlines", turn=45.0, angles="from the x axis")
VIEW = View(eye=(0.75, -2.35, 0.85), target=(0.48, 0.0, 0.08), grid=None, axes=False)
FLAT = View(eye=(0.0, -0.01, 2.25), target=(0.0, 0.0, 0.0), grid=None, axes=False)

PRESETS: tuple[Preset[Params], ...] = (
    Preset(
        "home",
        "From 140° away",
        "Nothing tells the start. Watch how few matches are green, and what a sample of three of"
        " these does.",
        HOME,
        3,
    ),
    Preset(
        "noisy",
        "With 1 cm of noise",
        "Normals shake, and with them all histograms: fewer matches are green, and RANSAC needs"
        " more samples.",
        Params(noise=0.01),
        6,
    ),
    Preset(
        "small",
        "A smaller neighbourhood",
        "7 cm around each point: compare the picked point's bars with those of its place, and count"
        " the green lines.",
        SMALL,
        3,
        breaks=True,
    ),
    Preset(
        "wide",
        "A larger neighbourhood",
        "25 cm around each point: places differ more from each other, and well over half of the"
        " kept matches are green.",
        Params(radius=0.25),
        6,
    ),
    Preset(
        "root",
        "The square root of every bar",
        "Large bars lose their say, small ones gain: compare the share of green matches with that"
        " of the plain histograms.",
        ROOT,
        6,
    ),
    Preset(
        "flipped",
        "One scan's normals face inwards",
        "The same points, the same lines, the other side: look at the bars, and at how many matches"
        " pass the filter.",
        FLIPPED,
        3,
        breaks=True,
    ),
    Preset(
        "random-one",
        "One scan's normals face either side by chance",
        "The target's still face outwards: its histograms and the source's are no longer made in"
        " the same way.",
        RANDOM_ONE,
        6,
        breaks=True,
    ),
    Preset(
        "random",
        "Both scans' normals by chance",
        "Only about one in seven of the kept matches is green, and RANSAC draws over 1,000 samples."
        " But it comes home: both scans' histograms are blurred alike.",
        RANDOM,
        6,
    ),
    Preset(
        "vase",
        "A vase",
        "A surface of revolution: a whole ring of places has the same descriptor. Watch the green"
        " share and the turn.",
        VASE,
        4,
        breaks=True,
    ),
    Preset(
        "patches",
        "Corners of two photographs",
        "Corners are where grey levels are steep in two directions; the pixels around describe"
        " them. 90 % are green.",
        PATCHES,
        -1,
        FLAT,
    ),
    Preset(
        "tilted",
        "The right photograph turned by 10°",
        "A patch is a square of pixels that stands upright. A small turn is still forgiven: 87 %"
        " are green.",
        Params(part="pictures", turn=10.0),
        -1,
        FLAT,
    ),
    Preset(
        "turned",
        "The right photograph turned by 30°",
        "The same corners, a larger turn: look at the two patches that match most clearly.",
        TURNED,
        4,
        FLAT,
        breaks=True,
    ),
    Preset(
        "sift",
        "The same turn, with SIFT",
        "Every keypoint has a size and a direction of its own, and is described along it: 82 % are"
        " green.",
        SIFT,
        1,
        FLAT,
    ),
    Preset(
        "outline",
        "A horse turned by 45°",
        "Angles are counted from the outline's own direction at each point, so the turn does not"
        " matter.",
        Params(part="outlines", turn=45.0),
        -1,
        FLAT,
    ),
    Preset(
        "outline-x",
        "The horse, angles from the x axis",
        "The same two outlines, but the bins do not turn with them: fewer than a tenth of the lines"
        " are green.",
        OUTLINE_X,
        -1,
        FLAT,
        breaks=True,
    ),
)


def kept(states: Sequence[State]) -> State:
    """Return the step at which the filter has chosen."""
    return next(state for state in states if state.now.phase == "kept")


def kept_count(states: Sequence[State]) -> float:
    """Return how many matches the filter keeps."""
    pairs = kept(states).now.pairs
    return 0.0 if pairs is None else float(len(pairs))


def kept_share(states: Sequence[State]) -> float:
    """Return how many per cent of the kept matches are right."""
    share = kept(states).right_share
    return 0.0 if share != share else 100.0 * share


def end(states: Sequence[State]) -> Scanned:
    """Return the last step of a run on scans."""
    return as_a(Scanned, states[-1].now)


def _which_inwards(states: Sequence[State]) -> float:
    count = kept_count(states)
    if count > 120:
        return 0.0
    return 1.0 if count > 50 else 2.0


QUESTIONS: tuple[Question[Params, State], ...] = (
    Question(
        "radius",
        "With a radius of 15 cm about a quarter of the kept matches are right. How many per cent"
        " are with 7 cm?",
        answer=kept_share,
        why=lambda states: (
            f"{percent(kept_share(states) / 100, 0)}. So near, a surface is almost flat, and all"
            " flat places look alike. A larger neighbourhood tells more, until it reaches over the"
            " border of what both scans saw."
        ),
        params=SMALL,
        unit="%",
        tolerance=4.0,
        step=6,
        wrong=(
            (
                10.0,
                14.0,
                (
                    "That is the share shrunk as the radius is. A descriptor loses more than that:"
                    " near by, hardly any bend is left to tell places apart."
                ),
            ),
            (
                20.0,
                30.0,
                (
                    "It would stay the same if the bends near by told as much. But near by all"
                    " surface is flat."
                ),
            ),
            (
                31.0,
                100.0,
                (
                    "Smaller is more exact in place, but about less: a flat spot looks like any"
                    " other flat spot."
                ),
            ),
        ),
    ),
    Question(
        "inwards",
        "The filter keeps some 170 of 2,000 matches. How many does it keep when all normals of the"
        " source face inwards?",
        answer=_which_inwards,
        why=lambda states: (
            f"{counted(int(kept_count(states)), 'match', 'matches')}. With both normals of a pair"
            " flipped, θ and φ change their signs, so the histograms of a place have little in"
            " common. Orient both scans by the same rule."
        ),
        params=FLIPPED,
        step=6,
        choices=(
            Choice(
                "About as many: a pair's angles are the same",
                why=(
                    "Angles of a motion stay, but flipping normals is no"
                    " motion: θ and φ change their signs, and only α stays."
                ),
            ),
            Choice(
                "About half",
                why=(
                    "One of the three angles stays, and two change their signs. A descriptor is"
                    " compared as a whole."
                ),
            ),
            "Fewer than a third",
        ),
    ),
    Question(
        "ring",
        "The vase starts 140° away, with no noise that matters. Does the registration come home?",
        answer=lambda states: 0.0 if end(states).home else 1.0,
        why=lambda states: (
            f"It ends {angle(end(states).error.rotation)} off. Each place of a vase has a ring of"
            " places that look the same, so no descriptor can tell them apart: the data do not"
            " hold the answer."
        ),
        params=VASE,
        choices=(
            Choice(
                "Yes, from any start",
                why=(
                    "That is so for the rabbit. A vase turned about its axis looks as before, so"
                    " matches can agree on a wrong turn."
                ),
            ),
            "No",
        ),
    ),
    Question(
        "thirty",
        "Upright patches match photographs with 90 % right. The right one is turned by 30°. How"
        " many per cent now?",
        answer=kept_share,
        why=lambda states: (
            f"{percent(kept_share(states) / 100, 0)}. The pixels of a patch moved to other rows and"
            " columns. SIFT measures the main direction at each corner first, and describes what"
            " it sees along it."
        ),
        params=TURNED,
        unit="%",
        tolerance=10.0,
        wrong=(
            (
                85.0,
                100.0,
                "So many are right upright, and at 10° still. A patch forgives small turns only.",
            ),
            (70.0, 84.0, "So many are right at 15°. From there on it falls fast."),
            (25.0, 45.0, "So many are right at 20°. At 30° still fewer are."),
        ),
    ),
)
