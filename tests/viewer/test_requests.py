"""What waits for one page: of each kind the latest, and nothing that a later request needs is
lost. What is no request is told at a glance.
"""

import json

import pytest

from workbench.knobs import fields_of, to_json
from workbench.lesson import catalog
from workbench.viewer import requests as requests_module
from workbench.viewer.requests import MOST_BRACKETS, Requests, read_request


def waiting(*requests):
    queue = Requests()
    for request in requests:
        queue.add(request)
    return [request["verb"] for request in queue.take()]


def test_a_run_that_is_asked_for_at_once_does_not_lose_the_lesson_that_it_is_of():
    opened = {"verb": "open", "query": "?lesson=icp", "lesson": "icp"}
    assert waiting(opened, {"verb": "run", "run": "far"}) == ["open", "run"]
    assert waiting(opened, {"verb": "reset"}) == ["open", "reset"]


def test_what_is_opened_anew_makes_all_before_it_void():
    opened = {"verb": "open", "query": "?lesson=icp", "lesson": "icp"}
    run = {"verb": "run", "run": "far"}
    seek = {"verb": "seek", "k": 3}
    assert waiting(opened, run, seek, opened) == ["open"]
    assert waiting(run, seek, {"verb": "run", "run": "plane"}) == ["run"]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[" * 9000,
        '"open"',
        '{"verb": "seek", "k": ' + "[" * MOST_BRACKETS,
        '{"verb": "seek", "k": ' + '{"k": ' * MOST_BRACKETS,
        '{"verb": "seek", "k": 1}' + " " * 20_000,
    ],
    ids=["nothing", "brackets", "text", "lists", "objects", "long"],
)
def test_rubbish_is_not_parsed(text, monkeypatch):
    parsed: list[str] = []
    monkeypatch.setattr(requests_module.json, "loads", parsed.append)
    assert read_request(text) is None
    assert parsed == []


def test_a_change_of_all_params_of_a_lesson_is_read_and_there_is_room_for_as_many_again():
    for lesson in catalog().values():
        assert 2 * (2 + len(fields_of(lesson.params))) < MOST_BRACKETS, lesson.name
        change = {"verb": "change", "values": json.loads(to_json(lesson.params()))}
        assert read_request(json.dumps(change)) == change
