"""What waits for one page: of each kind the latest, and nothing that a later request needs is
lost.
"""

from workbench.viewer.requests import Requests


def waiting(*requests):
    found = Requests()
    for request in requests:
        found.add(request)
    return [request["verb"] for request in found.take()]


def test_a_run_that_is_asked_for_at_once_does_not_lose_the_lesson_that_it_is_of():
    opened = {"verb": "open", "query": "?lesson=icp", "lesson": "icp"}
    assert waiting(opened, {"verb": "run", "run": "far"}) == ["open", "run"]
    assert waiting(opened, {"verb": "reset"}) == ["open", "reset"]


def test_what_is_opened_anew_makes_all_before_it_void():
    opened = {"verb": "open", "query": "?lesson=icp", "lesson": "icp"}
    run, seek = {"verb": "run", "run": "far"}, {"verb": "seek", "k": 3}
    assert waiting(opened, run, seek, opened) == ["open"]
    assert waiting(run, seek, {"verb": "run", "run": "plane"}) == ["run"]
