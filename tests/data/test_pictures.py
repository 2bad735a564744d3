"""Pictures of views: found by name or in order, upright, shrunk, and refused in one line."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from workbench.data.pictures import matched, names_in, pictures_of
from workbench.errors import InputError


def picture(
    path: Path, level: int = 0, size: tuple[int, int] = (40, 30), *, turned: int = 1
) -> None:
    exif = Image.Exif()
    exif[0x0112] = turned
    Image.new("L", size, level).save(path, exif=exif)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    home = tmp_path / "home"
    home.mkdir()
    for k, name in enumerate(("v2.jpg", "v10.png", "v1.JPG")):
        picture(home / name, 40 * k)
    (home / "notes.txt").write_text("no picture")
    (home / ".v3.jpg").write_text("hidden")
    return home


def test_numbers_in_names_are_counted(folder):
    assert names_in(folder) == ("v1.JPG", "v2.jpg", "v10.png")


def test_by_name_or_in_order(folder):
    assert matched(folder, ("V10", "v1.jpg", "v7"), 3) == ("v10.png", "v1.JPG", None)
    assert matched(folder, ("0", "1", "2"), 3) == ("v1.JPG", "v2.jpg", "v10.png")
    assert matched(folder, (), 3) == ("v1.JPG", "v2.jpg", "v10.png")
    with pytest.raises(InputError, match=r"home: 3 pictures for 2 views$"):
        matched(folder, (), 2)
    with pytest.raises(InputError, match="home: 3 pictures for 2 views, and none is called left01"):
        matched(folder, ("left01", "left02"), 2)


def test_a_folder_and_its_zip_hold_the_same(folder):
    packed = Path(shutil.make_archive(str(folder), "zip", folder.parent, "home"))
    assert [Path(name).name for name in names_in(packed)] == list(names_in(folder))
    for view in range(3):
        first, second = (
            pictures_of(path, matched(path, (), 3)).shown(view, 100) for path in (folder, packed)
        )
        assert first is not None
        assert second is not None
        np.testing.assert_array_equal(first, second)
        assert first.shape == (30, 40)


def test_a_picture_is_upright_and_as_large_as_is_shown(tmp_path):
    picture(tmp_path / "a.jpg", size=(400, 300), turned=6)
    pictures = pictures_of(tmp_path / "a.jpg", (None, "a.jpg"))
    assert pictures.size == (300, 400)
    assert pictures.shown(0, 100) is None
    for most, shape in ((100, (100, 75)), (1000, (400, 300))):
        shown = pictures.shown(1, most)
        assert shown is not None
        assert shown.shape == shape


def test_it_is_decoded_once_and_again_when_it_changed(folder):
    pictures = pictures_of(folder, names_in(folder))
    first = pictures.shown(1, 100)
    assert pictures.shown(1, 100) is first
    picture(folder / "v2.jpg", 250, (40, 31))
    again = pictures.shown(1, 100)
    assert again is not None
    assert again.min() > 240


def test_what_is_refused(folder):
    picture(folder / "v3.png", size=(41, 30))
    with pytest.raises(InputError, match=r"v3.png has 41 x 30 pixels, v1.JPG 40 x 30"):
        pictures_of(folder, names_in(folder))
    (folder / "v3.png").write_text("no picture")
    with pytest.raises(InputError, match=r"v3.png: not readable as an image"):
        pictures_of(folder, names_in(folder))
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (30, 40), np.uint8)).save(
        folder / "v3.png"
    )
    # its size can be read, its pixels cannot
    (folder / "v3.png").write_bytes((folder / "v3.png").read_bytes()[:600])
    pictures = pictures_of(folder, names_in(folder))
    with pytest.raises(InputError, match=r"v3.png: not readable as an image"):
        pictures.shown(2, 100)
    (folder / "v3.png").unlink()
    shutil.copy(folder / "v2.jpg", folder / "v2.png")
    with pytest.raises(InputError, match="two pictures are called v2"):
        names_in(folder)
    with pytest.raises(InputError, match="no such file"):
        pictures_of(folder / "a.jpg", ("a.jpg",))
