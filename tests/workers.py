"""Spreads tests over workers: what shares a server, a site or a lesson's whole runs goes to one of
them, the longest first.

xdist's own groups (`--dist loadgroup`) are written into the names of tests, which pytest 9 no
longer lets it do.
"""

import re

from xdist.scheduler import LoadScopeScheduling

RUN_LESSONS = re.compile(
    r"tests/(?:test_lessons|test_verdicts|test_ordered_pairs|test_spoilers|lessons/test_rest|page/test_article"
    r"|page/test_links|page/test_thumbnail|recording/test_read_back)\.py::"
    r"\w+\[(\w+)"
)
OF_A_LESSON = re.compile(
    r"tests/lessons/test_(?!rest\b)(\w+?)"
    r"(?:_(?:own|slots|drawn|flat|run|surfaces|stages|presets))?\.py::"
)
HOMES_OF_A_LESSON = re.compile(r"(tests/browser/test_matrix\.py::\w+\[\w+)-")
IN_A_BROWSER = re.compile(r"(tests/(?:browser/\w+|recording/test_browser)\.py)::")


class Scheduling(LoadScopeScheduling):
    """Gives a worker all whole runs of a lesson, all its homes, or all of a file that opens a
    browser; others one by one.
    """

    def _split_scope(self, nodeid: str) -> str:
        return next((match[1] for pattern in GROUPS if (match := pattern.match(nodeid))), nodeid)


def rank(nodeid: str) -> int:
    """Return when a test is begun: what one worker is long at alone must not be left to the end."""
    return next((k for k, pattern in enumerate(FIRST) if pattern.match(nodeid)), len(FIRST))


GROUPS = (HOMES_OF_A_LESSON, IN_A_BROWSER, OF_A_LESSON, RUN_LESSONS)
FIRST = (IN_A_BROWSER, OF_A_LESSON, RUN_LESSONS)
