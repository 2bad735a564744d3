"""Enforces array shapes in every test, finds the real data where it is present, and one browser for all."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from beartype import BeartypeConf
from jaxtyping import install_import_hook

from tests.browser.chrome import HOW_TO, find_chromium, started

ROOT = Path(__file__).resolve().parents[1]


def checked(function_or_class):
    """Check annotations with beartype, a whole number being fine where a float is asked for."""
    from beartype import beartype

    return beartype(conf=BeartypeConf(is_pep484_tower=True))(function_or_class)


@pytest.hookimpl(tryfirst=True)  # before the groups are read
def pytest_collection_modifyitems(items):
    """Keep in one worker what shares a server, a site or a lesson's whole runs; the rest goes where there is time."""
    for item in items:
        name = shared_by(item)
        if name:
            item.add_marker(pytest.mark.xdist_group(name))


def shared_by(item) -> str:
    """Return what a test shares with others: its file in tests/browser, its lesson where that is run here, or nothing."""
    from workbench.lesson import Lesson, catalog

    if item.get_closest_marker("browser"):
        return item.path.stem
    if item.path.parent.name == "lessons":
        return next((name for name in catalog() if item.path.stem.startswith(f"test_{name}")), "")
    if item.path.stem not in ("test_lessons", "test_ordered_pairs", "test_spoilers"):
        return ""
    values = [getattr(value, "name", value) if isinstance(value, Lesson) else value for value in params_of(item)]
    return next((value for value in values if isinstance(value, str) and value in catalog()), "")


def params_of(item) -> list:
    """Return the values that a test is parametrized with."""
    return list(item.callspec.params.values()) if hasattr(item, "callspec") else []


install_import_hook(["workbench.geometry", "workbench.algorithms", "workbench.data"], "tests.conftest.checked")


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """The folder of real data beside the project."""
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("real data (../shared/data) is not beside the project")
    return folder


@pytest.fixture(scope="session")
def chromium() -> Iterator:
    """A running Chromium, one for all tests of a worker. A build server fails without it."""
    if find_chromium() is None:
        if os.environ.get("CI"):
            pytest.fail(HOW_TO)
        pytest.skip(HOW_TO)
    with started() as browser:
        yield browser
