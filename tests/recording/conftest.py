"""A recording to look at, made once."""

from pathlib import Path

import pytest

from tests import fake
from workbench.recording.write import record


@pytest.fixture(scope="session")
def fake_file(tmp_path_factory) -> Path:
    """A recording of the fake lesson's default run."""
    return record(fake.lesson, tmp_path_factory.mktemp("recordings") / "fake.rrd")
