"""Marching cubes and squares: closed whatever is inside, outwards, on the edges that are crossed,
and what scikit-image finds.
"""

import itertools
from collections import Counter

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from skimage.measure import euler_number, find_contours
from skimage.measure import marching_cubes as their_cubes

from workbench.geometry.fields.marching import (
    _triangle_table,
    closed_lines,
    marching_cubes,
    marching_squares,
)
from workbench.geometry.meshes import euler_characteristic
from workbench.geometry.meshes.measures import encloses, signed_volume, surface_area

SIDES = st.integers(1, 5)
SOLIDS = st.tuples(SIDES, SIDES, SIDES).flatmap(lambda shape: arrays(bool, shape))
_triangle_table()  # made once, before hypothesis looks at the clock
SHAPES = st.tuples(SIDES, SIDES).flatmap(lambda shape: arrays(bool, shape))


def blob(seed: int, side: int = 24) -> np.ndarray:
    """A smooth field, negative in some places, positive on the border."""
    rng = np.random.default_rng(seed)
    x = np.stack(np.meshgrid(*[np.linspace(-1, 1, side)] * 3, indexing="ij"))
    centres = rng.uniform(-0.5, 0.5, (4, 3, 1, 1, 1))
    return 0.35 - np.sum(np.exp(-12 * ((x - centres) ** 2).sum(axis=1)), axis=0)


@given(SOLIDS)
def test_the_surface_is_closed_and_each_side_has_two_faces_whatever_is_inside(bits):
    low, _, faces = marching_cubes(np.pad(bits, 1))
    sides = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    _, times = np.unique(sides, axis=0, return_counts=True)
    assert (times == 2).all()
    assert encloses(faces)
    assert len(np.unique(faces)) == len(low), "every vertex is used"


@given(SOLIDS)
def test_a_vertex_is_between_a_node_inside_and_its_neighbour_outside(bits):
    inside = np.pad(bits, 1)
    low, high, _ = marching_cubes(inside)
    assert (np.abs(high - low).sum(axis=1) == 1).all()
    assert (inside[tuple(low.T)] != inside[tuple(high.T)]).all()
    crossed = sum(np.count_nonzero(np.diff(inside, axis=axis)) for axis in range(3))
    assert len(low) == crossed


@given(SOLIDS.filter(np.any))
def test_the_surface_turns_outwards_and_has_the_euler_number_of_the_solid(bits):
    inside = np.pad(bits, 1)
    assume(not has_a_pierced_cell(inside))
    low, high, faces = marching_cubes(inside)
    assert signed_volume((low + high) / 2, faces) > 0
    # corners apart that only touch: 6 neighbours; a closed surface has twice its solid's number
    assert euler_characteristic(faces) == 2 * euler_number(inside, connectivity=1)


def has_a_pierced_cell(inside: np.ndarray) -> bool:
    """Whether a cell has only two opposite corners outside: for counted neighbours they touch
    through it, and the surface keeps them apart.
    """
    cells = np.lib.stride_tricks.sliding_window_view(inside, (2, 2, 2)).reshape(-1, 8)
    six = cells[cells.sum(axis=1) == 6]
    return bool((~six & ~six[:, ::-1]).any())


@pytest.mark.parametrize("seed", range(4))
def test_scikit_image_finds_the_same_vertices_and_nearly_the_same_surface(seed):
    values = blob(seed)
    low, high, faces = marching_cubes(values < 0)
    f_low = values[tuple(low.T)]
    p = low + (f_low / (f_low - values[tuple(high.T)]))[:, None] * (high - low)
    theirs, their_faces, _, _ = their_cubes(values, 0.0)
    assert len(p) == len(theirs)
    ours = p[np.lexsort(np.rint(p * 1e4).T)]
    np.testing.assert_allclose(ours, theirs[np.lexsort(np.rint(theirs * 1e4).T)], atol=2e-4)
    assert len(faces) == len(their_faces)
    assert signed_volume(p, faces) == pytest.approx(
        signed_volume(theirs.astype(float), their_faces), rel=2e-3
    )
    assert surface_area(p, faces) == pytest.approx(
        surface_area(theirs.astype(float), their_faces), rel=2e-3
    )


