"""Recordings to look at, made once."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests import fake
from tests.browser.chrome import HOW_TO, find_chromium, started
from workbench.recording.write import record


@pytest.fixture(scope="session")
def fake_file(tmp_path_factory) -> Path:
    """A recording of the fake lesson's default run."""
    return record(fake.lesson, tmp_path_factory.mktemp("recordings") / "fake.rrd")


@pytest.fixture(scope="session")
def chromium() -> Iterator:
    """A running Chromium; on a build server a missing one is a failure, not a skip."""
    if find_chromium() is None:
        if os.environ.get("CI"):
            pytest.fail(HOW_TO)
        pytest.skip(HOW_TO)
    with started() as browser:
        yield browser
