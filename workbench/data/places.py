"""Places on the Earth: some cities, and lists that people bring."""

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from workbench.apart import apart
from workbench.data.files import text_rows
from workbench.data.files.formats import is_number
from workbench.errors import InputError

MOST_PLACES = 2000
KINDS = (".csv", ".txt", ".tsv")

CITIES: Mapping[str, tuple[float, float]] = {
    "London": (51.5074, -0.1278),
    "Los Angeles": (34.0522, -118.2437),
    "Frankfurt": (50.1109, 8.6821),
    "Anchorage": (61.2181, -149.9003),
    "Tokyo": (35.6762, 139.6503),
    "Suva": (-18.1248, 178.4501),
    "Apia": (-13.8333, -171.7667),
    "Quito": (-0.1807, -78.4678),
    "Kampala": (0.3476, 32.5825),
}


@dataclass(frozen=True, eq=False)
class Places:
    """Places by name: latitude and longitude, degrees, north and east positive."""

    names: tuple[str, ...]
    degrees: Float[np.ndarray, "n 2"]


def between_cities(route: str) -> Places:
    """Return both cities of a route such as "Tokyo – London"."""
    names = tuple(route.split(" – "))
    return Places(names, np.array([CITIES[name] for name in names]))


@apart
def read_places(path: Path) -> Places:
    """Return the places of a text file: per line latitude, longitude and maybe a name.

    Lines that begin with #, empty ones, and a first line of words are left out. Longitudes may run
    to 360.

    Raises:
        InputError: If the file is missing, of another kind, not understood, or has fewer than two
            places.
    """
    rows = text_rows(path, "places", KINDS)
    names = list[str]()
    degrees = list[tuple[float, float]]()
    for i, line in rows:
        cells = _cells(line)
        if (
            i == rows[0][0]
            and len(cells) > 1
            and not is_number(cells[0])
            and not is_number(cells[1])
        ):
            continue
        degrees.append(_place(cells, path.name, i))
        names.append(" ".join(cells[2:])[:40] or f"place {len(degrees)}")
    if not 2 <= len(degrees) <= MOST_PLACES:
        raise InputError(
            f"{path.name}: {len(degrees):,} places; 2 to {MOST_PLACES:,} are wanted, one on each"
            " line"
        )
    return Places(tuple(names), np.array(degrees))


def _cells(line: str) -> list[str]:
    mark = next((mark for mark in "\t;" if mark in line), ",")
    return [
        cell.strip() for cell in next(csv.reader([line], delimiter=mark, skipinitialspace=True))
    ]


def _place(cells: list[str], name: str, line: int) -> tuple[float, float]:
    if len(cells) < 2 or not (is_number(cells[0]) and is_number(cells[1])):
        raise InputError(
            f"{name}, line {line}: a latitude, a longitude and maybe a name are wanted"
        )
    latitude, longitude = float(cells[0]), float(cells[1])
    if not abs(latitude) <= 90:
        raise InputError(
            f"{name}, line {line}: latitude {cells[0][:12]} is beyond a pole; the latitude comes"
            " first"
        )
    if not -180 <= longitude <= 360:
        raise InputError(
            f"{name}, line {line}: longitude {cells[1][:12]} is not between −180 and 360"
        )
    return latitude, longitude - 360.0 * (longitude > 180)
