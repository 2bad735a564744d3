import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests import fake
from workbench.errors import InputError
from workbench.run import links


def read(query: str):
    return links.read(query, here=fake.lesson)


@given(
    angle=st.floats(0, 180),
    steps=st.integers(1, 5000),
    wobble=st.booleans(),
    place=st.tuples(*[st.floats(-2, 2)] * 3),
    step=st.one_of(st.none(), st.integers(0, 5000)),
)
def test_a_link_leads_back_to_its_place(angle, steps, wobble, *, place, step):
    here = links.Place(
        fake.lesson, fake.Params(angle=angle, steps=steps, wobble=wobble, place=place), step
    )
    assert read(links.write(here)) == here


def test_a_link_is_short_and_readable():
    place = links.Place(fake.lesson, fake.Params(angle=120.0), 7)
    assert links.write(place) == "?lesson=fake&angle=120&step=7"


@pytest.mark.parametrize(
    ("query", "line"),
    [
        ("?lesson=nothing", "names the lesson 'nothing'"),
        ("?lesson=fake&angle=1e9", "angle = '1e9': a number from 0 to 180 deg"),
        ("?lesson=fake&step=last", "no whole number"),
        ("?lesson=fake&step=-", "no whole number"),
        ("?lesson=fake&angel=3", "unknown parameter 'angel'"),
        ("?lesson=fake&preset=none", "has no preset 'none'"),
        ("?lesson=fake&scan=/etc/passwd", "cannot name files"),
        ("?lesson=fake&colors=%3Cscript%3E", "one of role"),
    ],
)
def test_a_link_that_cannot_be_used_says_why_in_one_line(query, line):
    with pytest.raises(InputError, match=line) as caught:
        read(query)
    assert "\n" not in str(caught.value)


@given(st.text(max_size=60))
def test_any_text_is_a_place_or_one_line(text):
    for query in (text, "?lesson=fake&" + text):
        with contextlib.suppress(InputError):
            read(query)


def test_keys_of_others_are_left_alone():
    assert read("?lesson=fake&angle=120&websocket=ws://x&utm_source=mail") == read(
        "?lesson=fake&angle=120"
    )


def test_no_lesson_is_no_place_and_a_preset_can_be_named():
    assert read("") is None
    assert read("?websocket=ws://x") is None
    place = read("?lesson=fake&preset=half&steps=3")
    assert place is not None
    assert place.params == fake.Params(angle=180.0, steps=3)
