"""What the story of a lesson promises: its form, that all it names is there, and that its
numbers are those of the runs.
"""

from collections import Counter

import numpy as np

from workbench.authoring.promises import Found, Subject, promise
from workbench.errors import AuthorError
from workbench.machinery.authors import place
from workbench.page.charts import slug
from workbench.run.timeline import Timeline
from workbench.scene import Curve, Table
from workbench.story import StagePlace, Story, has_story, story_of
from workbench.story.names import Names
from workbench.story.places import disagreement, series_in, step_in

MOST_WORDS = 140
"""Of a scene's title and paragraphs; 60 to 120 are aimed at."""
MOST_WHAT_IFS = 3
PARTS_OF_A_PLOT = ("curve", "second", "mark", "band")


def _story(subject: Subject, home: str = "live") -> Story | None:
    """Return the lesson's story; None where it has none, or one that is told to be wrong by the
    first promise.
    """
    try:
        return story_of(subject.lesson, home)
    except AuthorError:
        return None


def _line(subject: Subject, line: int) -> str:
    return f"{subject.who}: {place(str(subject.lesson.page), line)}"


@promise
def the_story_is_read(subject: Subject) -> Found:
    """All that the story names in its attributes and links is there, as a live page and a site
    have it.
    """
    if not has_story(subject.lesson):
        return
    for home in ("live", "site"):
        try:
            story_of(subject.lesson, home)
            yield None
        except AuthorError as error:
            yield str(error)
            return


@promise
def a_scene_keeps_its_form(subject: Subject) -> Found:
    """A scene has few words, one question at most, one number under the hand, and no more
    what-ifs than three.
    """
    story = _story(subject)
    if story is None:
        return
    for scene in story.scenes:
        where = f"{_line(subject, scene.line)}: the scene {scene.name!r}"
        many = scene.words > MOST_WORDS
        yield f"{where} has {scene.words} words, over {MOST_WORDS}" if many else None
        asks = len(scene.questions)
        yield f"{where} asks {asks} questions; one at most" if asks > 1 else None
        hands = {name for _, name, _ in (*scene.told.knobs, *scene.told.series)}
        several = f"{where} has {len(hands)} numbers under the hand ({', '.join(sorted(hands))})"
        yield f"{several}; one at most" if len(hands) > 1 else None
        what_ifs = scene.html.count('<div class="what-if"')
        yield f"{where} has {what_ifs} what-ifs" if what_ifs > MOST_WHAT_IFS else None
    hand = any(scene.told.knobs or scene.told.series for scene in story.scenes)
    yield None if hand else f"{subject.who}: no scene of the story has a number under the hand"
    yield (
        None
        if any(scene.is_turn for scene in story.scenes)
        else (f"{subject.who}: {subject.lesson.page}: the story has no ## Your turn {{.turn}}")
    )


@promise
def every_question_has_its_scene(subject: Subject) -> Found:
    """Each question of the lesson is asked once, and its frozen start is a step of the run
    beside it.
    """
    story = _story(subject)
    if story is None:
        return
    asked = Counter(name for scene in story.scenes for name in scene.questions)
    for question in subject.lesson.questions:
        here = asked[question.name] == 1
        yield None if here else f"{subject.who}, question {question.name!r}: no scene asks it"


@promise
def every_place_of_the_story_is_in_its_run(subject: Subject) -> Found:
    """Each step is one of its run, each chart is one that this step shows, and what is hidden is
    there.
    """
    story = _story(subject)
    if story is None:
        return
    for run, places in _by_run(story).items():
        timeline = _run(subject, run)
        if timeline.stopped is not None:
            continue  # which is told of the run
        for here, line in places:
            yield from _in_run(here, timeline, _line(subject, line))


def _by_run(story: Story) -> dict[str, list[tuple[StagePlace, int]]]:
    by_run: dict[str, list[tuple[StagePlace, int]]] = {}
    for scene in story.scenes:
        for here, line in scene.told.places:
            by_run.setdefault(here.run, []).append((here, line))
    return by_run


