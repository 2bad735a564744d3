"""The lens of a view for a picture that has all of some scenes in it."""

from collections.abc import Iterable, Sequence

import numpy as np

from workbench.rendering.lens import Lens
from workbench.rendering.shapes import Shape, Surface, corners_of, strong
from workbench.view import View

BEYOND = 0.5
"""How far beyond the view a thing may be that is brought into the picture, in pictures."""


def framed(scenes: Iterable[Sequence[Shape]], view: View, size: tuple[int, int]) -> Lens:
    """Return the lens of a view with all of some scenes in the picture.

    The grid does not count, nor does a faint thing that leaves the view, or what is far outside of
    it; of surfaces what is in the view does.

    Args:
        scenes: The shapes of what is to be seen, such as those of each step of a film.
        view: From where.
        size: Width and height of the picture, pixels.
    """
    lens = Lens.of(view, size)
    low = np.full(2, np.inf)
    high = np.full(2, -np.inf)
    for shapes in scenes:
        leading = strong(shapes)
        for shape in (shape for shape in shapes if shape.framed):
            uv, _ = lens.seen(corners_of(shape))
            room = np.array(size) * (0.0 if isinstance(shape, Surface) else BEYOND)
            near = uv[np.all((uv >= -room) & (uv <= size + room), axis=1)]
            if shape not in leading and not np.all((uv >= 0) & (uv <= size)):
                continue
            low = np.minimum(low, near.min(0, initial=np.inf))
            high = np.maximum(high, near.max(0, initial=-np.inf))
    return lens.around(low, high) if np.isfinite(low).all() else lens
