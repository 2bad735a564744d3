r"""Finds what tells the answer of a question before it is asked.

A page may teach the principle from which an answer follows; it may not state the case that a
question asks about.

What is looked at: `tests.passages`.

Which passages are about a question: those of its own run (the preset with its params, a list item
that names that preset, the caption of a run with its params), and those that share content words
with the question's text (stemmed, without numbers and units).

Three rules; the answer is computed from the run:

1. A number gives the answer away when it would be accepted as right, has the unit that is asked for
   (m, cm and mm are one unit; a list "35, 169 or 574 samples" has its last entry's unit), and its
   passage is of the question's run or shares two content words with it. A count without a unit
   ("2-D", "step 2") is never compared: where a question asks for a count, its unit is what follows
   "how many" or a number in it, and one shared word is enough. A bare number (behind an equals
   sign, in a table; a share where percent are asked for) and zero, which needs no unit, count where
   the passage is of the question's run or shares three words. In texts on another preset's run more
   than half of the question's content words are to be shared. Words are numbers too: "a dozen",
   "two thirds", "one in five"; a share or a multiple ("a sixth", "twice") also stands for that part
   of each number of the same unit in the question.
2. A sentence states a choice when its passage is of the question's run, or shares half of the
   question's content words and at least three, and it holds a larger part of the words that only
   the right choice has than of any wrong choice's own words. So "120° away: settled and wrong"
   gives away "Lower the RMSE to the end and be wrong".
3. What neither rule can read is listed by hand, as patterns: for each question the sentences that
   would tell its answer.

What the rules misread is listed too, and left out of what they read.
"""

import functools
import itertools
import re
from collections.abc import Iterable, Iterator

from tests.passages import Passage, facts, read
from workbench.lesson import Question

# numbers ------------------------------------------------------------------------------------------

ONES = {
    "zero": 0,
    "one": 1,
    "two": 2,
    "three": 3,
    "four": 4,
    "five": 5,
    "six": 6,
    "seven": 7,
    "eight": 8,
    "nine": 9,
    "ten": 10,
    "eleven": 11,
    "twelve": 12,
}
WORDS = ONES | {
    "none": 0,
    "dozen": 12,
    "twenty": 20,
    "thirty": 30,
    "forty": 40,
    "fifty": 50,
    "hundred": 100,
}
PARTS = {
    "half": 2,
    "halves": 2,
    "third": 3,
    "quarter": 4,
    "fifth": 5,
    "sixth": 6,
    "seventh": 7,
    "eighth": 8,
    "ninth": 9,
    "tenth": 10,
    "twentieth": 20,
    "hundredth": 100,
}
UNITS = {
    "m": ("m", 1.0),
    "metres": ("m", 1.0),
    "cm": ("m", 0.01),
    "mm": ("m", 0.001),
    "km": ("m", 1000.0),
    "m²": ("m²", 1.0),
    "m⁻²": ("m⁻²", 1.0),
    "m⁻¹": ("m⁻¹", 1.0),
    "°": ("deg", 1.0),
    "deg": ("deg", 1.0),
    "degrees": ("deg", 1.0),
    "rad": ("deg", 57.3),
    "px": ("px", 1.0),
    "pixels": ("px", 1.0),
    "pixel": ("px", 1.0),
    "π": ("π", 1.0),
    "%": ("%", 1.0),
    "percent": ("%", 1.0),
    "times": ("times", 1.0),
}
BASE = {base for base, _ in UNITS.values()}
COUNT = rf"[−-]?\d[\d,]*(?:\.\d+)?|½|\b(?:{'|'.join(WORDS)})\b"
NUMBERS = re.compile(
    rf"(?<![\w.])(?:{COUNT})(?:(?:,| or| and| to|, or|, and|–| →) (?:{COUNT}))*", re.IGNORECASE
)
PART = re.compile(
    rf"\b(?:(a|{'|'.join(ONES)}) )?({'|'.join(PARTS)})s?\b|\b({'|'.join(WORDS)}|\d+) (?:in|out of)"
    rf" ({'|'.join(WORDS)}|\d+)\b"
    rf"|\b(twice|doubles?|doubled)\b|\b({'|'.join(WORDS)}|\d+)(?:fold| times)\b",
    re.IGNORECASE,
)


def number(text: str) -> float:
    text = text.lower().replace(",", "").replace("−", "-")
    if text == "½":
        return 0.5
    return float(WORDS.get(text, text))


def numbers(text: str) -> Iterator[tuple[float, str]]:
    """Yield each number of a text in its base unit, with that unit: a known one, or the stem of the
    word that follows.

    A bare number, behind an equals sign or in a table, has the unit "".
    """
    for match in NUMBERS.finditer(text):
        behind = re.match(r"[)\s]*([°%π]|m[²⁻][²¹]?|[A-Za-z]+)?", text[match.end() :])
        word = (behind.group(1) if behind else None) or ""
        unit, factor = UNITS.get(word, (stem(word) or "none", 1.0))
        if unit not in BASE and re.search(r"[=≈<>|] ?$", text[: match.start()]):
            unit = ""
        for each in re.findall(COUNT, match.group(), re.IGNORECASE):
            yield number(each) * factor, unit