def _run(subject: Subject, name: str) -> Timeline:
    params = Names(subject.lesson, "live").params_of(name)
    return subject.whole(params, f"the run {name!r}")


def _in_run(here: StagePlace, timeline: Timeline, where: str) -> Found:
    steps = [here.step] if here.start is None else [here.start, here.step]
    for step in steps:
        known = step_in(timeline, step) is not None
        yield (
            None
            if known
            else (f"{where}: the run {here.run!r} has no step {step}; it has {len(timeline)} steps")
        )
    k = step_in(timeline, here.step)
    if k is None:
        return
    for name in [chart.partition("@")[0] for chart in here.chart.split(",") if chart]:
        known_charts = charts_at(timeline, k)
        listed = ", ".join(sorted(known_charts)) or "none"
        yield (
            None
            if name in known_charts
            else f"{where}: {here.run}@{here.step} has no chart {name!r}; it has: {listed}"
        )
    for name in here.hide:
        yield (
            None
            if _can_be_hidden(name, timeline, k)
            else (f"{where}: hide={name} names nothing that {here.run}@{here.step} shows")
        )


def charts_at(timeline: Timeline, k: int) -> set[str]:
    """Return the names of the charts of a step: those of its curves and tables, and of the run's
    scalars.
    """
    charts = {slug(series.scalar.chart) for series in timeline.series().values()}
    for primitive in timeline[k].scene.values():
        if isinstance(primitive, Curve):
            charts.add(slug(primitive.chart))
        elif isinstance(primitive, Table):
            charts.add(slug(primitive.title))
    return charts


def _can_be_hidden(name: str, timeline: Timeline, k: int) -> bool:
    scene = timeline[k].scene
    parts = [thing for thing in scene.values() if isinstance(thing, Curve) and thing.part]
    if parts and (name in PARTS_OF_A_PLOT or name in {slug(part.name) for part in parts}):
        return True
    return any(path == name or path.startswith(f"{name}/") for path in scene)


@promise
def the_numbers_of_the_story_are_those_of_its_runs(subject: Subject) -> Found:
    """Each number in the words that names a scalar agrees with it within the digits that are
    written.
    """
    story = _story(subject)
    if story is None:
        return
    for scene in story.scenes:
        for value in scene.told.values:
            wrong = disagreement(value, _run(subject, value.run))
            yield None if wrong is None else f"{_line(subject, value.line)}: {wrong}"


@promise
def what_is_under_the_hand_moves(subject: Subject) -> Found:
    """A number that the run's own steps are the values of has a value at each step, and goes one
    way.
    """
    story = _story(subject)
    if story is None:
        return
    for scene in story.scenes:
        for run, name, line in scene.told.series:
            series = series_in(_run(subject, run), name)
            if series is None:
                yield f"{_line(subject, line)}: the run {run!r} has no scalar {name!r}"
                continue
            steps = np.diff(series.values)
            one_way = bool(np.isfinite(steps).all() and ((steps > 0).all() or (steps < 0).all()))
            yield (
                None
                if one_way
                else (
                    f"{_line(subject, line)}: {name} does not grow or fall at every step of {run!r}"
                )
            )


@promise
def a_knob_of_the_story_is_published(subject: Subject) -> Found:
    """A knob in the words has a sweep of the run beside it, or stands where only a live page
    says it.
    """
    story = _story(subject, "site")
    if story is None:
        return
    names = Names(subject.lesson, "site")
    for scene in story.scenes:
        for run, name, line in scene.told.knobs:
            yield (
                None
                if names.can_turn(name, run)
                else (
                    f"{_line(subject, line)}: the knob {name!r} is plain text on a site; "
                    "give it a Sweep of this run, or write {{live: ...}}"
                )
            )
