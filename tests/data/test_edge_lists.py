"""Graphs in text files: what is read, and one clear line for what is not."""

import numpy as np
import pytest

from workbench.data.files.edge_lists import read_edges
from workbench.errors import InputError


@pytest.fixture
def write(tmp_path):
    def write(text, name="friends.csv"):
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return tmp_path / name

    return write


@pytest.mark.parametrize(
    "text",
    [
        "source,target,weight\nAnn,Bo,2\nBo,Cy,1\nCy,Ann,0.5\n",
        "# friends\nAnn Bo 2\n\n% more\nBo Cy\nAnn Cy 0.5\n",
        "Ann\tBo\t1\nAnn;Bo;1\nBo , Cy, 1\n'Cy' , \"Ann\", 0.5\nCy,Cy,9\n",
    ],
)
def test_dialects(write, text):
    graph = read_edges(write(text), 100)
    assert graph.names == ("Ann", "Bo", "Cy")
    np.testing.assert_array_equal(graph.edges, [[0, 1], [1, 2], [0, 2]])
    np.testing.assert_allclose(graph.weights, [2, 1, 0.5])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a,b,c,d\n", "line 1: 4 entries"),
        ("a,b\nc\n", "line 2: 1 entries"),
        ("a,b,heavy\n", "'heavy' is no number"),
        ("a,b,-1\n", "weights are positive"),
        ("a,b,nan\n", "weights are positive"),
        ("# nothing\n", "no edge between two nodes"),
        ("a a\n", "no edge between two nodes"),
        (b"\xff\xfe\x00", "not a text file"),
        ("\n".join(f"0 {k}" for k in range(1, 9)), "9 nodes; at most 8"),
    ],
)
def test_what_is_refused(write, text, message):
    with pytest.raises(InputError, match=message) as caught:
        read_edges(write(text), 8)
    assert "friends.csv" in str(caught.value)


def test_other_files_are_refused(write):
    with pytest.raises(InputError, match="text files"):
        read_edges(write("a b", "friends.ply"), 8)
