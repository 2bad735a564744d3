"""The chapters of the course: their names, their order, and where a lesson stands among them."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Chapter:
    """A chapter: its name, which lessons write, and what it is about, in one line."""

    name: str
    line: str

    @property
    def address(self) -> str:
        """Its name in addresses; no other part of a page has it as its id."""
        return f"chapter-{self.name.lower()}"


CHAPTERS = (
    Chapter("Move", "Where things are, and how they get somewhere else."),
    Chapter(
        "Estimate",
        "Find the answer although measurements are noisy and some of them are wrong.",
    ),
    Chapter("See", "From the world into a picture, and back."),
    Chapter("Measure", "How far apart, how large and how curved things are."),
    Chapter("Connect", "Join neighbours, and let what they know spread."),
    Chapter("Learn", "What a network can say of a shape, and what it cannot."),
)
"""In course order."""
MORE = Chapter("More", "Lessons of others.")
"""Where a lesson stands that names no chapter; the last."""
NAMES = tuple(chapter.name for chapter in CHAPTERS)
MINUTES = 20
"""How long a lesson takes that does not say it."""


def chapter_of(name: str) -> Chapter:
    """Return a chapter by its name; `MORE` for any other name."""
    return next((chapter for chapter in CHAPTERS if chapter.name == name), MORE)


def place(chapter: str, order: float, name: str) -> tuple[int, float, str]:
    """Return what lessons are sorted by: chapter, place in it, and name.

    Args:
        chapter: The name of the lesson's chapter; any other name stands last.
        order: The lesson's place in the course.
        name: The lesson's name, which decides between equal places.

    Examples:
        >>> sorted(
        ...     [
        ...         place("", 1, "theirs"),
        ...         place("See", 800, "pinhole"),
        ...         place("Move", 100, "transforms"),
        ...     ]
        ... )
        [(0, 1, 'turns'), (2, 800, 'pinhole'), (6, 1, 'theirs')]
    """
    return [*CHAPTERS, MORE].index(chapter_of(chapter)), order, name
