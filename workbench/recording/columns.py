"""Scalars and captions, one value per step, sent as whole columns: one message for all.

They go first into a file. A viewer then knows all steps at once, and opens at the first.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import rerun as rr

from workbench.recording.glyphs import safe
from workbench.recording.layout import plotted
from workbench.recording.sink import entity_of, markdown
from workbench.run.series import Series, plotted_values
from workbench.scene import PALETTE, Caption, Scalar

TONES = {"info": "", "good": "✓ ", "wrong": "✗ "}


def send_captions(stream: Any, captions: Sequence[Caption]) -> None:
    """Send the captions as a reader sees them, and as they were, for whoever reads the file."""
    shown = [f"### {TONES[caption.tone]}{markdown(caption.text)}" for caption in captions]
    kinds = [rr.MediaType.MARKDOWN] * len(captions)
    texts, tones = [caption.text for caption in captions], [caption.tone for caption in captions]
    stream.send_columns(
        "/caption", [_steps(len(captions))], rr.TextDocument.columns(text=shown, media_type=kinds)
    )
    stream.send_columns(
        "/caption", [_steps(len(captions))], rr.AnyValues.columns(caption=texts, tone=tones)
    )


def facts(**values: Any) -> rr.AnyValues:
    """Return named values for a recording; empty text is left out.

    Rerun leaves it out only until it has met the name with text: recordings would differ by it.
    """
    return rr.AnyValues(**{name: value for name, value in values.items() if value != ""})


def send_series(stream: Any, path: str, series: Series, *, order: int) -> None:
    """Send one scalar over all steps, how it is drawn, and its logarithm if that is drawn."""
    scalar = series.scalar
    values = series.values.astype(float)
    entity = entity_of("scalars", path)
    shown = plotted(path, scalar)
    stream.send_columns(entity, [_steps(len(values))], rr.Scalars.columns(scalars=values))
    about = facts(
        name=scalar.name,
        chart=scalar.chart,
        unit=scalar.unit,
        role=scalar.color,
        logarithmic=scalar.log,
        order=order,
    )
    stream.log(entity, about, static=True)
    if scalar.log:
        stream.send_columns(
            shown, [_steps(len(values))], rr.Scalars.columns(scalars=plotted_values(scalar, values))
        )
    stream.log(shown, curve_style(scalar, scalar.name), static=True)


def curve_style(scalar: Scalar, name: str, *, second: bool = False) -> Any:
    """Return how a curve is drawn; that of a second run is thinner and darker."""
    color = np.array(PALETTE[scalar.color]) * (0.6 if second else 1.0)
    return rr.SeriesLines(
        colors=[color.astype(np.uint8)], names=safe(name), widths=1.2 if second else 2.2
    )


def _steps(n: int) -> Any:
    return rr.TimeColumn("step", sequence=np.arange(n))
