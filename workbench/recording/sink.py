"""Makes a Rerun stream equal to scenes, one step after another, and says only what has changed since the step before."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import rerun as rr

from workbench.recording.chart import GREY, chart_curves, chart_frame, color_bar, frame_key, legend_bar, legend_names
from workbench.recording.gather import Union, gathered
from workbench.recording.glyphs import safe
from workbench.recording.png import IMAGE, encoded, gone
from workbench.recording.spatial import Aspect, ClassNumbers, aspects
from workbench.scene import (
    PALETTE,
    Camera,
    Classes,
    Curve,
    Field,
    Mesh,
    Picture,
    Points,
    Scene,
    Segments,
    Table,
    in_space,
    same,
)


@dataclass(frozen=True)
class Place:
    """Where something is shown that is not there at every step: its first step, and the canvas's middle if it has one."""

    first: int
    middle: tuple[float, float] | None = None


class RerunSink:
    """Writes scenes into a recording stream.

    Entities: `world/PATH` in space, `pictures/PATH`, `charts/TITLE`, `tables`, `legend`. Scalars and captions are not said
    here: they go as whole columns.

    Args:
        stream: Rerun's recording stream.
        places: Where charts, pictures and tables are shown, by entity. While there are none, it says so there.
        unions: Clouds that are said once for all steps, by path.
    """

    def __init__(
        self,
        stream: Any,
        places: Mapping[str, Place] = MappingProxyType({}),
        unions: Mapping[str, Union] = MappingProxyType({}),
    ):
        self._stream = stream
        self._places = places
        self._unions = unions
        self._said: dict[str, dict[str, Aspect]] = {}
        self._numbers = ClassNumbers()

    def show(self, k: int, scene: Scene) -> None:
        """Make the stream show `scene` from step k on."""
        self._stream.set_time("step", sequence=k)
        wanted = {entity: {aspect.name: aspect for aspect in said} for entity, said in self._entities(k, scene)}
        for entity, said in self._said.items():
            if not said.keys() <= wanted.get(entity, {}).keys():  # it, or a part of it, is gone
                for suffix in dict.fromkeys(aspect.suffix for aspect in said.values()):  # in the same order every time
                    self._stream.log(entity + suffix, gone(suffix))
        for entity, aspects_now in wanted.items():
            before = self._said.get(entity, {})
            before = before if before.keys() <= aspects_now.keys() else {}
            news: dict[str, list[Any]] = {}
            for name, aspect in aspects_now.items():
                if name not in before or not _same_key(before[name].key, aspect.key):
                    news.setdefault(entity + aspect.suffix, []).extend(aspect.say())
            for where, archetypes in news.items():
                self._stream.log(where, *archetypes)
        self._said = wanted
        if self._numbers.new:
            self._stream.log("/world", self._numbers.table(), static=True)

    def _entities(self, k: int, scene: Scene) -> Iterator[tuple[str, Iterable[Aspect]]]:
        for path, primitive in scene.items():
            if not in_space(primitive):
                continue
            union = self._unions.get(path)
            if isinstance(primitive, Points) and union is not None and id(primitive) in union.shown:
                said = gathered(primitive, union)
            else:
                said = aspects(primitive, self._numbers)
            kind = type(primitive).__name__  # another kind at this path has no aspect in common with it
            yield entity_of("world", path), [replace(aspect, name=f"{kind} {aspect.name}") for aspect in said]
        beside = dict(_beside(scene))
        yield from beside.items()
        for entity, place in self._places.items():
            if entity not in beside:
                yield entity, (_absence(k, place),)


def entity_of(*parts: str) -> str:
    """Return an entity path of these parts, each kept whole: a scene's `a/b` is no child of `a`."""
    return "/" + rr.new_entity_path(list(parts)).removeprefix("/")


def chart_entity(title: str) -> str:
    """Return where a chart of Curves is drawn."""
    return entity_of("charts", title)


