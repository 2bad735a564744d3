"""The rabbit of the course as a drawing: the outline of its shadow, seen from the side.

Lengths in metres in the x-z plane of `workbench.data.shapes.rabbit`: the nose towards +x, the ears
towards +z.
"""

import numpy as np
from jaxtyping import Float

Flat = Float[np.ndarray, "n 2"]

_MILLIMETRES = """
446,247 440,270 430,292 418,312 402,330 385,346 366,360 345,372 324,382 302,391 282,403 271,424
265,447 259,470 254,493 248,516 241,539 234,562 227,584 219,606 210,628 200,650 189,671 177,691
162,710 141,718 128,700 125,677 124,653 125,629 128,606 131,582 135,559 140,535 145,512 151,489
157,466 163,444 148,448 129,462 110,476 90,488 69,501 49,512 27,522 5,532 -17,539 -41,542
-61,532 -58,509 -47,488 -32,470 -16,452 0,435 18,420 36,404 55,390 74,376 93,362 113,349 115,331
104,311 96,288 90,265 83,243 64,231 40,228 17,226 -7,223 -30,219 -54,215 -77,209 -99,202
-122,194 -144,185 -165,175 -186,163 -206,151 -225,137 -244,123 -262,107 -279,91 -297,75 -319,69
-343,71 -367,71 -390,65 -411,55 -428,39 -441,19 -449,-4 -450,-27 -445,-50 -434,-71 -419,-89
-400,-103 -379,-114 -360,-128 -348,-149 -339,-170 -328,-191 -315,-211 -299,-230 -285,-248
-269,-266 -250,-280 -229,-291 -207,-300 -184,-306 -161,-311 -138,-317 -115,-321 -91,-324
-68,-326 -44,-326 -20,-325 3,-323 27,-320 50,-316 73,-310 96,-304 118,-296 141,-296 163,-302
187,-307 210,-310 234,-311 257,-309 280,-303 304,-301 327,-298 350,-293 372,-284 391,-270
397,-248 386,-228 367,-213 346,-202 324,-193 301,-186 294,-173 308,-154 320,-134 331,-113
341,-91 348,-68 353,-45 355,-22 355,2 353,26 349,49 347,73 359,93 378,107 397,121 414,137
429,156 439,177 446,200 448,224
"""


def rabbit_outline() -> Flat:
    """Return 160 points of the outline, evenly spaced along it, counterclockwise from the nose.

    They are stored, so that a run needs no marching of the surface: each is the rim of the rabbit
    (`rabbit_field`) seen along y, to half a millimetre.
    """
    rows = [pair.split(",") for pair in _MILLIMETRES.split()]
    return np.array(rows, dtype=float) / 1000.0


def along(p: Flat, count: int, offset: float = 0.0) -> Float[np.ndarray, "m 2"]:
    """Return so many points evenly spaced along a closed line.

    Args:
        p: Its corners in order, the first not repeated.
        count: How many points.
        offset: Where the first lies behind the first corner, in gaps between the new points.

    Examples:
        >>> along(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]), 2).tolist()
        [[0.0, 0.0], [1.0, 1.0]]
    """
    closed = np.concatenate([p, p[:1]])
    far = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(closed, axis=0), axis=1))])
    at = (np.arange(count) + offset) / count * far[-1]
    return np.column_stack([np.interp(at, far, closed[:, k]) for k in range(2)])


def normals_along(p: Flat) -> Flat:
    """Return the unit normal at each point of a closed line, from its two neighbours.

    They point outwards where the line runs counterclockwise.

    Examples:
        >>> square = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
        >>> normals_along(square).tolist() == square.tolist()
        True
    """
    v = np.roll(p, -1, axis=0) - np.roll(p, 1, axis=0)
    n = np.column_stack([v[:, 1], -v[:, 0]])
    return n / np.linalg.norm(n, axis=1, keepdims=True)
