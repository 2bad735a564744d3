"""A lesson with one short run, and its site, made once and copied by whoever changes it."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from tests import fake
from workbench.publish import site

TINY = replace(
    fake.lesson,
    run=lambda params: fake.run(fake.Params(steps=2, points=5)),
    presets=(),
    questions=(),
)


@pytest.fixture(scope="session")
def tiny_site(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("tiny") / "site"
    site.publish(out, [TINY])
    return out


@pytest.fixture
def out(tiny_site, tmp_path) -> Path:
    """A copy of the tiny site that a test may change."""
    return Path(shutil.copytree(tiny_site, tmp_path / "site", symlinks=True))


@pytest.fixture
def rendered(monkeypatch) -> list[str]:
    """The names of the runs that are rendered from here on, as `lesson/run`."""
    from workbench.publish import runs

    names: list[str] = []
    original = runs.render
    monkeypatch.setattr(
        runs,
        "render",
        lambda *args: names.append(f"{args[0].name}/{args[1].name}") or original(*args),
    )
    return names