def _beside(scene: Scene) -> Iterator[tuple[str, Iterable[Aspect]]]:
    charts: dict[str, list[Curve]] = {}
    for path, primitive in scene.items():
        if isinstance(primitive, Picture) and not in_space(primitive):
            yield entity_of("pictures", path), _picture(primitive)
        elif isinstance(primitive, Curve):
            charts.setdefault(primitive.chart, []).append(primitive)
    for title, curves in charts.items():
        yield chart_entity(title), _chart(tuple(curves))
    tables = tuple(primitive for primitive in scene.values() if isinstance(primitive, Table))
    if tables:
        yield "/tables", (Aspect("text", tables, lambda: [document("\n\n".join(map(table_text, tables)))]),)
    entries, fields = legend_of(scene)
    if entries or fields:
        yield "/legend", _legend(entries, fields)


def legend_of(scene: Scene) -> tuple[tuple[tuple[str, tuple[int, int, int]], ...], tuple[Field, ...]]:
    """Return the names in the picture with their colours, and the fields that need a colour bar."""
    names: dict[tuple[str, tuple[int, int, int]], None] = {}
    fields: list[Field] = []
    for primitive in scene.values():
        if isinstance(primitive, Picture) and in_space(primitive):
            color, name = primitive.image, ""
        elif isinstance(primitive, (Points, Segments, Mesh, Camera)):
            color, name = primitive.color, primitive.name
        else:
            continue
        if isinstance(color, Classes):
            names |= {(word, PALETTE[role]): None for role, word in color.present()}
        elif isinstance(color, str) and name:
            names[name, PALETTE[color]] = None
        elif isinstance(color, Field) and all(_bar_key(color) != _bar_key(field) for field in fields):
            fields.append(color)
    return tuple(names), tuple(fields)


def table_text(table: Table) -> str:
    """Return a table as Markdown."""
    cells = [[markdown(text) for text in row] for row in (table.header, *table.rows)]
    rows = [f"| {' | '.join(row)} |" for row in cells]
    return "\n".join([f"**{markdown(table.title)}**", "", rows[0], "|" + "---|" * len(table.header), *rows[1:]])


def markdown(text: str) -> str:
    """Return plain text so that Markdown shows it as it is."""
    text = safe(text).replace("\\", "\\\\").replace("\n", " ")
    for special in "|*_`<[]":
        text = text.replace(special, "\\" + special)
    return text


def _absence(k: int, place: Place) -> Aspect:
    """Return the words where something is shown at other steps than k."""
    word = f"from step {place.first} on" if k < place.first else "not in this step"

    def say() -> list[Any]:
        if place.middle is None:
            return [document(word)]
        return [rr.Points2D([place.middle], labels=[word], colors=GREY, radii=0.01, show_labels=True)]

    return Aspect("absence", (word,), say)


def document(markdown: str) -> Any:
    """Return Markdown as a document of Rerun."""
    return rr.TextDocument(markdown, media_type=rr.MediaType.MARKDOWN)


def _chart(curves: tuple[Curve, ...]) -> Iterator[Aspect]:
    yield Aspect("frame", frame_key(curves), lambda: chart_frame(curves), "/frame")
    yield Aspect("curves", curves, lambda: chart_curves(curves), "/curves")


def _picture(picture: Picture) -> Iterator[Aspect]:
    yield Aspect("image", (picture.image,), lambda: [encoded(picture.image)], IMAGE)
    field = picture.image
    if isinstance(field, Field):
        h, w = field.values.shape
        key = (*_bar_key(field), h, w)
        yield Aspect("bar", key, lambda: color_bar(field, 0.0, h + 0.02 * w, float(w), 0.04 * w), "/bar")


def _legend(entries: tuple[tuple[str, tuple[int, int, int]], ...], fields: tuple[Field, ...]) -> Iterator[Aspect]:
    if entries:
        yield Aspect("names", entries, lambda: legend_names(entries), "/names")
    for i, field in enumerate(fields):
        key = (*_bar_key(field), len(fields), entries)
        yield Aspect(f"bar{i}", key, lambda i=i, field=field: legend_bar(field, i, len(fields), entries), f"/bar{i}")


def _bar_key(field: Field) -> tuple[Any, ...]:
    return (field.low, field.high, field.title, field.unit, field.map)


def _same_key(a: tuple[Any, ...], b: tuple[Any, ...]) -> bool:
    return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
