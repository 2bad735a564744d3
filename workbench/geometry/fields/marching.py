"""Marching cubes and marching squares: the surface, or the lines, between nodes of a grid that are
inside and nodes that are not.

Every cell looks at its own eight corners alone: a table says of each of the 256 patterns of inside
and outside which triangles part them. A vertex is on every edge of the grid whose two ends differ;
where on the edge is for the caller to say.

The paper lists 15 patterns up to symmetry. An ambiguous face, two of whose corners are inside,
opposite each other, it cuts in one way in some and in the other way in others, which leaves holes.
In this table every face keeps its inside corners apart, so that two cells cut the face that they
share alike, and the surface is closed. Where nothing is ambiguous the table has Lewiner's triangles
in his order, as scikit-image (BSD-3-Clause) makes them.

References: Lorensen and Cline, Marching cubes: a high resolution 3D surface construction
algorithm, SIGGRAPH 1987, sections 4 and 5; Duerst, Additional reference to marching cubes, Computer
Graphics 22(2), 1988, on the holes; Montani, Scateni and Scopigno, A modified look-up table for
implicit disambiguation of marching cubes, The Visual Computer 10, 1994, on the rule; Lewiner et
al., Efficient implementation of marching cubes' cases with topological guarantees, JGT 8(2), 2003.
"""

import functools

import numpy as np
from jaxtyping import Bool, Int

Nodes = Int[np.ndarray, "v d"]

Edge = tuple[int, int]
"""An edge of a cell: the corner where it begins, and the axis along which it runs. Bit k of a
corner says where it is along axis k.
"""
_SQUARE = (0b00, 0b01, 0b11, 0b10)
"""The corners of a cell of marching squares, in order."""
_BEGINS = np.array([0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3])
"""The corner where each edge of a cube begins: four along x, then along y, then along z."""
_TRIANGLES = """
- aei faj eijejf bke bkibia ajfebk jfbkjbijk lbf eiabfl ajlalb lbeilejli kefkfl iaflifkil
keajkalkj jkilkj gci aegagc igcajf gcjfgjegf gcikeb bkgcbgabc ajfcigbke fbjjbcbkckgc igcbfl
bflcegeca albajligc jlclecegcelb igclefelk lkgalgcagfla igceakjkakjl cjgjkgjlk hjc chjiae facfch
eichecfeh chjkeb hjckibabi cfachfebk hfcfkckicfbk jchflb eiahjcflb chlbclacb lbeleihlichi
chjefklkf chjlafalikil achkahlkhake hlcliclki hjihig hjaehaghe faigfihfg heghfe kebjghgji
ghkhakabkahj bkegaiagfhfg kgbgfbghf bflghijih flbjahehaheg baihbighilbh belehlegh fkekfligjhjg
kflfkagakagjhjg kelalelahihahig hlgglk kdg iaegkd gkdajf gkdfijife dgedeb dgiadibda jfagedbde
bdgjbgijgbjf dgklbf bflaeidgk albajlkdg dgkibebiljli fldgfdefg fldfdgafgiag gealgajladgl
gidildijl kdckci aekdakcad ajfdikidc dckcfkfekcjf ciebcedcb adcabd jfabieibcdcb fbjbcjbdc
flbikcdck flbdekedacad cidkdilajalb lbjejbjeckceckd efifdidcidfl ldfdafdca lajaledeledicid
cjddjl gkdchj chjdgkaei cfachfkdg gkdicehecehf chjbgegbd hjcagigadbda fchcfadgbebg
fchcfibifibgdgb gkdflbhjc bflgkdaeichj dgkhlcbclcba elbehlecheickdg hjcldfgfdfge agiadgaldafljch
edgdelalelahcha dglgillichlc kdhjkhikj dhkkhehjejae ikakhahfahkd dhkhekhfe jihibhbdhieb
jahadhabd fahihahidedideb dhbbhf bfljdhdjkikj ahjadhakdaekflb kdihidihalahalb lbhbehkdhkhe
ihjhidedidelfle flaldahjahad eaildh hld lhd iaehdl hdljfa dlhijefej kebdlh dlhakikab kebjfalhd
lhdfbjkjbjki hdbhbf aeihbfhdb ajhdahbad ijhbihdbheib hdkehkfhe kiahkafhakhd hdkhkejheaje
dkhkjhkij cighdl lhdegacag igclhdjfa dlhfcjcfgegf dlhbkecig lhdckgkcbabc ajfkebcigdlh
fcjfgcfkgfbklhd igchbfhdb hdfbfdagcgae cigjhadahadb gcejecejbhbjbhd cigedkdehfhe hdfkfdfkagakagc
akeadkahdajhigc hdjdkjgcjgjk jcdjdl aeijdljcd dlfadfcda feidficdifdl ebkjdljcd biaibkjcldlc
bkelfdadfdac ibkbifcfifcldlc bfjcbjdbc aeifjbcbjbcd dacbad icecbecdb cdkfckefkjcf
iakfkakfdjdfdjc eakadkacd dkccki igdlidjil egaglaljagdl lfddfgfagaig lfdfgdfeg kebgdilidilj
jdldjgagjgakbka alfadlagdaigebk bkfkgfdlfdfg dbgbjgjigjbf gaeagjdjgjdfbfd gdidaidba gdeedb
igjdjgjdfkfdfke dkgfja kedeadigdida dkg lhglgk eiahklkhg ajfklghgl gkhlhkjeiejf eblhelgeh
abibhihgiblh ajfhblbhegeh glhlgbibgbifjfi gkbfgbhgf eiakbgfgbgfh hgkahkbakhaj gkhbhkhbjejbjei
ehgfhe afifgifhg jhaheahge jhiihg lhcilckli cahakhklhkae jfahclilclik ejfjeckceckhlhk
bleelilhihci hclcblcab ajfeciehcelhebl lhbhcbjfbjbc fhckfcikcbfk hbfbhkckhkceaec kcickhbhkhbjajb
jhcbek iecehcefh afccfh ajejhecieceh jhc jcgkjgljk aeikcgckjljk klglagacglfa eifcfifclglclgk
ljcelcgecleb jclglclgbibgbia ebglgbglcfclcfa cgilfb bfjbjckbcgkc aeifkbfgkfcgfjc kbgbcgbac
eibicbgkbgbc cgjgfjgef jcfcgfiafifg eaggac cgi kjiklj ekakjaklj aifilfikl ekffkl blelielji
jallab falailebleli blf fjbjkbjik bfkfjkaekakj kbiiba kbe iejjef afj eai -
"""
"""Of each pattern, corner k being inside as bit k, the triangles, three edges each, named by
letters: a to d along x, e to h along y, i to l along z.
"""


