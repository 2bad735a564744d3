"""What captions of the disparity lesson say of errors in disparity and depth, decided from the
maps that a run carries.
"""

import re

import numpy as np

from lessons.disparity.captions import caption as caption_of_map
from lessons.disparity.lesson import draw
from lessons.disparity.matching import State
from tests.readings import LENGTH, NUMBER, metres, number, says_length
from tests.truths.disparity import found_at
from tests.verdicts import Claim, Run
from workbench.lesson import Look
from workbench.scene import Caption, caption_of


def caption(look: Look) -> Caption:
    return caption_of_map(look) if isinstance(look.now, State) else caption_of(draw(look))


def first_order(run: Run, k: int, m: re.Match[str]) -> bool:
    e = number(m["e"])
    fB = run.subject.f * run.subject.pair.camera.baseline
    pairs = [part.split(" by ") for part in m["list"].split(", ")]
    return all(
        np.isclose(metres(moved), metres(z) ** 2 / fB * e, rtol=0.03, atol=6e-4)
        for z, moved in pairs
    )


def measured(run: Run, k: int, m: re.Match[str]) -> bool:
    """The boards, at 1, 5 and 20 m, moved by this in the median."""
    texts = m["list"].split(", ")
    moved = [abs(depth - z) for z, depth in found_at(run, k).items()]
    return all(says_length(text, off_by) for text, off_by in zip(texts, moved, strict=True))


CAPTIONS = (
    Claim(
        rf"To first order (?P<e>{NUMBER}) px of error moves a depth by Z² / \(f B\):"
        rf" (?P<list>(?:{LENGTH} by {LENGTH}(?:, )?)+)",
        first_order,
    ),
    Claim(rf"Measured: (?P<list>{LENGTH}(?:, {LENGTH})*)", measured),
    Claim(
        r"[Ww]rong pixels|are wrong|in truth|of the truth|to the right|(?:down|up) and right", None
    ),
    Claim(r"left and right disagree|what the right camera|is the left one the right one", None),
    Claim(r"With the pictures exchanged more pixels find each other", None),
)
