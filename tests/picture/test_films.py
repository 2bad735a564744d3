"""Films: how long what is seen, what glides, equal bytes on two runs, and subtitles beside."""

import errno
import io
import os
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from tests import fake
from workbench.cli import main
from workbench.errors import InputError
from workbench.machinery.atomic import write_places
from workbench.picture.film import RATE, Frame, between, film_bytes, frames_of, subtitles
from workbench.scene import Points, Scalar

FAKE = str(Path(fake.__file__))
P = np.zeros((1, 3))


@given(first=st.integers(0, 60), last=st.integers(0, 60), seconds=st.floats(0.1, 30))
def test_a_film_is_as_long_as_asked_and_has_its_ends(first, last, seconds):
    frames = frames_of(first, last, seconds)
    assert sum(frame.ticks for frame in frames) == max(1, round(RATE * seconds))
    assert all(frame.ticks > 0 for frame in frames)
    assert frames[-1].step == last or len(frames) == 1
    assert frames[0].step == first
    way = [frame.step for frame in frames]
    assert way == sorted(way, reverse=first > last)


def test_every_step_is_seen_where_there_is_time():
    frames = frames_of(2, 9, 4.0)
    assert sorted({frame.step for frame in frames}) == list(range(2, 10))
    rest = [frame.ticks for frame in frames if frame.share == 1.0]
    assert len(rest) == 8
    shares = [frame.share for frame in frames if frame.step == 5]
    assert shares == sorted(shares)


def turned(angle: float, x: float) -> np.ndarray:
    T = np.eye(4)
    T[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    T[0, 3] = x
    return T


def test_what_only_moves_glides_and_all_else_changes_at_the_step():
    before = {"a": Points(P, T_world_object=turned(0.0, 0.0)), "b": Scalar(1.0, "b", "b")}
    after = {"a": Points(P, T_world_object=turned(1.0, 2.0)), "b": Scalar(2.0, "b", "b")}
    half = between(before, after, 0.5)
    moved = half["a"]
    assert isinstance(moved, Points)
    assert moved.T_world_object == pytest.approx(turned(0.5, 1.0))
    assert half["b"] is after["b"]
    assert between(before, after, 1.0) == after
    other = {"a": Points(P, "truth", T_world_object=turned(1.0, 2.0))}
    assert between(before, other, 0.5) == other
    stretched = {"a": Points(P, T_world_object=np.diag([2.0, 1, 1, 1]))}
    assert between(before, stretched, 0.5) == stretched
    assert between({}, after, 0.5) == after


def frames() -> list[tuple[Frame, Image.Image]]:
    rng = np.random.default_rng(0)
    noise = [rng.integers(0, 255, (31, 41, 3), np.uint8) for _ in range(3)]
    return [
        (Frame(before=i, step=i, ticks=4 + i), Image.fromarray(pixels))
        for i, pixels in enumerate(noise)
    ]


@pytest.mark.parametrize("kind", [".gif", ".webp"])
def test_a_loop_has_its_frames_and_times_and_equal_bytes_twice(kind):
    data = film_bytes(frames(), kind)
    assert data == film_bytes(frames(), kind)
    film = Image.open(io.BytesIO(data))
    assert film.n_frames == 3  # type: ignore[attr-defined]
    times = []
    for i in range(3):
        film.seek(i)
        film.load()
        times.append(film.info["duration"])
    assert times == [200, 250, 300]
    assert film.info["loop"] == 0


def test_an_mp4_has_equal_frames_twice_and_is_as_long_as_asked():
    av = pytest.importorskip("av")
    seen = []
    for _ in range(2):
        with av.open(io.BytesIO(film_bytes(frames(), ".mp4"))) as film:
            seen.append([frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)])
    assert len(seen[0]) == 15
    assert seen[0][0].shape == (30, 40, 3)
    assert all(np.array_equal(a, b) for a, b in zip(*seen, strict=True))


def test_an_mp4_begins_with_what_a_player_needs_first():
    pytest.importorskip("av")
    data = film_bytes(frames(), ".mp4")
    assert 0 < data.index(b"moov") < data.index(b"mdat")