def marching_cubes(
    inside: Bool[np.ndarray, "x y z"],
) -> tuple[Nodes, Nodes, Int[np.ndarray, "f 3"]]:
    """Return the surface between inside and outside: of each vertex the two nodes that it is
    between, and the faces, outwards; cell by cell, the last index running fastest.

    The first node of the two has the smaller index. The surface is closed but for where it meets
    the border of the grid, and every inner edge has two faces.

    Examples:
        >>> inside = np.zeros((3, 3, 3), dtype=bool)
        >>> inside[1, 1, 1] = True
        >>> low, high, faces = marching_cubes(inside)
        >>> len(low), len(faces)
        (6, 8)
    """
    low, high, names = _crossed_edges(inside)
    corners = np.array([(c & 1, c >> 1 & 1, c >> 2) for c in range(8)])
    pattern = _patterns(inside, corners)
    cells = np.argwhere((pattern > 0) & (pattern < 255))
    triangles, begins = _triangle_table()
    of_cell = pattern[tuple(cells.T)]
    first = begins[of_cell]
    count = begins[of_cell + 1] - first
    cell = np.repeat(np.arange(len(cells)), count)
    row = np.arange(len(cell)) - np.repeat(np.cumsum(count) - count, count) + first[cell]
    edge = triangles[row]
    at = cells[cell][:, None] + corners[_BEGINS[edge]]
    crossings = names[edge // 4, at[..., 0], at[..., 1], at[..., 2]]
    used, met = np.unique(crossings[:, ::-1], return_index=True)
    used = used[np.argsort(met)]  # in the order in which the cells meet them
    number = np.empty(len(low), np.intp)
    number[used] = np.arange(len(used))
    return low[used], high[used], number[crossings]


def marching_squares(
    inside: Bool[np.ndarray, "y x"],
) -> tuple[Nodes, Nodes, Int[np.ndarray, "s 2"]]:
    """Return the lines between inside and outside: of each vertex the two nodes that it is between,
    and the segments, inside to their left where the first axis points right and the second up.

    Examples:
        >>> low, high, segments = marching_squares(np.array([[True, False], [True, False]]))
        >>> low.tolist(), high.tolist(), segments.tolist()
        ([[0, 0], [1, 0]], [[0, 1], [1, 1]], [[1, 0]])
    """
    low, high, names = _crossed_edges(inside)
    corners = np.array([(c & 1, c >> 1) for c in range(4)])
    pattern = _patterns(inside, corners)
    segments = [np.empty((0, 2), np.intp)]
    for case in range(1, 15):
        cells = np.argwhere(pattern == case)
        for segment in _cut(case):
            ends = []
            for corner, axis in segment:
                y, x = (cells + corners[corner]).T
                ends.append(names[axis, y, x])
            segments.append(np.stack(ends, axis=1))
    return low, high, np.concatenate(segments)


def closed_lines(segments: Int[np.ndarray, "s 2"]) -> list[Int[np.ndarray, " n"]]:
    """Return segments joined to lines that end where they began: vertices in the order of the
    segments, none twice.

    Raises:
        ValueError: If a line is open, as those are that reach the border of their grid.
    """
    after = dict(segments.tolist())
    lines = []
    while after:
        start = min(after)
        line = [start]
        while (vertex := after.pop(line[-1], None)) != start:
            if vertex is None:
                raise ValueError("a line does not end where it began")
            line.append(vertex)
        lines.append(np.array(line, np.intp))
    return lines


def _crossed_edges(inside: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return both ends of every edge that is crossed, and by axis and first end its number."""
    names = np.full((inside.ndim, *inside.shape), -1, np.intp)
    low: list[np.ndarray] = []
    high: list[np.ndarray] = []
    count = 0
    for axis in range(inside.ndim):
        first = np.argwhere(np.diff(inside, axis=axis))
        names[axis][tuple(first.T)] = count + np.arange(len(first))
        low.append(first)
        high.append(first + np.eye(inside.ndim, dtype=np.intp)[axis])
        count += len(first)
    return np.concatenate(low), np.concatenate(high), names


def _patterns(inside: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return of every cell which of its corners are inside, corner c as bit c."""
    pattern = np.zeros(np.maximum(np.array(inside.shape) - 1, 0), np.intp)
    for c, corner in enumerate(corners):
        here = tuple(slice(k, n - 1 + k) for k, n in zip(corner, inside.shape, strict=True))
        pattern |= inside[here].astype(np.intp) << c
    return pattern


def _cut(case: int) -> list[tuple[Edge, Edge]]:
    """Return the segments that cut off the inside corners of a square, each run of neighbours by
    one segment, which has them to its left where the corners are walked around counterclockwise.
    """
    inside = [bool(case >> corner & 1) for corner in _SQUARE]
    segments = []
    for i in range(4):
        if inside[i] and not inside[i - 1]:  # a run of inside corners begins here
            last = i
            while inside[(last + 1) % 4]:
                last += 1
            enters = _edge(_SQUARE[i - 1], _SQUARE[i])
            leaves = _edge(_SQUARE[last % 4], _SQUARE[(last + 1) % 4])
            segments.append((leaves, enters))
    return segments


def _edge(a: int, b: int) -> Edge:
    return min(a, b), (a ^ b).bit_length() - 1


@functools.cache
def _triangle_table() -> tuple[Int[np.ndarray, "t 3"], Int[np.ndarray, "257"]]:
    """Return the triangles of all patterns one after the other, each three edges, and where those
    of each pattern begin.
    """
    rows = ["", *_TRIANGLES.replace("-", "").split(), ""]
    edges = np.frombuffer("".join(rows).encode(), np.uint8).astype(np.intp) - ord("a")
    return edges.reshape(-1, 3), np.cumsum([0, *(len(row) // 3 for row in rows)])