def test_bits_have_the_area_that_scikit_image_gives_them():
    x = np.stack(np.meshgrid(*[np.arange(-12.0, 13.0)] * 3, indexing="ij"))
    ball = (x**2).sum(axis=0) < 100
    low, high, faces = marching_cubes(ball)
    theirs, their_faces, _, _ = their_cubes(ball.astype(np.float32), 0.5)
    assert surface_area((low + high) / 2, faces) == pytest.approx(
        surface_area(theirs.astype(float), their_faces), rel=1e-6
    )


def test_the_table_parts_inside_from_outside_in_every_pattern_and_keeps_inside_corners_apart():
    triangles, begins = _triangle_table()
    for case in range(256):
        sides = Counter(
            (int(triangle[i]), int(triangle[i - 2]))
            for triangle in triangles[begins[case] : begins[case + 1]]
            for i in range(3)
        )
        rim = {side for side in sides if side[::-1] not in sides}
        assert set(sides.values()) <= {1}, case
        # what is left of the triangles' sides is what the rule draws on the faces of the cell
        assert rim == {side for face in FACES for side in drawn_on(face, case)}, case
        inner = {frozenset(side) for side in sides} - {frozenset(side) for side in rim}
        assert not any(one_face_has(*side) for side in inner), "the next cell may have it too"


FACES = [
    [0b000, 0b001, 0b011, 0b010],
    [0b100, 0b110, 0b111, 0b101],
    [0b000, 0b100, 0b101, 0b001],
    [0b010, 0b011, 0b111, 0b110],
    [0b000, 0b010, 0b110, 0b100],
    [0b001, 0b101, 0b111, 0b011],
]
"""The corners of a cell's faces, clockwise seen from outside."""


def drawn_on(face: list[int], case: int) -> list[tuple[int, int]]:
    """The segments, from edge to edge, that cut off each run of inside corners of a face."""
    inside = [bool(case >> corner & 1) for corner in face]
    segments = []
    for i in range(4):
        if inside[i] and not inside[i - 1]:
            last = next(k for k in range(i, i + 4) if not inside[(k + 1) % 4])
            ends = (face[i - 1], face[i]), (face[last % 4], face[(last + 1) % 4])
            segments.append((edge_between(*ends[1]), edge_between(*ends[0])))
    return segments


def edge_between(a: int, b: int) -> int:
    axis = (a ^ b).bit_length() - 1
    begins = [corner for corner in range(8) if not corner >> axis & 1]
    return 4 * axis + begins.index(min(a, b))


def one_face_has(edge: int, other: int) -> bool:
    """Whether two edges are on one face of the cell."""
    on = [{edge_between(a, b) for a, b in itertools.pairwise([*face, face[0]])} for face in FACES]
    return any({edge, other} <= edges for edges in on)


@given(SHAPES)
def test_lines_are_closed_and_keep_the_inside_to_their_left(bits):
    inside = np.pad(bits, 1)
    low, high, segments = marching_squares(inside)
    lines = closed_lines(segments)
    assert sorted(np.concatenate([np.empty(0, np.intp), *lines])) == list(range(len(low)))
    p = (low + high) / 2
    area = sum(signed_area(p[line]) for line in lines)
    assert area > 0 or not bits.any()


def signed_area(p: np.ndarray) -> float:
    q = np.roll(p, -1, axis=0)
    return float(0.5 * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum())


@given(SHAPES)
def test_scikit_image_finds_the_same_lines(bits):
    inside = np.pad(bits, 1)
    low, high, segments = marching_squares(inside)
    p = (low + high) / 2
    ours = {frozenset(map(tuple, p[pair])) for pair in segments}
    theirs = find_contours(inside.astype(float), 0.5)
    pairs = (pair for line in theirs for pair in itertools.pairwise(map(tuple, line)))
    assert ours == {frozenset(pair) for pair in pairs}


def test_an_open_line_is_refused():
    with pytest.raises(ValueError, match="does not end where it began"):
        closed_lines(np.array([[0, 1], [1, 2]]))
