"""No text that stands before a prediction tells its answer; `tests.spoilers` says what is looked at and by which rules.

A page may teach the principle from which an answer follows; it may not state the case that a question asks about.
"""

import pytest

from tests.spoilers import Passage, by_choice, by_number, spoilers
from workbench.lesson import Question, catalog

GIVEAWAYS: dict[tuple[str, str], tuple[str, ...]] = {
    ("transforms", "which-order"): (r"\b2(\.1\d?)? m (off|away|apart)", r"√2 · 1\.5"),
    ("transforms", "lost-direction"): (
        r"about (one|the same) (axis|line)", r"share an axis", r"lo(st|ses?) (is )?(a|one) direction",
        r"two (independent )?directions", r"one direction (less|fewer|is lost)",
    ),
    ("transforms", "sheared-volume"): (
        r"shear\w* (keeps|preserves) (the )?volume", r"volume (stays|is kept|survives|does not|remains)",
        r"det (stays|is|=) 1\b",
    ),
    ("transforms", "mean-heading"): (r"long way", r"\b340\b", r"their mean is 0°"),
    ("transforms", "mean-matrix"): (r"nearly flat", r"(less than|under) 1 %", r"volume is 1 %", r"keeps (hardly|almost no)"),
    ("pinhole", "predict-dolly"): (r"tower[^.]*(doubles|grows|larger|172)", r"97[^.]{0,20}172"),
    ("pinhole", "predict-behind"): (
        r"lands in the picture", r"pixel in the picture", r"has a pixel although", r"looks as valid",
    ),
    ("pinhole", "predict-centre"): (r"2\.00, [−-]4\.00, 2\.50",),
    ("pinhole", "predict-rails"): (
        r"does not know t\b", r"where the camera stands does not matter", r"translation is not in",
        r"vanishing point[^.]*(stays|does not move|keeps its place)", r"rails[^.]*(stays? where|do(es)? not move)",
    ),
    ("pinhole", "predict-crop"): (r"\b49(\.\d+)?\b",),
    ("icp", "predict-matches"): (
        r"few matches are right", r"(only \d+ %|hardly any|few|none) of (them|the matches|these)", r"mostly wrong",
        r"\d+ % (at first|are right)", r"wrong (nearly|almost) everywhere",
    ),
    ("icp", "predict-far"): (
        r"120°[^.]*(wrong|settled|lost)", r"(cost|RMSE) falls at every fit", r"nearest valley, not",
        r"home up to \d+°", r"converge[^.]*wrong",
    ),
    ("icp", "predict-plane"): (r"point-to-plane: few", r"\bsixth\b", r"far fewer iterations"),
    ("icp", "predict-vase"): (
        r"turn is invisible", r"(arrow|turn) is (still )?90° off", r"fits at any turn", r"RMSE is as small as",
        r"no (data|point|method)[^.]*(could|can) tell",
    ),
    ("ransac", "predict-needed"): (r"\b3[45]\b[^.]*samples",),
    ("ransac", "predict-near-sample"): (
        r"bad plane", r"hardly any of the others", r"under a tenth", r"reaches (hardly|few|\d+ %)", r"your sample: \d+ of",
    ),
    ("ransac", "predict-two-planes"): (
        r"(is|returns|finds|gives) the wall", r"the largest wins", r"finds the largest, not", r"largest, not the right",
    ),
    ("ransac", "predict-size"): (r"seven need", r"over fifty samples", r"larger samples are (not|no)"),
    ("ransac", "predict-huber"): (r"in between", r"15 cm and 14 mm", r"Huber (is |ends )?1[34](\.\d)? mm"),
    ("curvature", "which-rolled"): (
        r"(tube|cylinder|paper)[^.]*K ?= ?0", r"unrolls? flat", r"each can be 0 without",
    ),
    ("curvature", "which-double"): (r"falls? to a quarter", r"K[^.]{0,30}\bquarter"),
    ("curvature", "which-sides"): (
        r"sign of K (is no|does not)", r"H, k.? and k.? change", r"those of H", r"H (changes|turns)[^.]*K does not",
    ),
    ("curvature", "which-finer"): (
        r"finer does not help", r"\d+ % off at any", r"stays \d+ to \d+ %", r"\d+ % to \d+ %", r"stays? wrong",
    ),
    ("curvature", "which-sum"): (r"\b4 ?π", r"\bfour π"),
    ("chamfer_emd", "predict-spread"): (
        r"chamfer clumps", r"\d+ of 80 points on", r"on the nearer (half|side)", r"half of the mass is astray",
        r"5\d % of the mass astray",
    ),
    ("chamfer_emd", "predict-flip"): (
        r"ranking flips", r"depends on the distance", r"C ?= ?0\.0039", r"nearer than the 5 % larger",
        r"to Chamfer this is closer",
    ),
    ("chamfer_emd", "predict-missing"): (
        r"source to target(, | )?C? ?is 0\b", r"that side of Chamfer is 0", r"every source point lies on the target",
        r"cannot see what the source lacks",
    ),
    ("chamfer_emd", "predict-outlier"): (
        r"Hausdorff is (that|\d+ times)", r"squares lean on", r"hardly notice",
    ),
    ("disparity", "quarter"): (r"board at 20 m", r"1, 5,? (and )?20 m", r"20 m, true 4\.2"),
    ("disparity", "nearer"): (r"20 m by", r"\b[45](\.0+)? m nearer", r"80 / 5", r"quadratic, not linear"),
    ("disparity", "averages"): (r"mean (of the depths|depth) is (further|larger|greater)", r"depths? averages? (too )?far"),
    ("disparity", "baseline"): (r"twice as (much|many)[^.]*hidden", r"half as (much|many)[^.]*hidden"),
    ("graphs", "mutual"): (
        r"\b2\d\d (components|pieces)", r"mutual[^.]*(falls apart|hundreds|many (pieces|components))",
        r"both (ends|must)[^.]*(hundreds|many (pieces|components))",
    ),
    ("graphs", "club-right"): (r"(sign|vector|Fiedler)[^.]*3[0-4] of 34", r"all but two\b", r"not 2, 8"),
    ("graphs", "longer"): (r"explode", r"grows without", r"blows? up[^-]", r"grows? at every step"),
    ("graphs", "volume"): (r"\b6\d(\.\d)? %", r"a third of (its|the) volume", r"two thirds"),
    ("graphs", "sixty-four"): (r"64[^.]*\b17\b", r"by chance alone", r"no better than", r"all (nodes|members) alike"),
    ("disparity", "window"): (r"fattened edges", r"balls have grown", r"window across an edge", r"swallows? edges"),
}  # fmt: skip
"""For each question the sentences that tell its answer, as patterns; case does not matter."""

