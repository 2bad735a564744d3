import struct

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from workbench.exercise.child.wire import WireError, lengths, pack, unpack

ARRAYS = hnp.arrays(
    st.sampled_from([np.float64, np.float32, np.int64, np.uint8, np.bool_]),
    hnp.array_shapes(min_dims=0, min_side=0),
)
VALUES = st.recursive(
    st.one_of(
        st.none(), st.booleans(), st.integers(-(2**62), 2**62), st.floats(), st.text(), ARRAYS
    ),
    lambda inner: st.lists(inner, max_size=3),
    max_leaves=8,
)


def through(message):
    data = pack(message)
    header, payload = lengths(data[:16])
    return unpack(data[16 : 16 + header], data[16 + header : 16 + header + payload])


def same(a, b) -> bool:
    if isinstance(a, (np.ndarray, np.generic)):
        return (
            type(b) is np.ndarray
            and b.dtype == a.dtype
            and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
        )
    if isinstance(a, list):
        return isinstance(b, list) and len(a) == len(b) and all(map(same, a, b))
    return type(a) is type(b) and (a == b or a != a)


@given(VALUES)
def test_every_value_comes_back_as_it_was(value):
    assert same(value, through({"value": value})["value"])


class Sly(np.ndarray):
    def __abs__(self):
        return np.zeros(3)

    def __eq__(self, other):
        return True

    def __array_function__(self, *args):
        return 0.0


@pytest.mark.parametrize("kind", ["?", *"bhlBHL", *"efd"])
def test_arrays_of_every_size_of_number_cross(kind):
    array = np.arange(6).reshape(2, 3).astype(kind)
    assert same(array, through({"value": array})["value"])


def test_a_subclass_arrives_as_a_plain_array():
    arrived = through({"value": np.ones(3).view(Sly)})["value"]
    assert type(arrived) is np.ndarray
    assert abs(arrived).tolist() == [1, 1, 1]


def test_a_picture_as_nested_lists_crosses():
    rows = np.random.default_rng(0).normal(size=(120, 120)).tolist()
    colours = np.random.default_rng(0).normal(size=(120, 120, 3)).tolist()
    arrived = through({"rows": rows, "colours": colours, "numpy's": list(np.arange(3.0))})
    assert arrived == {"rows": rows, "colours": colours, "numpy's": [0.0, 1.0, 2.0]}


@pytest.mark.parametrize(
    "value", [object(), {1: 2}, np.array([object()]), np.array(["a"]), 2**70, 1j, b"x"]
)
def test_what_is_no_value_is_refused(value):
    with pytest.raises(WireError):
        pack({"value": value})


@given(st.binary(max_size=60), st.binary(max_size=60))
def test_any_bytes_are_a_message_or_refused(header, payload):
    try:
        unpack(header, payload)
    except WireError:
        return


@pytest.mark.parametrize(
    "header",
    [
        b'{"v":{"a":"<f8","s":[-1]}}',
        b'{"v":{"a":"<f8","s":[9]}}',
        b'{"v":{"a":"O","s":[1]}}',
        b'{"v":{"v":{}}}',
        b"[]",
        b'{"v":{"n":-1}}',
        b'{"v":{"n":2}}',
        b'{"v":{"n":"x"}}',
        b'{"v":{"a":"<f8","s":[1,1,1,1,1,1,1,1,1]}}',
        b'{"v":{"v":1.5}}',
        b'{"v":{"l":[' + b'{"v":0},' * 100_000 + b'{"v":0}]}}',
    ],
)
def test_a_forged_header_is_refused(header):
    with pytest.raises(WireError):
        unpack(header, b"12345678")


def test_a_message_has_bounds():
    most = (4 << 20, 64 << 20)
    assert lengths(struct.pack("<QQ", *most)) == most
    for more in ((most[0] + 1, 0), (0, most[1] + 1)):
        with pytest.raises(WireError, match="out of bounds"):
            lengths(struct.pack("<QQ", *more))
    for value in (np.zeros(most[1] + 1, "u1"), "x" * most[0]):
        with pytest.raises(WireError, match="more than the 64 MB a result may have"):
            pack({"value": value})


def test_lists_cross_eight_deep():
    value = []
    for _ in range(8):
        value = [value]
    assert through({"value": value}) == {"value": value}
    with pytest.raises(WireError, match="the value has too many parts"):
        pack({"value": [value]})
    data = pack({"value": value})
    deeper = data[16:].replace(b'{"l": []}', b'{"l": [{"l": []}]}')
    with pytest.raises(WireError, match="not a message"):
        unpack(deeper, b"")


def test_an_array_that_did_not_come_whole_is_refused():
    data = pack({"value": [np.zeros(2), np.zeros(3)]})
    header, _ = lengths(data[:16])
    with pytest.raises(WireError, match="longer than what came"):
        unpack(data[16 : 16 + header], data[16 + header : -8])
