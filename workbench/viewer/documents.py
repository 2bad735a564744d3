"""The documents of the live home: the course, and the page of each lesson. What an author did wrong
is told in its place.
"""

from collections.abc import Callable, Mapping
from html import escape

from workbench.errors import InputError
from workbench.exercise.finding import exercises_of
from workbench.exercise.watching import WatchedFile
from workbench.lesson import Lesson, place_of
from workbench.machinery.authors import Blaming
from workbench.page.article import PLACE, article_html
from workbench.page.course import Card, course_document
from workbench.page.document import lesson_document
from workbench.page.exercise import exercises_html, watched_html
from workbench.run import links
from workbench.story import Story, story_of
from workbench.viewer.terminal import tell_terminal

ROOT = "page/"


def course_page(lessons: Mapping[str, Lesson], trouble: str | None = None) -> str:
    """Return the document of the course; `trouble` says why what was asked for is not shown."""
    cards = [
        Card(
            name=lesson.name,
            title=lesson.title,
            summary=lesson.summary,
            needs=lesson.needs,
            chapter=lesson.chapter,
            minutes=lesson.minutes,
            address=address(lesson, "", None),
            picture=f"picture/{lesson.name}",
        )
        for lesson in in_order(lessons)
    ]
    return course_document(cards, root=ROOT, trouble=trouble)


class LessonPages:
    """The documents of lessons, each made once for all who open it, and anew when its page.md is
    another.
    """

    def __init__(self) -> None:
        self._made: dict[str, tuple[Lesson, str, tuple[str, ...], str]] = {}

    def page(
        self, lesson: Lesson, lessons: Mapping[str, Lesson], watched: WatchedFile | None = None
    ) -> str:
        """Return the document of a lesson, as `lesson_page` does."""
        try:
            text = lesson.text()
        except InputError:  # told in its place
            text = "!["
        if (
            watched is not None or "![" in text
        ):  # what else may have changed: a student's file, a picture's
            return lesson_page(lesson, lessons, watched)
        made = self._made.get(lesson.name)
        if made is None or made[0] is not lesson or made[1:3] != (text, tuple(lessons)):
            made = self._made[lesson.name] = (
                lesson,
                text,
                tuple(lessons),
                lesson_page(lesson, lessons),
            )
        return made[3]


def lesson_page(
    lesson: Lesson, lessons: Mapping[str, Lesson], watched: WatchedFile | None = None
) -> str:
    """Return the document of a lesson, with what drives it where a student's file does."""
    article = _told(
        lesson,
        "page",
        lambda: article_html(lesson, lambda run, step: address(lesson, run, step), "live"),
    )
    exercises = _told(lesson, "exercises", lambda: _exercises(lesson, watched))
    own = watched is not None and watched.lesson is lesson
    course = [
        {"name": entry.name, "title": entry.title, "needs": entry.needs}
        for entry in in_order(lessons)
    ]
    opening, ending = (exercises, "") if own else ("", exercises)
    story, trouble = (None, "") if own else _story(lesson)
    return lesson_document(
        lesson,
        trouble + article,
        home="live",
        root=ROOT,
        opening=opening,
        ending=ending,
        more={"COURSE": course},
        still=f"picture/{lesson.name}",
        story=story,
    )


def _story(lesson: Lesson) -> tuple[Story | None, str]:
    """Return a lesson's story if one is told, and what is wrong with it in its place."""
    holder: list[Story | None] = [None]

    def read() -> str:
        holder[0] = story_of(lesson, "live")
        return ""

    trouble = _told(lesson, "story", read)
    return holder[0], trouble


def in_order(lessons: Mapping[str, Lesson]) -> list[Lesson]:
    """Return lessons in course order."""
    return sorted(lessons.values(), key=place_of)


def address(lesson: Lesson, run: str, step: int | None) -> str:
    """Return the relative address of a step of a run: of a preset's, or of the one by default."""
    preset = f"&preset={run}" if run not in ("", "default") else ""
    return f"?lesson={lesson.name}{preset}" + ("" if step is None else f"&step={step}")


def start_address(start: links.Place, query: str) -> str:
    """Return the relative address where browsers begin, with the keys of theirs that are not
    ours.
    """
    return links.write(start) + (f"&{query}" if query else "")


def _exercises(lesson: Lesson, watched: WatchedFile | None) -> str:
    if watched is not None and watched.lesson is lesson:
        return watched_html(
            watched.exercise,
            watched.path.name,
            lesson,
            address=lambda run: address(lesson, run, None),
        )
    return exercises_html(exercises_of(lesson))


def _told(lesson: Lesson, part: str, make: Callable[[], str]) -> str:
    """Return HTML, or what went wrong with a lesson's files in its place."""
    try:
        with Blaming(f"lesson {lesson.name}, {part}", lesson.run):
            return make()
    except InputError as error:
        tell_terminal(error)
        return f'<p class="trouble" role="alert">{escape(str(error))}</p>' + (
            PLACE if part == "page" else ""
        )
