"""Makes a Rerun stream equal to scenes, step by step; says only what has changed."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import rerun as rr

from workbench.recording.chart import (
    Canvas,
    Legend,
    Rgb,
    absence,
    bar_of,
    chart_curves,
    chart_frame,
    color_bar,
    legend_bar,
    legend_names,
    scales,
)
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
)

TABLES = "/tables"
"""Where all tables stand, in one document."""


class RerunSink:
    """Writes scenes into a recording stream.

    Entities: `world/PATH` in space, `pictures/PATH`, `charts/TITLE`, `tables`, `legend`. Scalars
    and captions go as whole columns, not here.

    Args:
        canvases: Where charts, pictures and tables are shown, by entity; it says so if there are
            none.
        unions: Clouds that are said once for all steps, by path.
    """

    def __init__(
        self,
        stream: Any,
        canvases: Mapping[str, Canvas] = MappingProxyType({}),
        unions: Mapping[str, Union] = MappingProxyType({}),
    ):
        self._stream = stream
        self._canvases = canvases
        self._unions = unions
        self._said: dict[str, dict[str, Aspect]] = {}
        self._numbers = ClassNumbers()

    def show(self, k: int, scene: Scene) -> None:
        """Make the stream show `scene` from step k on."""
        self._stream.set_time("step", sequence=k)
        wanted = {
            entity: {aspect.name: aspect for aspect in parts}
            for entity, parts in self._entities(k, scene)
        }
        for entity, shown in self._said.items():
            if not shown.keys() <= wanted.get(entity, {}).keys():  # it, or a part of it, is gone
                # in the same order every time
                for suffix in dict.fromkeys(aspect.suffix for aspect in shown.values()):
                    self._stream.log(entity + suffix, gone(suffix))
        for entity, parts in wanted.items():
            before = self._said.get(entity, {})
            before = before if before.keys() <= parts.keys() else {}
            news: dict[str, list[Any]] = {}
            for name, aspect in parts.items():
                if name not in before or not aspect.same(before[name]):
                    news.setdefault(entity + aspect.suffix, []).extend(aspect.say())
            for where, archetypes in news.items():
                self._stream.log(where, *archetypes)
        self._said = wanted
        if self._numbers.new:
            self._stream.log("/world", self._numbers.table(), static=True)

    def _entities(self, k: int, scene: Scene) -> Iterator[tuple[str, Iterable[Aspect]]]:
        for path, primitive in scene.items():
            if in_space(primitive):
                union = self._unions.get(path)
                if (
                    isinstance(primitive, Points)
                    and union is not None
                    and id(primitive) in union.shown
                ):
                    yield entity_of("world", path), gathered(primitive, union)
                else:
                    yield entity_of("world", path), aspects(primitive, self._numbers)
        beside = dict(_beside(scene))
        yield from beside.items()
        for entity, canvas in self._canvases.items():
            if entity not in beside:
                word = f"from step {canvas.first} on" if k < canvas.first else "not in this step"
                values = (
                    {"markdown": word} if entity == TABLES else {"word": word, "canvas": canvas}
                )
                yield entity, (Aspect(document if entity == TABLES else absence, values),)


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
        yield chart_entity(title), _chart(curves)
    tables = [table_text(primitive) for primitive in scene.values() if isinstance(primitive, Table)]
    if tables:
        yield TABLES, (Aspect(document, {"markdown": "\n\n".join(tables)}),)
    entries, fields = legend_of(scene)
    if entries or fields:
        yield "/legend", _legend(entries, fields)


def legend_of(scene: Scene) -> tuple[Legend, list[Field]]:
    """Return the names in the picture with their colours, and the fields that need a colour bar."""
    names: dict[tuple[str, Rgb], None] = {}
    fields: list[Field] = []
    for primitive in scene.values():
        if isinstance(primitive, Picture) and in_space(primitive):
            color = primitive.image
            name = ""
        elif isinstance(primitive, (Points, Segments, Mesh, Camera)):
            color, name = primitive.color, primitive.name
        else:
            continue
        if isinstance(color, Classes):
            names |= {(word, PALETTE[role]): None for role, word in color.present()}
        elif isinstance(color, str) and name:
            names[name, PALETTE[color]] = None
        elif isinstance(color, Field) and all(bar_of(color) != bar_of(field) for field in fields):
            fields.append(color)
    return tuple(names), fields


def table_text(table: Table) -> str:
    """Return a table as Markdown."""
    cells = [[markdown(text) for text in row] for row in (table.header, *table.rows)]
    rows = [f"| {' | '.join(row)} |" for row in cells]
    return "\n".join(
        [f"**{markdown(table.title)}**", "", rows[0], "|" + "---|" * len(table.header), *rows[1:]]
    )


def markdown(text: str) -> str:
    """Return plain text so that Markdown shows it as it is."""
    text = safe(text).replace("\\", "\\\\").replace("\n", " ")
    for special in "|*_`<[]":
        text = text.replace(special, "\\" + special)
    return text


def document(markdown: str) -> Any:
    """Return Markdown as a document of Rerun."""
    return rr.TextDocument(markdown, media_type=rr.MediaType.MARKDOWN)


def _chart(curves: Sequence[Curve]) -> Iterator[Aspect]:
    x, y = scales(curves)
    names = [(curve.name, PALETTE[curve.color]) for curve in curves]
    yield Aspect(
        chart_frame, {"x": x, "y": y, "x_label": curves[0].x_label, "names": names}, "/frame"
    )
    yield Aspect(chart_curves, {"x": x, "y": y, "curves": dict(enumerate(curves))}, "/curves")


def _picture(picture: Picture) -> Iterator[Aspect]:
    yield Aspect(encoded, {"image": picture.image}, IMAGE)
    if isinstance(picture.image, Field):
        h, w = picture.image.values.shape
        place = {"at": (0.0, h + 0.02 * w), "width": float(w), "height": 0.04 * w}
        yield Aspect(color_bar, bar_of(picture.image) | place, "/bar")


def _legend(entries: Legend, fields: Sequence[Field]) -> Iterator[Aspect]:
    if entries:
        yield Aspect(legend_names, {"entries": entries}, "/names")
    for i, field in enumerate(fields):
        yield Aspect(
            legend_bar,
            {"i": i, "bars": len(fields), "entries": entries, "bar": bar_of(field)},
            f"/bar{i}",
        )
