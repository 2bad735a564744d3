"""What a run shows beside its scene: enough to lay out the views before anything is drawn."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import takewhile
from typing import Any

from workbench.errors import InputError
from workbench.lesson import View
from workbench.recording.chart import HEIGHT, WIDTH, Canvas, legend_height
from workbench.recording.sink import TABLES, chart_entity, entity_of, legend_of
from workbench.scene import Curve, Field, Picture, Scalar, Scene, Table, in_space


@dataclass
class Contents:
    """What stands beside the scene, in order of appearance.

    Attributes:
        scalars: By the title of their plot, then by path; how each is drawn.
        canvases: Charts of Curves, pictures, and the document of tables, by entity.
        legend_height: The greatest height of the legend on its canvas.
    """

    scalars: dict[str, dict[str, Scalar]] = field(default_factory=dict)
    canvases: dict[str, Canvas] = field(default_factory=dict)
    legend_height: float = 0.0


def contents_of(scenes: Sequence[Scene]) -> Contents:
    """Return what all scenes of a run show."""
    contents = Contents()
    for k, scene in enumerate(scenes):
        for path, primitive in scene.items():
            if isinstance(primitive, Scalar):
                contents.scalars.setdefault(primitive.chart, {}).setdefault(path, primitive)
            elif isinstance(primitive, Curve):
                canvas = Canvas(_chart_title(primitive), WIDTH, HEIGHT, k)
                contents.canvases.setdefault(chart_entity(primitive.chart), canvas)
            elif isinstance(primitive, Picture) and not in_space(primitive):
                entity = entity_of("pictures", path)
                known = contents.canvases.setdefault(entity, _picture_canvas(path, primitive, k))
                title = _common(known.title, primitive.title or path, path)
                contents.canvases[entity] = replace(known, title=title)
            elif isinstance(primitive, Table):
                contents.canvases.setdefault(TABLES, Canvas("Numbers", 0.0, 0.0, k))
        entries, fields = legend_of(scene)
        contents.legend_height = max(contents.legend_height, legend_height(entries, len(fields)))
    return contents


def to_json(contents: Contents, view: View) -> str:
    """Return everything but the scalars, and how the scene is first seen."""
    canvases = {entity: asdict(canvas) for entity, canvas in contents.canvases.items()}
    return json.dumps(
        {"canvases": canvases, "legend_height": contents.legend_height, "view": asdict(view)}
    )


def from_json(text: str, curves: Mapping[str, Scalar]) -> tuple[Contents, View]:
    """Return contents and view from `to_json`'s text and the scalars by path.

    Raises:
        InputError: If the text is not what `to_json` wrote.
    """
    try:
        plain = json.loads(text)
        canvases = _canvases_of_format_1(plain) if "canvases" not in plain else plain["canvases"]
        contents = Contents(legend_height=float(plain["legend_height"]))
        contents.canvases = {entity: _canvas(**canvas) for entity, canvas in canvases.items()}
        looks: dict[str, Any] = {
            name: tuple(map(float, value)) if isinstance(value, list) else value
            for name, value in plain["view"].items()
        }
        view = View(**looks)
    except Exception:  # text out of a file may be anything
        raise InputError("what it shows beside the scene is not understood") from None
    for path, scalar in curves.items():
        contents.scalars.setdefault(scalar.chart, {})[path] = scalar
    return contents, view


def _canvases_of_format_1(plain: Mapping[str, Any]) -> dict[str, Any]:
    tables = {"title": "Numbers", "width": 0.0, "height": 0.0, "first": plain["tables"]}
    return (
        {chart_entity(title): canvas for title, canvas in plain["charts"].items()}
        | {entity_of("pictures", path): canvas for path, canvas in plain["pictures"].items()}
        | ({} if plain["tables"] is None else {TABLES: tables})
    )


def _canvas(title: str, width: float, height: float, *, first: int) -> Canvas:
    return Canvas(str(title), float(width), float(height), int(first))


def both(a: Contents, b: Contents) -> Contents:
    """Return what either of two runs shows."""
    scalars = {
        chart: a.scalars.get(chart, {}) | b.scalars.get(chart, {})
        for chart in {**a.scalars, **b.scalars}
    }
    return Contents(scalars, b.canvases | a.canvases, max(a.legend_height, b.legend_height))


def _chart_title(curve: Curve) -> str:
    return (
        curve.chart
        if not curve.y_label or curve.y_label in curve.chart
        else f"{curve.chart} · {curve.y_label}"
    )


def _common(title: str, other: str, path: str) -> str:
    """Return one title for both: their common beginning, or the path where they have none."""
    if title == other:
        return title
    pairs = takewhile(
        lambda pair: pair[0] == pair[1], zip(title.removesuffix(" …"), other, strict=False)
    )
    start = "".join(letter for letter, _ in pairs).rstrip()
    return f"{start} …" if len(start) > 3 else path


def _picture_canvas(path: str, picture: Picture, first: int) -> Canvas:
    h, w = (picture.image.values if isinstance(picture.image, Field) else picture.image).shape[:2]
    # a colour bar takes its room below
    height = h + 0.17 * w if isinstance(picture.image, Field) else float(h)
    return Canvas(picture.title or path, float(w), height, first)
