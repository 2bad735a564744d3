"""`cached` keeps a value by the params that were read, and params in their guise are params."""

import copy
import functools
import pickle
import threading
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

from workbench.cached import cached, plain, watched
from workbench.knobs import Params, changed, fields_of, knob, only


class Input(Params):
    """Some inputs."""

    mode: Literal["near", "far"] = knob("near", "Which")
    near: int = knob(1, "Where it is near", 0, 99)
    far: int = knob(2, "Where it is far", 0, 99)
    other: int = knob(3, "Nothing reads it", 0, 99)

    @property
    def both(self) -> int:
        return self.near + self.far

    def times(self, factor: int) -> int:
        return factor * self.near


@pytest.fixture
def calls() -> list[Any]:
    return []


@pytest.fixture
def chosen(calls):
    @cached
    def chosen(params: Input) -> np.ndarray:
        calls.append(params.mode)
        return np.full(3, params.near if params.mode == "near" else params.far)

    return chosen


def test_only_what_was_read_makes_another_value(chosen, calls):
    first = chosen(Input())
    assert chosen(Input(far=7, other=9)) is first
    assert chosen(Input(near=5)) is not first
    assert chosen(Input(mode="far")) is not first
    assert chosen(Input(mode="far", near=50)) is chosen(Input(mode="far"))
    assert calls == ["near", "near", "far"]


def test_its_arrays_cannot_be_written(chosen):
    with pytest.raises(ValueError, match="read-only"):
        chosen(Input())[0] = 1


def test_more_arguments_are_part_of_the_key(calls):
    @cached
    def turned(params: Input, angle: float, *, back: bool = False) -> float:
        calls.append(angle)
        return (-1 if back else 1) * params.near * angle

    assert [turned(Input(), 2.0), turned(Input(), 3.0), turned(Input(), 2.0, back=True)] == [
        2,
        3,
        -2,
    ]
    assert turned(Input(far=9), 2.0) == 2
    assert calls == [2, 3, 2]


def test_what_a_function_reads_through_another_counts_for_both(chosen, calls):
    @cached
    def outer(params: Input) -> float:
        calls.append("outer")
        return float(chosen(params)[0])

    assert outer(Input(near=4)) == 4
    assert outer(Input(near=5)) == 5  # though `outer` reads nothing by itself
    chosen(Input(near=6))
    assert outer(Input(near=6)) == 6  # and though the inner value is kept already
    assert outer(Input(near=6, far=8)) == 6
    assert calls.count("outer") == 3


def test_methods_and_properties_read_what_they_read():
    read = set()
    params = watched(Input(), read.add)
    assert params.times(3) == 3
    assert read == {"near"}
    assert params.both == 3
    assert read == {"near", "far"}


def test_in_their_guise_params_are_equal_hashed_copied_and_pickled():
    read = set()
    params = watched(Input(near=8), read.add)
    assert isinstance(params, Input)
    assert params.__class__ is Input
    assert read == set()
    assert params == Input(near=8)
    assert Input(near=8) == params
    assert params != Input()
    assert {params: 1}[Input(near=8)] == 1
    assert read == {"mode", "near", "far", "other"}
    for again in (copy.copy(params), copy.deepcopy(params), pickle.loads(pickle.dumps(params))):
        assert type(again) is Input
        assert again == params
    assert type(replace(params, far=5)) is Input
    assert replace(params, far=5) == Input(near=8, far=5)
    assert type(type(params)(near=3)) is Input
    assert repr(params) == repr(Input(near=8))
    assert plain(params) == Input(near=8)
    assert changed(params) == {"near": "8"}
    assert only(params, "near") == Input(near=8)
    assert fields_of(type(params)) == fields_of(Input)


def test_a_cache_of_python_s_own_reads_everything():
    read = set()

    @functools.lru_cache
    def kept(params: Input) -> int:
        return params.near

    kept(watched(Input(), read.add))
    assert read == {"mode", "near", "far", "other"}


def test_the_least_used_go_first(calls):
    @cached(most=2)
    def squared(params: Input) -> int:
        calls.append(params.near)
        return params.near**2

    for near in (1, 2, 1, 3, 1, 2):
        squared(Input(near=near))
    assert calls == [1, 2, 3, 2]
    squared.forget()  # type: ignore[attr-defined]
    squared(Input(near=2))
    assert calls == [1, 2, 3, 2, 2]


def test_what_fails_is_tried_again_and_counts_as_read(calls):
    read = set()

    @cached
    def failing(params: Input) -> int:
        calls.append(params.near)
        raise ValueError("not now")

    for _ in range(2):
        with pytest.raises(ValueError, match="not now"):
            failing(watched(Input(), read.add))
    assert calls == [1, 1]
    assert read == {"near"}


def test_a_generator_is_refused():
    with pytest.raises(TypeError, match="yields; @cached is for a function that returns"):

        @cached
        def going(params: Input):
            yield params.near


def test_none_is_a_value(calls):
    @cached
    def nothing(params: Input) -> None:
        calls.append(params.near)

    nothing(Input())
    nothing(Input())
    assert calls == [1]


def test_threads_may_ask_at_once(chosen):
    differences: list[np.ndarray] = []

    def ask(k: int) -> None:
        for near in range(40):
            differences.append(chosen(Input(near=near, far=k)) - near)

    threads = [threading.Thread(target=ask, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(differences) == 160
    assert not np.any(differences)


class Filed(Params):
    """A file of a person's own."""

    own: Path | None = knob(None, "A file")


def test_a_file_that_changed_is_read_again(calls, tmp_path):
    @cached
    def read(params: Filed) -> str:
        calls.append(params)
        return "" if params.own is None else params.own.read_text()

    file = tmp_path / "own.txt"
    params = Filed(own=file)
    with pytest.raises(FileNotFoundError):
        read(params)
    file.write_text("first")
    assert (read(params), read(params), len(calls)) == ("first", "first", 2)
    file.write_text("then another")
    assert (read(params), read(params), len(calls)) == ("then another", "then another", 3)
