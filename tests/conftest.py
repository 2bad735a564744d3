"""Enforces array shapes in every test, finds the real data where it is present, and one browser for
all.
"""

import dataclasses
import functools
import gc
import inspect
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from workbench.machinery.threads import ONE_EACH

os.environ |= ONE_EACH  # before numpy is imported; workers inherit it

import jaxtyping
import pytest
from beartype import BeartypeConf
from hypothesis import HealthCheck, settings

from tests.browser.chrome import HOW_TO, find_chromium, started

ROOT = Path(__file__).resolve().parents[1]

# no example has a deadline: a machine may be busy, and a first call imports and compiles
settings.register_profile("patient", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("patient")


def checked(function_or_class):
    """Check annotations with beartype, a whole number being fine where a float is asked for."""
    from beartype import beartype

    return beartype(conf=BeartypeConf(is_pep484_tower=True))(function_or_class)


ENOUGH = 20
"""Calls of a function, or of a class, in one test whose shapes are checked; a run makes some
thousands, all alike.
"""
tests_begun = 0


def checked_at_first(
    decorate: Callable[..., Callable[[Any], Any]],
) -> Callable[..., Callable[[Any], Any]]:
    """Return jaxtyping's decorator, but so that only the first calls of a function in each test are
    checked, and the first values that are made of a class.
    """

    def decorator(**options: Any) -> Callable[[Any], Any]:
        def decorated(bare: Any) -> Any:
            if dataclasses.is_dataclass(bare) and inspect.isfunction(bare.__init__):
                bare.__init__ = decorated(bare.__init__)
                return bare
            if not inspect.isfunction(bare) or hasattr(bare, "checks_at_first"):
                return bare
            of_test = -1
            left = 0
            strict = None

            @functools.wraps(bare)
            def sometimes(*args: Any, **kwargs: Any) -> Any:
                nonlocal of_test, left, strict
                if of_test != tests_begun:
                    of_test, left = tests_begun, ENOUGH
                left -= 1
                if left < 0:
                    return bare(*args, **kwargs)
                if strict is None:  # most functions are never called by most workers
                    strict = decorate(**options)(bare)
                return strict(*args, **kwargs)

            vars(sometimes)["checks_at_first"] = True  # a class may have that of another
            return sometimes

        return decorated

    return decorator


jaxtyping.jaxtyped = checked_at_first(jaxtyping.jaxtyped)
jaxtyping.install_import_hook(
    ["workbench.geometry", "workbench.algorithms", "workbench.data"], "tests.conftest.checked"
)


def pytest_runtest_setup() -> None:
    """Let the next test check anew."""
    global tests_begun
    tests_begun += 1


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """The folder of real data beside the project."""
    folder = ROOT.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("real data (../shared/data) is not beside the project")
    return folder


@pytest.fixture(scope="session")
def pyodide() -> Path:
    """The folder of a Pyodide release, with numpy and scipy: WORKBENCH_PYODIDE, or beside the
    project.
    """
    folder = Path(os.environ.get("WORKBENCH_PYODIDE", ROOT.parent / "shared" / "pyodide"))
    if not (folder / "pyodide-lock.json").is_file():
        pytest.skip(f"no Pyodide in {folder}; WORKBENCH_PYODIDE names a folder with a release")
    if shutil.which("node") is None:
        pytest.skip("node, which runs Pyodide here, is not installed")
    return folder.resolve()


@pytest.fixture(scope="session")
def chromium() -> Iterator:
    """A running Chromium, one for all tests of a worker. A build server fails without it."""
    if find_chromium() is None:
        if os.environ.get("CI"):
            pytest.fail(HOW_TO)
        pytest.skip(HOW_TO)
    with started() as browser:
        yield browser


def pytest_xdist_auto_num_workers(config):
    """One more than there are cores: who drives a browser mostly waits for it."""
    return (os.cpu_count() or 1) + 1


def pytest_xdist_make_scheduler(config, log):
    """Keep together what shares something."""
    from tests.workers import Scheduling

    return Scheduling(config, log)


def pytest_collection_modifyitems(config, items):
    """Begin with what takes longest."""
    from tests.workers import rank

    items.sort(key=lambda item: rank(item.nodeid))


def pytest_collection_finish() -> None:
    """Look for garbage among what the tests make, not again and again among the tests."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20)
