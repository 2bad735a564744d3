"""Lists of places: what is read, and what is refused in one line."""

import numpy as np
import pytest

from workbench.data.places import CITIES, between_cities, read_places
from workbench.errors import InputError


@pytest.mark.parametrize(
    "text",
    [
        "lat,lon,name\n51.5,-0.1,London\n-18.1,178.4,Suva\n",
        "# towns\n\n51.5; -0.1; London\n-18.1; 178.4; Suva\n",
        "\ufeff51.5\t-0.1\tLondon\r\n-18.1\t178.4\tSuva",
    ],
)
def test_a_list_is_read(tmp_path, text):
    path = tmp_path / "towns.csv"
    path.write_text(text, encoding="utf-8")
    places = read_places(path)
    assert places.names == ("London", "Suva")
    np.testing.assert_allclose(places.degrees, [[51.5, -0.1], [-18.1, 178.4]])


def test_longitudes_to_360_and_places_without_names(tmp_path):
    path = tmp_path / "towns.txt"
    path.write_text('0,350\n"1","10"\n')
    places = read_places(path)
    np.testing.assert_allclose(places.degrees, [[0, -10], [1, 10]])
    assert places.names == ("place 1", "place 2")


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "0 places"),
        (b"lat,lon\n", "0 places"),
        (b"51,0\n", "1 places"),
        (b"120,30\n10,20\n", "line 1: latitude 120 is beyond a pole"),
        (b"10,20\n30,-181\n", "line 2: longitude"),
        (b"10,20\nhello\n", "line 2: a latitude"),
        (b"10,20\nnan,3\n", "line 2: latitude nan"),
        (b"10,20\n3,inf\n", "line 2: longitude inf"),
        (b"10,20\n\xff\xfe\n", "not a text file"),
    ],
)
def test_what_cannot_be_used_is_refused(tmp_path, content, words):
    path = tmp_path / "towns.csv"
    path.write_bytes(content)
    with pytest.raises(InputError, match=words):
        read_places(path)


def test_other_files_are_refused(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        read_places(tmp_path / "none.csv")
    path = tmp_path / "towns.ply"
    path.write_text("0,1\n2,3\n")
    with pytest.raises(InputError, match="text files"):
        read_places(path)
    many = tmp_path / "many.csv"
    many.write_text("1,2\n" * 2001)
    with pytest.raises(InputError, match="2,001 places"):
        read_places(many)


def test_cities_are_on_the_map():
    assert all(abs(lat) < 90 and abs(lon) <= 180 for lat, lon in CITIES.values())
    assert between_cities("Tokyo – London").names == ("Tokyo", "London")