def test_without_an_encoder_an_mp4_is_one_line(monkeypatch, tmp_path, capsys):
    monkeypatch.setitem(sys.modules, "av", None)
    assert main(["picture", FAKE, "-o", str(tmp_path / "x.mp4")]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "geometry-workbench[film]" in err
    assert list(tmp_path.iterdir()) == []


def test_subtitles_are_a_cue_for_each_caption():
    shown = [
        Frame(before=0, step=0, ticks=30),
        Frame(before=0, step=1, share=0.5),
        Frame(before=1, step=1, ticks=9),
        Frame(before=1, step=2, ticks=10),
    ]
    told = subtitles(shown, ["a < b", "two", "two"])
    assert told.startswith("WEBVTT\n\n")
    assert re.findall(r"(\S+) --> (\S+)\n(.*)", told) == [
        ("00:00:00.000", "00:00:01.500", "a &lt; b"),
        ("00:00:01.500", "00:00:02.500", "two"),
    ]


def test_a_film_from_the_command_line_with_subtitles_beside_it(tmp_path, capsys):
    out = tmp_path / "x.gif"
    words = ["picture", FAKE, "--to", "2", "--seconds", "1.5", "--width", "200", "-o", str(out)]
    assert main([*words, "--captions", "beside"]) == 0
    first = out.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["x.gif", "x.vtt"]
    assert (tmp_path / "x.vtt").read_text(encoding="utf-8").count("-->") == 3
    assert "x.vtt" in capsys.readouterr().out
    assert main([*words, "--captions", "beside", "--force"]) == 0
    assert out.read_bytes() == first
    out.unlink()
    assert main([*words, "--captions", "beside"]) == 2
    assert "x.vtt: exists already" in capsys.readouterr().err
    assert not out.exists()


def _fails_at(monkeypatch, name: str, suffix: str) -> None:
    """Let a call on a file fail as on a full disk, where its last argument ends so."""
    original = getattr(os, name)

    def fails(*arguments):
        if str(arguments[-1]).endswith(suffix):
            raise OSError(errno.ENOSPC, "No space left on device")
        return original(*arguments)

    monkeypatch.setattr(f"workbench.machinery.atomic.os.{name}", fails)


@pytest.mark.parametrize("before", [{}, {"x.gif": b"mine", "x.vtt": b"mine too"}])
def test_a_film_and_its_subtitles_are_written_both_or_not_at_all(
    before, *, tmp_path, monkeypatch, capsys
):
    for name, data in before.items():
        (tmp_path / name).write_bytes(data)
    out = tmp_path / "x.gif"
    words = ["picture", FAKE, "--to", "1", "--width", "200", "-o", str(out), "--force"]
    _fails_at(monkeypatch, "replace", "x.vtt")
    assert main([*words, "--captions", "beside"]) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1
    assert "x.vtt: cannot be written: No space left" in err
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_what_was_there_is_kept_by_a_copy_where_a_disk_has_no_links(tmp_path, monkeypatch):
    files = {tmp_path / name: name.encode() for name in ("a", "b")}
    write_places(files)
    _fails_at(monkeypatch, "link", "")
    write_places(dict.fromkeys(files, b"new"))
    assert {path.read_bytes() for path in tmp_path.iterdir()} == {b"new"}
    _fails_at(monkeypatch, "replace", "b")
    with pytest.raises(InputError, match=r"b: cannot be written"):
        write_places(dict.fromkeys(files, b"newer"))
    assert {path.read_bytes() for path in tmp_path.iterdir()} == {b"new"}
    assert len(list(tmp_path.iterdir())) == 2


def test_all_frames_of_a_film_are_of_one_size(tmp_path):
    out = tmp_path / "x.webp"
    assert main(["picture", FAKE, "--seconds", "1", "--width", "200", "-o", str(out)]) == 0
    with Image.open(out) as film:
        assert film.width == 200
        assert film.n_frames > 1  # type: ignore[attr-defined]
