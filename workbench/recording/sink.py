"""Makes a Rerun stream equal to scenes, one step after another, and says only what has changed since the step before."""

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import rerun as rr

from workbench.recording.chart import GREY, chart, color_bar, legend
from workbench.recording.glyphs import safe
from workbench.recording.images import encoded
from workbench.recording.spatial import Aspect, ClassNumbers, aspects
from workbench.scene import (
    PALETTE,
    Camera,
    Caption,
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

TONES = {"info": "", "good": "✓ ", "wrong": "✗ "}


class RerunSink:
    """Writes scenes into a recording stream.

    Entities: `world/PATH` in space, `pictures/PATH`, `charts/TITLE`, `tables`, `legend`, `caption`. Scalars are not said
    here: they go as whole columns.

    Args:
        stream: Rerun's recording stream.
        later: Entities of charts and pictures that appear in the middle of the run: at which step, and the middle of
            their canvas. Until then it says so there.
    """

    def __init__(self, stream: Any, later: Mapping[str, tuple[int, tuple[float, float]]] = MappingProxyType({})):
        self._stream = stream
        self._later = later
        self._said: dict[str, dict[str, Aspect]] = {}
        self._numbers = ClassNumbers()

    def show(self, k: int, scene: Scene) -> None:
        """Make the stream show `scene` from step k on."""
        self._stream.set_time("step", sequence=k)
        wanted = {entity: {aspect.name: aspect for aspect in said} for entity, said in self._entities(k, scene)}
        for entity, said in self._said.items():
            if not said.keys() <= wanted.get(entity, {}).keys():  # it, or a part of it, is gone
                for suffix in {aspect.suffix for aspect in said.values()}:
                    self._stream.log(entity + suffix, rr.Clear(recursive=True))
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
            if in_space(primitive):
                yield entity_of("world", path), aspects(primitive, self._numbers)
            elif isinstance(primitive, Picture):
                yield entity_of("pictures", path), _picture(primitive)
            elif isinstance(primitive, Caption):
                yield "/caption", (Aspect("text", (k,), lambda caption=primitive: _caption(caption)),)
        yield from _beside(scene)
        for entity, (first, middle) in self._later.items():
            if k < first:
                yield entity, (Aspect("later", (), lambda first=first, middle=middle: _announcement(first, middle)),)


def entity_of(*parts: str) -> str:
    """Return an entity path of these parts, each kept whole: a scene's `a/b` is no child of `a`."""
    return "/" + rr.new_entity_path(list(parts)).removeprefix("/")


def chart_entity(title: str) -> str:
    """Return where a chart of Curves is drawn."""
    return entity_of("charts", title)


def _beside(scene: Scene) -> Iterator[tuple[str, Iterable[Aspect]]]:
    charts: dict[str, list[Curve]] = {}
    for primitive in scene.values():
        if isinstance(primitive, Curve):
            charts.setdefault(primitive.chart, []).append(primitive)
    for title, curves in charts.items():
        yield chart_entity(title), _drawn(tuple(curves), lambda curves=curves: chart(curves), _CHART_PARTS)
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
        if not isinstance(primitive, (Points, Segments, Mesh, Camera)):
            continue
        color, name = primitive.color, primitive.name
        if isinstance(color, Classes):
            names |= {(word, PALETTE[role]): None for word, role in zip(color.names, color.roles, strict=True)}
        elif isinstance(color, str) and name:
            names[name, PALETTE[color]] = None
        elif isinstance(color, Field) and not any(_same_bar(color, field) for field in fields):
            fields.append(color)
    return tuple(names), tuple(fields)


def table_text(table: Table) -> str:
    """Return a table as Markdown."""
    cells = [[_cell(text) for text in row] for row in (table.header, *table.rows)]
    rows = [f"| {' | '.join(row)} |" for row in cells]
    return "\n".join([f"**{_cell(table.title)}**", "", rows[0], "|" + "---|" * len(table.header), *rows[1:]])


def _cell(text: str) -> str:
    text = safe(text).replace("\\", "\\\\").replace("\n", " ")
    for special in "|*_`<":
        text = text.replace(special, "\\" + special)
    return text


def _announcement(first: int, middle: tuple[float, float]) -> list[Any]:
    word = f"from step {first} on"
    return [rr.Points2D([middle], labels=[word], colors=GREY, radii=0.01, show_labels=True)]


def _caption(caption: Caption) -> list[Any]:
    """Return the words as a reader sees them, and as they were, for whoever reads the file."""
    shown = f"### {TONES[caption.tone]}{_cell(caption.text)}"
    return [document(shown), rr.AnyValues(caption=caption.text, tone=caption.tone)]


def document(markdown: str) -> Any:
    """Return Markdown as a document of Rerun."""
    return rr.TextDocument(markdown, media_type=rr.MediaType.MARKDOWN)


_CHART_PARTS = ("frame", "words", "curves", "dots")


def _drawn(key: tuple, draw: Any, parts: tuple[str, ...]) -> Iterator[Aspect]:
    """Return what draws several parts at once as one aspect per part."""
    made: dict[str, Any] = {}

    def part(name: str) -> list[Any]:
        if not made:
            made.update(draw())
        return [made[name]]

    for name in parts:
        yield Aspect(name, key, lambda name=name: part(name), f"/{name}")


def _picture(picture: Picture) -> Iterator[Aspect]:
    yield Aspect("image", (picture.image,), lambda: [encoded(picture.rgb())], "/image")
    field = picture.image
    if isinstance(field, Field):
        h, w = field.values.shape
        key = (field.low, field.high, field.title, field.unit, field.map, h, w)
        yield from _drawn(key, lambda: color_bar(field, 0.0, h + 0.02 * w, float(w), 0.04 * w), ("bar", "ends"))


def _legend(entries: tuple[tuple[str, tuple[int, int, int]], ...], fields: tuple[Field, ...]) -> Iterator[Aspect]:
    bars = [(field.low, field.high, field.title, field.unit, field.map) for field in fields]
    parts = tuple(name for i in range(len(fields)) for name in (f"bar{i}", f"ends{i}"))
    yield from _drawn((entries, bars), lambda: legend(entries, fields), ("names", *parts))


def _same_bar(a: Field, b: Field) -> bool:
    return (a.low, a.high, a.title, a.unit, a.map) == (b.low, b.high, b.title, b.unit, b.map)


def _same_key(a: tuple[Any, ...], b: tuple[Any, ...]) -> bool:
    return len(a) == len(b) and all(same(x, y) for x, y in zip(a, b, strict=True))
