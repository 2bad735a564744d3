"""A story as it was read from page.md: scenes, their beats, and the runs and steps that these
show.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias

StepName: TypeAlias = int | str
"""A step: an index, negative from the end, or `stop`, the end of the run itself before any tries
of other starts.
"""


@dataclass(frozen=True)
class StagePlace:
    """What the stage shows while a beat is read.

    Args:
        run: The name of a run: `default`, a preset, or a question.
        step: The step it stands at, or comes to by playing.
        start: The step where playing starts; None where nothing is played.
        view: The name of a camera; empty for that of the run.
        chart: The names of the charts, joined by commas; empty for none.
        hide: Names of what is left out of the picture and the chart.
    """

    run: str = "default"
    step: StepName = 0
    start: StepName | None = None
    view: str = ""
    chart: str = ""
    hide: tuple[str, ...] = ()

    def come_to_rest(self) -> "StagePlace":
        """Return the place where playing has ended."""
        return replace(self, start=None)

    def data(self) -> dict[str, Any]:
        """Return the place as plain data; `from` stands in it only where something is played."""
        start = {} if self.start is None else {"from": self.start}
        place = {"run": self.run, "step": self.step, "view": self.view, "chart": self.chart}
        return place | start | {"hide": list(self.hide)}


@dataclass(frozen=True)
class Value:
    """A number of the words that a run must bear out: its text, the series, and where in the run.

    Args:
        text: The number as it is written, with its unit.
        series: The path or name of a scalar.
        run, step: Where it is read.
        line: The line of page.md.
    """

    text: str
    series: str
    run: str
    step: StepName
    line: int


@dataclass(frozen=True)
class Told:
    """What the words of a scene name, each with its line: what a check compares with the
    lesson's runs.
    """

    values: tuple[Value, ...] = ()
    series: tuple[tuple[str, str, int], ...] = ()  # (run, name, line)
    knobs: tuple[tuple[str, str, int], ...] = ()  # likewise
    places: tuple[
        tuple[StagePlace, int], ...
    ] = ()  # of beats and links; a link has its run and step alone


@dataclass(frozen=True)
class TextScene:
    """A scene as it is read.

    Args:
        name: Its name in addresses.
        title: Its heading, as plain text.
        html: Its section.
        beats: What the stage shows, one after the other.
        words: How many words its title and paragraphs have.
        questions: The names of what it asks.
        line: The line of its heading in page.md.
        told: What its words name.
        is_turn: Whether it hands over to the reader instead of telling something.
    """

    name: str
    title: str
    html: str
    beats: tuple[StagePlace, ...]
    words: int
    questions: tuple[str, ...]
    line: int
    told: Told = field(default_factory=Told)
    is_turn: bool = False


@dataclass(frozen=True)
class Story:
    """A lesson's story.

    Args:
        title: The lesson's title.
        scenes: What is told, in order.
        reference: What stands folded behind it, as HTML.
        starts: Where each question is asked, and where its answer is seen: a step of its own run.
    """

    title: str
    scenes: tuple[TextScene, ...]
    reference: str
    starts: Mapping[str, tuple[StagePlace, StagePlace]]

    @property
    def html(self) -> str:
        """The scenes and what is folded behind them."""
        return "".join(scene.html for scene in self.scenes) + self.reference

    def runs_before_what_ifs(self) -> tuple[str, ...]:
        """Return the runs that are shown up to the first scene that offers others, each once, in
        order.
        """
        runs: dict[str, None] = {}
        for scene in self.scenes:
            runs |= dict.fromkeys(place.run for place in scene.beats)
            if '<div class="what-if' in scene.html:
                break
        return tuple(runs)
