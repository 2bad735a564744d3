"""What somebody asks of a picture or a film, held to what can be made, before any work is done."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, get_args

from workbench.errors import InputError
from workbench.picture.film import frames_of
from workbench.picture.sheet import Style
from workbench.run.timeline import MOST_STEPS, Timeline

STILLS = (".png", ".svg", ".webp")
FILMS = (".webp", ".gif", ".mp4")
LEAST_WIDTH = 160
MOST_WIDTH = 3840
"""Pixels."""
MOST_SECONDS = 120.0
MOST_PIXELS = 400_000_000
"""Pixels of all pictures of a .gif or .webp together: they are in memory at once."""
SECONDS_A_STEP = 0.6
Captions = Literal["picture", "beside", "none"]
Slides = Literal["png", "svg"]


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A picture or a film, as it was asked for.

    Args:
        step: Of a picture; None for the one that a run opens at.
        first, last: Steps of a film; None for the start and for the end of the run itself.
        seconds: How long the film is; None for so many a step.
        style: How it looks.
        captions: Where captions are.
        slides: What files the slides of a story are; None for `.png`.
    """

    step: int | None = None
    first: int | None = None
    last: int | None = None
    seconds: float | None = None
    style: Style
    captions: Captions = "picture"
    slides: Slides | None = None

    @property
    def is_of_film(self) -> bool:
        """Whether something of it makes sense for a film alone."""
        return (self.first, self.last, self.seconds) != (None, None, None)


def is_film(out: Path, asked: Asked) -> bool:
    """Tell whether a film is to be written: `.gif` and `.mp4` are films, and `.webp` is one where
    `--from`, `--to` or `--seconds` are given.

    Raises:
        InputError: On a name or a wish that does not go with the others.
    """
    kind = out.suffix.lower()
    if kind not in (*STILLS, *FILMS):
        raise InputError(f"{out}: a picture is .png, .svg or .webp, a film is .webp, .gif or .mp4")
    _check_style(asked)
    if asked.slides is not None:
        raise InputError(f"--as {asked.slides}: is of --scenes; else the name of the file says it")
    film = kind in FILMS and (kind not in STILLS or asked.is_of_film)
    if film and asked.step is not None:
        raise InputError(f"{out}: a film has --from and --to; --step is of .png, .svg and .webp")
    if not film and asked.is_of_film:
        raise InputError(f"{out}: --from, --to and --seconds are of a film: .webp, .gif or .mp4")
    if not film and asked.captions == "beside":
        raise InputError("--captions beside: subtitles stand beside films; picture or none")
    if kind == ".mp4":
        check_encoder()
    _check_reach(out, asked)
    return film


def check_slides(asked: Asked) -> None:
    """Raise InputError on a wish that does not go with slides of a story."""
    _check_style(asked)
    if asked.slides not in (None, *get_args(Slides)):
        raise InputError(f"--as {asked.slides}: one of {', '.join(get_args(Slides))}")
    if asked.step is not None or asked.is_of_film:
        raise InputError("--scenes: a story says its steps; --step, --from, --to, --seconds do not")
    if asked.captions == "beside":
        raise InputError("--captions beside: subtitles stand beside films; picture or none")


def _check_reach(out: Path, asked: Asked) -> None:
    """Raise InputError where no run is long enough, or where the steps of a film that are named are
    too many, before there is a run.
    """
    named = {"--step": asked.step, "--from": asked.first, "--to": asked.last}
    for flag, step in named.items():
        if step is not None and not -MOST_STEPS <= step < MOST_STEPS:
            raise InputError(f"{flag} {step}: a run has {MOST_STEPS} steps at most")
    first = asked.first or 0
    last = asked.last
    if last is not None and (first < 0) == (last < 0):
        seconds = seconds_of(asked, abs(last - first) + 1)
        check_memory(out, len(frames_of(first, last, seconds)), asked.style)


def _check_style(asked: Asked) -> None:
    width = asked.style.width
    if not LEAST_WIDTH <= width <= MOST_WIDTH:
        raise InputError(f"--width {width}: a picture has {LEAST_WIDTH} to {MOST_WIDTH} pixels")
    if asked.captions not in get_args(Captions):
        known = ", ".join(get_args(Captions))
        raise InputError(f"--captions {asked.captions}: one of {known}")
    seconds = asked.seconds
    if seconds is not None and not 0.1 <= seconds <= MOST_SECONDS:
        raise InputError(f"--seconds {seconds:g}: a film has 0.1 to {MOST_SECONDS:g} seconds")


def check_encoder() -> None:
    """Raise InputError where no encoder of .mp4 is installed."""
    try:
        import av  # noqa: F401
    except ImportError as error:
        raise InputError(
            ".mp4 needs an encoder: pip install 'geometry-workbench[film]'; .webp and .gif need"
            " nothing more"
        ) from error


def index_of(timeline: Timeline, step: int, flag: str) -> int:
    """Return the index of a step of a complete run; negative counts from the end.

    Raises:
        InputError: If the run has no such step.
    """
    n = len(timeline)
    if not -n <= step < n:
        raise InputError(f"{flag} {step}: the run has {n} steps: 0 to {n - 1}, or -1 to -{n}")
    return step % n


def seconds_of(asked: Asked, steps: int) -> float:
    """Return how long a film of so many steps is."""
    if asked.seconds is not None:
        return asked.seconds
    return min(max(SECONDS_A_STEP * steps, 1.0), MOST_SECONDS)


def check_memory(out: Path, frames: int, style: Style) -> None:
    """Raise InputError where so many frames together would be too much, about."""
    pixels = frames * style.width**2
    if out.suffix.lower() != ".mp4" and pixels > MOST_PIXELS:
        raise InputError(
            f"{out}: {frames} pictures {style.width} pixels wide are too many for"
            f" {out.suffix.lower()}; take fewer steps or seconds, a smaller --width, or .mp4"
        )
