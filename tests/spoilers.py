r"""Finds what tells the answer of a question before it is asked.

A page may teach the principle from which an answer follows; it may not state the case that a
question asks about.

What is looked at (`passages`): every paragraph, list item and table row of page.md (of a story
those above the question's card: what follows comes after the answer), the title and summary, each
preset's title and line, each question's text, each knob's label, hint, choices and default, and the
captions that are seen before anybody moves: of the default run where it opens, and of each preset
where it opens.

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
import html
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from tests.runs import finished
from workbench.knobs import fields_of
from workbench.lesson import Lesson, Preset, Question, catalog
from workbench.story import ASKED, has_story
from workbench.words.typeset import inline_html, page_html

ATTRIBUTES = re.compile(r"\{[#.:\w][^{}]*\}|^:::.*$", re.MULTILINE)
"""What page.md says to the page alone."""


@dataclass(frozen=True)
class Passage:
    """One piece of text that is seen before answering: where it stands, its words, and whose run it
    speaks of.
    """

    where: str
    text: str
    params: Any = None  # of the run it speaks of, where it speaks of one
    question: str = ""


@functools.cache
def passages(name: str) -> tuple[Passage, ...]:
    """Return every text of a lesson that is seen before a question is answered."""
    lesson = catalog()[name]
    return tuple(_passages(lesson, ASKED.sub("", lesson.text())))


@functools.cache
def before(name: str, question: str) -> tuple[Passage, ...]:
    """Return every text that is seen before a question: of a story what stands above its card."""
    lesson = catalog()[name]
    above, card, _ = lesson.text().partition(f"{{.ask #{question}")
    if not has_story(lesson):
        return passages(name)
    assert card, f"{name}: page.md does not ask {question}"
    return tuple(_passages(lesson, ATTRIBUTES.sub("", above)))


def _passages(lesson: Lesson, page: str) -> Iterator[Passage]:
    captions, default = facts(lesson.name)[0], lesson.params()
    yield Passage("title and summary", f"{lesson.title}. {lesson.summary}")
    for block in blocks(page_html(page)):
        yield from (Passage("page.md", text, params) for text, params in _by_preset(lesson, block))
    for preset in lesson.presets:
        yield Passage(f"preset {preset.name}", f"{preset.title}. {preset.line}", preset.params)
        shown = captions[preset.params, opens(lesson, preset)]
        yield Passage(f"caption where {preset.name} opens", shown, preset.params)
    yield Passage("caption where the page opens", captions[default, lesson.opens], default)
    for question in lesson.questions:
        yield Passage(
            f"question {question.name}", plain(inline_html(question.text)), None, question.name
        )
    for field in fields_of(lesson.params):
        value = (
            ", ".join(map(str, field.default))
            if isinstance(field.default, tuple)
            else str(field.default)
        )
        shown = (
            f"{field.label}: {field.knob.hint}. {', '.join(field.choices)}. {field.label}: {value}"
            f" {field.knob.unit}"
        )
        yield Passage(f"knob {field.name}", shown)


def blocks(page: str) -> list[str]:
    """Return the paragraphs, list items, headings and table rows of a page, as they read."""
    parts = re.split(
        r"</?(?:p|li|tr|h\d|ul|ol|table|thead|tbody|section|pre|blockquote)\b[^>]*>", page
    )
    return [text for text in map(plain, parts) if text]


def plain(markup: str) -> str:
    """Return the words of HTML, formulas included."""
    text = html.unescape(re.sub(r"<[^>]*>", "", re.sub(r"</(td|th)>", " | ", markup)))
    return re.sub(r"[\s\u2061-\u2064]+", " ", text).strip(" |")


def _by_preset(lesson: Lesson, text: str) -> Iterator[tuple[str, Any]]:
    """Cut a text where it names a preset, by the title or its words up to a colon; each piece with
    that preset's params.
    """
    starts: dict[int, Any] = {0: None}
    for preset in lesson.presets:
        at = text.lower().find(preset.title.split(":")[0].lower())
        if at >= 0 and len(preset.title.split(":")[0]) > 4:
            starts[at] = preset.params
    cuts = [*sorted(starts), len(text)]
    for here, end in itertools.pairwise(cuts):
        yield text[here:end], starts[here]


def read(name: str, question: str, innocent: str) -> Iterator[Passage]:
    """Yield the passages that stand before a question, without what the rules would misread."""
    for passage in before(name, question):
        yield replace(
            passage, text=re.sub(innocent or "(?!)", "…", passage.text, flags=re.IGNORECASE)
        )


@functools.cache
def facts(name: str) -> tuple[dict[tuple[Any, int], str], dict[str, float]]:
    """Return a lesson's captions where a run opens, by params and step, and the right answers; each
    run is made once.
    """
    lesson = catalog()[name]
    opened = {(preset.params, opens(lesson, preset)) for preset in lesson.presets} | {
        (lesson.params(), lesson.opens)
    }
    captions: dict[tuple[Any, int], str] = {}
    answers: dict[str, float] = {}
    for params in dict.fromkeys(
        [question.params for question in lesson.questions] + [params for params, _ in opened]
    ):
        asked = [question for question in lesson.questions if question.params == params]
        timeline = finished(name, params)
        captions |= {
            (params, step): timeline[step].caption.text for of, step in opened if of == params
        }
        answers |= {question.name: question.answer(timeline.states()) for question in asked}
    return captions, answers


def opens(lesson: Lesson, preset: Preset) -> int:
    return lesson.first_step if preset.step is None else preset.step


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
    return 0.5 if text == "½" else float(WORDS[text]) if text in WORDS else float(text)


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
    units, about = units_of(question), words(question.text)
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
    about, which = words(question.text), int(right)
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
    texts, right = list(read(name, question.name, innocent)), facts(name)[1][question.name]
    by_rule = [*(by_choice if question.choices else by_number)(question, right, texts)]
    reasons: dict[str, list[str]] = {}
    for passage, why in [*by_rule, *by_hand(question, giveaways, texts)]:
        whys = reasons.setdefault(f"{passage.where}: {passage.text}", [])
        whys += [why] if why not in whys else []
    return [f"{where}  [{'; '.join(why)}]" for where, why in reasons.items()]
