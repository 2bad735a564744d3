"""The documents of the live home: the course, and the page of each lesson. What an author did wrong is told in its place."""

from collections.abc import Callable, Mapping
from html import escape

from workbench import links
from workbench.authors import Blaming
from workbench.errors import InputError
from workbench.exercise.finding import exercises_of
from workbench.exercise.watching import Watched
from workbench.lesson import Lesson
from workbench.page.article import PLACE, article_html
from workbench.page.course import Card, course_document
from workbench.page.document import lesson_document
from workbench.page.exercise import exercises_html, watched_html
from workbench.viewer.terminal import tell_terminal

ROOT = "page/"


def course_page(lessons: Mapping[str, Lesson], trouble: str | None = None) -> str:
    """Return the document of the course; `trouble` says why what was asked for is not shown."""
    cards = [
        Card(
            name=lesson.name,
            title=lesson.title,
            summary=lesson.summary,
            address=address(lesson, "", None),
            picture=f"picture/{lesson.name}",
        )
        for lesson in in_order(lessons)
    ]
    return course_document(cards, root=ROOT, trouble=trouble)


def lesson_page(lesson: Lesson, lessons: Mapping[str, Lesson], watched: Watched | None = None) -> str:
    """Return the document of a lesson, with what drives it where a student's file does."""
    article = _told(lesson, "page", lambda: article_html(lesson, lambda run, step: address(lesson, run, step), "live"))
    exercises = _told(lesson, "exercises", lambda: _exercises(lesson, watched))
    course = [{"name": one.name, "title": one.title} for one in in_order(lessons)]
    return lesson_document(lesson, article, home="live", root=ROOT, ending=exercises, more={"COURSE": course})


def in_order(lessons: Mapping[str, Lesson]) -> list[Lesson]:
    """Return lessons in course order."""
    return sorted(lessons.values(), key=lambda lesson: (lesson.order, lesson.name))


def address(lesson: Lesson, run: str, step: int | None) -> str:
    """Return the relative address of a step of a run: of a preset's, or of the one by default."""
    preset = f"&preset={run}" if run not in ("", "default") else ""
    return f"?lesson={lesson.name}{preset}" + ("" if step is None else f"&step={step}")


def start_address(start: links.Place, query: str) -> str:
    """Return the relative address where browsers begin, with the keys of theirs that are not ours."""
    return links.write(start) + (f"&{query}" if query else "")


def _exercises(lesson: Lesson, watched: Watched | None) -> str:
    if watched is not None and watched.lesson is lesson:
        return watched_html(watched.exercise, watched.path.name)
    return exercises_html(exercises_of(lesson))


def _told(lesson: Lesson, what: str, make: Callable[[], str]) -> str:
    """Return HTML, or what went wrong with a lesson's files in its place."""
    try:
        with Blaming(f"lesson {lesson.name}, {what}", lesson.run):
            return make()
    except InputError as error:
        tell_terminal(error)
        return f'<p class="trouble" role="alert">{escape(str(error))}</p>' + (PLACE if what == "page" else "")