INNOCENT: dict[tuple[str, str], str] = {
    (
        "curvature",
        "which-sides",
    ): r"H is half the normal's length",  # a letter that is a choice stands in every sentence
    ("pinhole", "predict-rails"): r"rails stay 1\.5 m apart",  # of the rails, not of where they seem to meet
    ("ransac", "predict-two-planes"): r"beside a wall",  # the question's own words
    ("graphs", "volume"): r"half way to the mean of its neighbours",  # how far a vertex goes
    ("disparity", "nearer"): r"A board 5 m away",  # where another question's board stands
    ("disparity", "baseline"): r"twice the baseline",  # the question's own words, and a choice's
}

ASKED = [(name, question) for name, lesson in catalog().items() for question in lesson.questions]


@pytest.mark.parametrize(("name", "question"), [pytest.param(n, q, id=f"{n}-{q.name}") for n, q in ASKED])
def test_nothing_before_a_prediction_tells_its_answer(name, question):
    found = spoilers(name, question, GIVEAWAYS.get((name, question.name), ()), INNOCENT.get((name, question.name), ""))
    assert not found, "\n".join(["the answer is given away:", *found])


def test_for_every_question_somebody_thought_of_what_would_tell_its_answer():
    names = {(name, question.name) for name, question in ASKED}
    assert set(GIVEAWAYS) == names
    assert set(INNOCENT) <= names


def question(text: str, unit: str = "", tolerance: float = 0.0, choices: tuple[str, ...] = ()) -> Question:
    return Question("q", text, lambda states: 0.0, lambda states: "", "a run", choices, unit, tolerance)


MATCHES = "How many percent of the first matches are right (within two point spacings)?"
FAR = "The source starts 120° away. What will ICP do?"
FAR_CHOICES = ("Come home, only more slowly", "Stop because the RMSE rises", "Lower the RMSE to the end and be wrong")
PLANE = "From 35°, point-to-point takes 61 iterations to its stop. How many does point-to-plane take?"


HOW_MANY = question(MATCHES, unit="%", tolerance=8.0)
STEPS = question(PLANE, tolerance=3.0)
HIGH = question("How high is the camera above ground?", unit="m", tolerance=0.1)
TURNS = question("In how many directions does it turn?", tolerance=0.5)
WHAT = question(FAR, choices=FAR_CHOICES)


@pytest.mark.parametrize(
    ("asked", "right", "text", "run", "told"),
    [
        (HOW_MANY, 2.0, "Read how many matches are right: 2 % at first.", None, True),
        (HOW_MANY, 2.0, "One in fifty of the matches is right.", None, True),
        (HOW_MANY, 2.0, "Half of the matches are right.", None, False),
        (HOW_MANY, 2.0, "Match 2 keeps 90 % of the points.", "a run", False),
        (STEPS, 10.0, "Point-to-plane takes a sixth of the iterations.", None, True),
        (STEPS, 10.0, "Point-to-plane stops after ten iterations.", None, True),
        (STEPS, 10.0, "Point-to-plane stops within 10 mm.", None, False),
        (HIGH, 1.7, "The camera is 170 cm above ground.", None, True),
        (HIGH, 1.7, "The wall is 1.7 m long.", None, False),
        (HIGH, 1.7, "The camera of this run is 1.7 m above ground.", "another run", True),
        (TURNS, 2.0, "A 2-D picture of a turn in one direction", None, False),
        (WHAT, 2.0, "120° away: settled and wrong", "a run", True),
        (WHAT, 2.0, "120° away: does it come home?", "a run", False),
        (WHAT, 2.0, "A fit of the wrong kind", None, False),
    ],
)
def test_the_rules_tell_a_spoiler_from_a_coincidence(asked, right, text, run, told):
    rule = by_choice if asked.choices else by_number
    assert bool(list(rule(asked, right, [Passage("here", text, run)]))) is told
