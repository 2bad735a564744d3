"""What a run shows beside its scene: enough to lay out the views before anything is drawn, and kept in the recording."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import takewhile
from typing import Any

from workbench.errors import InputError
from workbench.lesson import View
from workbench.recording.chart import HEIGHT, WIDTH, legend_height
from workbench.recording.sink import Place, chart_entity, entity_of, legend_of
from workbench.scene import Curve, Field, Picture, Scalar, Scene, Table, in_space


@dataclass(frozen=True)
class Canvas:
    """A view in two dimensions: its title, its size, and the step at which something appears on it."""

    title: str
    width: float
    height: float
    first: int


@dataclass
class Contents:
    """What stands beside the scene, in order of appearance.

    Attributes:
        scalars: By the title of their plot, then by path; how each is drawn.
        charts: Charts of Curves, by title.
        pictures: By path.
        tables: At which step the first table appears, None where there is none.
        legend_height: The greatest height of the legend on its canvas.
    """

    scalars: dict[str, dict[str, Scalar]] = field(default_factory=dict)
    charts: dict[str, Canvas] = field(default_factory=dict)
    pictures: dict[str, Canvas] = field(default_factory=dict)
    tables: int | None = None
    legend_height: float = 0.0


def contents_of(scenes: Sequence[Scene]) -> Contents:
    """Return what all scenes of a run show."""
    found = Contents()
    for k, scene in enumerate(scenes):
        for path, primitive in scene.items():
            if isinstance(primitive, Scalar):
                found.scalars.setdefault(primitive.chart, {}).setdefault(path, primitive)
            elif isinstance(primitive, Curve):
                found.charts.setdefault(primitive.chart, Canvas(_chart_title(primitive), WIDTH, HEIGHT, k))
            elif isinstance(primitive, Picture) and not in_space(primitive):
                known = found.pictures.setdefault(path, _picture_canvas(path, primitive, k))
                found.pictures[path] = replace(known, title=_common(known.title, primitive.title or path, path))
            elif isinstance(primitive, Table) and found.tables is None:
                found.tables = k
        entries, fields = legend_of(scene)
        found.legend_height = max(found.legend_height, legend_height(entries, len(fields)))
    return found


def canvases(contents: Contents) -> dict[str, Canvas]:
    """Return all charts and pictures by their entities."""
    charts = {chart_entity(title): canvas for title, canvas in contents.charts.items()}
    return charts | {entity_of("pictures", path): canvas for path, canvas in contents.pictures.items()}


def places(contents: Contents) -> dict[str, Place]:
    """Return where charts, pictures and tables are shown, by entity: enough to say so while there are none."""
    tables = {} if contents.tables is None else {"/tables": Place(contents.tables)}
    return tables | {
        entity: Place(canvas.first, (canvas.width / 2, canvas.height / 2))
        for entity, canvas in canvases(contents).items()
    }


def to_json(contents: Contents, view: View) -> str:
    """Return everything but the scalars, which stand in a recording themselves, and how the scene is first seen."""
    plain = {name: value for name, value in asdict(contents).items() if name != "scalars"}
    return json.dumps(plain | {"view": asdict(view)})


def from_json(text: str, curves: Mapping[str, Scalar]) -> tuple[Contents, View]:
    """Return contents and view from `to_json`'s text and the scalars by path.

    Raises:
        InputError: If the text is not what `to_json` wrote.
    """
    try:
        return _from_json(json.loads(text), curves)
    except Exception:  # text out of a file may be anything
        raise InputError("what it shows beside the scene is not understood") from None


def _from_json(plain: Mapping[str, Any], curves: Mapping[str, Scalar]) -> tuple[Contents, View]:
    tables = None if plain["tables"] is None else int(plain["tables"])
    found = Contents(tables=tables, legend_height=float(plain["legend_height"]))
    found.charts = {title: _canvas(**canvas) for title, canvas in plain["charts"].items()}
    found.pictures = {path: _canvas(**canvas) for path, canvas in plain["pictures"].items()}
    for path, scalar in curves.items():
        found.scalars.setdefault(scalar.chart, {})[path] = scalar
    view: dict[str, Any] = {
        name: tuple(map(float, value)) if isinstance(value, list) else value for name, value in plain["view"].items()
    }
    return found, View(**view)


def _canvas(title: str, width: float, height: float, first: int) -> Canvas:
    return Canvas(str(title), float(width), float(height), int(first))


def both(a: Contents, b: Contents) -> Contents:
    """Return what either of two runs shows."""
    return Contents(
        scalars={chart: a.scalars.get(chart, {}) | b.scalars.get(chart, {}) for chart in {**a.scalars, **b.scalars}},
        charts=b.charts | a.charts,
        pictures=b.pictures | a.pictures,
        tables=a.tables if a.tables is not None else b.tables,
        legend_height=max(a.legend_height, b.legend_height),
    )


def _chart_title(curve: Curve) -> str:
    return curve.chart if not curve.y_label or curve.y_label in curve.chart else f"{curve.chart} · {curve.y_label}"


def _common(title: str, other: str, path: str) -> str:
    """Return one title for both: their common beginning where they differ, or the path where they have none."""
    if title == other:
        return title
    pairs = takewhile(lambda pair: pair[0] == pair[1], zip(title.removesuffix(" …"), other, strict=False))
    start = "".join(letter for letter, _ in pairs).rstrip()
    return f"{start} …" if len(start) > 3 else path


def _picture_canvas(path: str, picture: Picture, first: int) -> Canvas:
    h, w = (picture.image.values if isinstance(picture.image, Field) else picture.image).shape[:2]
    height = h + 0.17 * w if isinstance(picture.image, Field) else float(h)  # a colour bar takes its room below
    return Canvas(picture.title or path, float(w), height, first)