def parts(text: str) -> Iterator[float]:
    """Yield each share or multiple that is written in words: "a sixth", "three in ten", "twice"."""
    for count, part, some, of, twice, fold in PART.findall(text):
        if twice or fold:
            yield 2.0 if twice else number(fold)
        elif some:
            yield number(some) / max(number(of), 1.0)
        elif count or part in ("half", "halves"):
            yield number("one" if count.lower() in ("", "a") else count) / PARTS[part.lower()]


def units_of(question: Question) -> set[str]:
    """Return the units that an answer may have: the question's, or what "how many" and its numbers
    count.
    """
    if question.unit in UNITS:
        return {UNITS[question.unit][0]}
    counted = re.findall(r"[Hh]ow many ([a-z]+)|\d ([a-z]+)", question.text)
    return {
        stem(word)
        for word in (*itertools.chain(*counted), question.unit)
        if word and word not in SMALL
    }


def by_number(
    question: Question, right: float, texts: Iterable[Passage]
) -> Iterator[tuple[Passage, str]]:
    """Yield the passages that hold a number which would be accepted as right."""
    units = units_of(question)
    about = words(question.text)
    enough = 2 if question.unit in UNITS else 1
    given = [value for value, unit in numbers(question.text) if unit in units]

    def accepted(value: float) -> bool:
        return abs(value - right) <= question.tolerance

    for passage in texts:
        shared = len(about & words(passage.text))
        if passage.params == question.params:
            shared = len(about)
        elif passage.params is not None and 2 * shared <= len(about):
            continue
        for value, unit in numbers(passage.text):
            bare = bool(question.unit) and unit not in BASE and (unit == "" or value == 0)
            meant = 100 * value if bare and question.unit == "%" else value
            if accepted(meant) and ((unit in units and shared >= enough) or (bare and shared >= 3)):
                yield passage, f"{value:g} {unit}".strip()
        for part in parts(passage.text):
            values = [part * value for value in given] + ([100 * part] if "%" in units else [])
            if shared >= 2 and any(accepted(value) for value in values):
                yield passage, f"a part or multiple of {part:.3g}"


# choices ------------------------------------------------------------------------------------------

SMALL = frozenset(
    re.findall(
        r"\w+",
        "a an and any are as at be because been but by can did do does end ends for from had has"
        " have how if in into is it its like many more much no not of off on one only or other so"
        " some than that the their them then there these they this those to too up was what when"
        " where which who will with without would you your",
    )
)


@functools.cache
def stem(word: str) -> str:
    """Return a word without its common endings."""
    word = word.lower()
    for ending in ("ingly", "edly", "ing", "ied", "ies", "ed", "es", "ly", "est", "er", "s", "e"):
        if word.endswith(ending) and len(word) - len(ending) >= 3:
            return word[: -len(ending)]
    return word


@functools.cache
def words(text: str) -> set[str]:
    """Return the stems of the content words of a text: without small words, numbers and units."""
    stems = {
        stem(word)
        for word in re.findall(r"[^\W\d_]+", text)
        if word.lower() not in SMALL and word not in UNITS
    }
    return stems - {stem(word) for word in (*WORDS, *PARTS)}


def choice_words(text: str) -> set[str]:
    """Return what a choice says: its content words; its numbers and small words where it has no
    others.
    """
    return words(text) or {stem(word) for word in re.findall(r"\w+", text)}


def by_choice(
    question: Question, right: float, texts: Iterable[Passage]
) -> Iterator[tuple[Passage, str]]:
    """Yield the passages with a sentence that states the right choice more than any wrong one."""
    says = [choice_words(choice) for choice in question.choices]
    own = [mine - set().union(*(other for other in says if other is not mine)) for mine in says]
    about = words(question.text)
    which = int(right)
    for passage in texts:
        shared = len(about & words(passage.text))
        if passage.question == question.name or (
            passage.params != question.params and (shared < 3 or 2 * shared < len(about))
        ):
            continue
        for sentence in re.split(r"(?<=[.:;?!])\s+", passage.text):
            stated = {stem(word) for word in re.findall(r"\w+", sentence)}
            held = [len(mine & stated) / len(mine) if mine else 0.0 for mine in own]
            if held[which] > max(part for i, part in enumerate(held) if i != which):
                yield (
                    passage,
                    (
                        f"says {', '.join(sorted(own[which] & stated))!r} of"
                        f" {question.choices[which]!r}"
                    ),
                )


def by_hand(
    question: Question, patterns: Iterable[str], texts: Iterable[Passage]
) -> Iterator[tuple[Passage, str]]:
    """Yield the passages with a sentence that was listed as one that tells the answer."""
    for passage, pattern in itertools.product(texts, patterns):
        match = re.search(pattern, passage.text, re.IGNORECASE)
        if match and passage.question != question.name:
            yield passage, f"says {match.group()!r}"


def spoilers(
    name: str, question: Question, giveaways: Iterable[str], *, innocent: str = ""
) -> list[str]:
    """Return one line for every passage that gives the answer away, with what does."""
    texts = list(read(name, question.name, innocent))
    right = facts(name)[1][question.name]
    by_rule = [*(by_choice if question.choices else by_number)(question, right, texts)]
    reasons: dict[str, list[str]] = {}
    for passage, why in [*by_rule, *by_hand(question, giveaways, texts)]:
        whys = reasons.setdefault(f"{passage.where}: {passage.text}", [])
        whys += [why] if why not in whys else []
    return [f"{where}  [{'; '.join(why)}]" for where, why in reasons.items()]
