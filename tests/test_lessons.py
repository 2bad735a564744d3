"""Holds every lesson of the catalogue to the same promises; a new lesson is covered without an edit
here.
"""

from pathlib import Path

import pytest

from tests.runs import whole_run
from workbench.authoring.validate import OF_LESSONS, Subject
from workbench.lesson import catalog

ROOT = Path(__file__).resolve().parents[1]


def test_every_folder_is_in_the_catalogue():
    folders = {path.parent.name for path in (ROOT / "lessons").glob("*/__init__.py")}
    assert folders <= set(catalog())


@pytest.fixture(scope="module", params=catalog().values(), ids=lambda lesson: lesson.name)
def subject(request) -> Subject:
    return Subject(request.param, lambda params: whole_run(request.param.name, params))


@pytest.mark.parametrize("promise", OF_LESSONS, ids=lambda promise: promise.__name__)
def test_it_keeps_its_promises(subject, promise):
    wrong = [line for line in promise(subject) if line is not None]
    assert not wrong, "\n".join(wrong)
