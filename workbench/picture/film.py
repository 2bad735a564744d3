"""Films: the steps of a run as frames, between which what only moves glides, as on a page."""

import io
import math
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from scipy.spatial.transform import Rotation

from workbench.scene import Primitive, Scene, in_space, is_rigid, same_but_for_pose

RATE = 20
"""Frames a second."""
GLIDE = 0.4
"""Seconds in which a thing that only moves gets to its new place, at most; never more than
MOST_GLIDE of a step.
"""
MOST_GLIDE = 0.6
COLORS = 200
SAMPLES = 12
"""Frames that the colours of a .gif are chosen from."""


@dataclass(frozen=True, kw_only=True)
class Frame:
    """A picture of a film.

    Args:
        before, step: The steps between which it is.
        share: How far it is from one to the other, 0 to 1.
        ticks: How long it is seen, in RATE-ths of a second.
    """

    before: int
    step: int
    share: float = 1.0
    ticks: int = 1


def frames_of(first: int, last: int, seconds: float) -> list[Frame]:
    """Return the frames of a film of the steps from first to last, either way, in order.

    Each step takes equally long; where there are more steps than moments, evenly spaced ones are
    seen. What stands still is one frame.
    """
    total = max(1, round(RATE * seconds))
    steps = list(range(first, last + 1) if first <= last else range(first, last - 1, -1))
    if len(steps) > total:
        chosen = np.linspace(0, len(steps) - 1, total).round().astype(int)
        steps = [steps[i] for i in chosen.tolist()]
    ends = [round(total * (i + 1) / len(steps)) for i in range(len(steps))]
    frames = []
    begin = 0
    for i, (step, end) in enumerate(zip(steps, ends, strict=True)):
        room = end - begin
        moves = min(round(RATE * GLIDE), math.floor(MOST_GLIDE * room)) if i else 0
        shares = [(j + 1) / (moves + 1) for j in range(moves)]
        frames += [Frame(before=steps[i - 1], step=step, share=eased(share)) for share in shares]
        frames.append(Frame(before=step, step=step, ticks=room - moves))
        begin = end
    return frames


def eased(share: float) -> float:
    """Return a share of a way that begins and ends slowly."""
    return share * share * (3.0 - 2.0 * share)


def between(before: Scene, after: Scene, share: float) -> Scene:
    """Return the scene on the way from one step to the next: what only moves rigidly is on its
    way, all else is as in the next.
    """
    return {path: _between(before.get(path), primitive, share) for path, primitive in after.items()}


def _between(old: Primitive | None, new: Primitive, share: float) -> Primitive:
    if old is None or share >= 1 or type(old) is not type(new) or not in_space(new):
        return new
    if not same_but_for_pose(old, new):
        return new
    start = _pose(old)
    end = _pose(new)
    if not (is_rigid(start) and is_rigid(end)):
        return new
    turn = Rotation.from_matrix(start[:3, :3].T @ end[:3, :3]).as_rotvec()
    T = np.eye(4)
    T[:3, :3] = start[:3, :3] @ Rotation.from_rotvec(share * turn).as_matrix()
    T[:3, 3] = (1 - share) * start[:3, 3] + share * end[:3, 3]
    return replace(new, T_world_object=T)  # type: ignore[type-var, call-arg]


def _pose(primitive: Any) -> np.ndarray:
    T = primitive.T_world_object
    return np.eye(4) if T is None else T


Shown = tuple[Frame, Image.Image]


def film_bytes(shown: Iterable[Shown], kind: str) -> bytes:
    """Return frames as a film.

    Args:
        shown: Frames with their pictures, all of one size.
        kind: `.webp`, `.gif` or `.mp4`.
    """
    if kind == ".mp4":
        return _mp4(shown)
    pairs = list(shown)
    pictures = [image for _, image in pairs]
    times = [1000 * frame.ticks // RATE for frame, _ in pairs]
    file = io.BytesIO()
    if kind == ".gif":
        palette = _palette(pictures)
        dither = Image.Dither.NONE
        pictures = [image.quantize(palette=palette, dither=dither) for image in pictures]
        more: dict[str, Any] = {"format": "GIF", "optimize": False, "disposal": 1}
    else:
        more = {"format": "WEBP", "quality": 80, "method": 4}
    pictures[0].save(
        file, save_all=True, append_images=pictures[1:], duration=times, loop=0, **more
    )
    return file.getvalue()


def _palette(pictures: Sequence[Image.Image]) -> Image.Image:
    """Return one palette for all pictures, of some of them side by side."""
    chosen = pictures[:: max(1, len(pictures) // SAMPLES)]
    small = [
        picture.resize((max(1, picture.width // 2), max(1, picture.height // 2)), 0)
        for picture in chosen
    ]
    sheet = Image.new("RGB", (small[0].width, sum(picture.height for picture in small)))
    top = 0
    for picture in small:
        sheet.paste(picture, (0, top))
        top += picture.height
    palette = sheet.quantize(COLORS, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    colors = np.array(palette.getpalette()).reshape(-1, 3)
    ground = np.array(sheet.getpixel((0, 0)))
    colors[np.abs(colors - ground).sum(1).argmin()] = ground  # the largest plain part, exactly
    palette.putpalette(colors.ravel().tolist())
    return palette


def _mp4(shown: Iterable[Shown]) -> bytes:
    """Return frames as H.264, encoded by one thread: equal frames each time. What a player needs
    first is in front, so that a film from a server begins before all of it is there.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "film.mp4"  # its front is moved there by reading it a second time
        _encode(shown, file)
        return file.read_bytes()


def _encode(shown: Iterable[Shown], file: Path) -> None:
    import av

    with av.open(str(file), "w", format="mp4", options={"movflags": "faststart"}) as film:
        stream: Any = None
        at = 0
        for frame, image in shown:
            size = image.width // 2 * 2, image.height // 2 * 2
            if stream is None:
                stream = film.add_stream("libx264", rate=RATE, options={"crf": "18"})
                stream.width, stream.height = size
                stream.pix_fmt = "yuv420p"
                stream.thread_count = 1
                stream.time_base = Fraction(1, RATE)
            picture = av.VideoFrame.from_image(image.crop((0, 0, *size)))
            for _ in range(frame.ticks):
                picture.pts = at
                at += 1
                film.mux(stream.encode(picture))
        film.mux(stream.encode())


def subtitles(frames: Sequence[Frame], captions: Sequence[str]) -> str:
    """Return the captions of a film as WebVTT.

    Args:
        frames: Its frames, in order.
        captions: Those of all steps of the run.
    """
    cues: list[list[Any]] = []
    at = 0
    for frame in frames:
        text = captions[frame.step]
        if not cues or cues[-1][2] != text:
            cues.append([at, at, text])
        at += frame.ticks
        cues[-1][1] = at
    parts = [f"{_clock(a)} --> {_clock(b)}\n{_plain(text)}\n" for a, b, text in cues if text]
    return "\n".join(["WEBVTT\n", *parts])


def _clock(tick: int) -> str:
    minutes, rest = divmod(1000 * tick // RATE, 60_000)
    hours, minutes = divmod(minutes, 60)
    return f"{hours:02d}:{minutes:02d}:{rest // 1000:02d}.{rest % 1000:03d}"


def _plain(text: str) -> str:
    words = " ".join(text.split())
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def beside(out: Path) -> Path:
    """Return the file of the subtitles of a film."""
    return out.with_suffix(".vtt")
