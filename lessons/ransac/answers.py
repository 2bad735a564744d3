"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

import math

import numpy as np

from workbench.exercise.model import Function, Mistake

NO_PLANE = np.full(4, np.nan)

# plane_from_points ----------------------------------------------------------------------------------------------------


def area_normal(p: np.ndarray) -> np.ndarray:
    """Return the cross product of two sides: along the normal, and twice the area long."""
    return np.cross(p[1] - p[0], p[2] - p[0])


def on_one_line(p: np.ndarray) -> bool:
    """Tell whether points determine no plane."""
    longest = max(np.linalg.norm(p[i] - p[j]) for i, j in ((0, 1), (1, 2), (2, 0)))
    return bool(np.linalg.norm(area_normal(p)) <= 1e-9 * longest**2)


def unit(v: np.ndarray) -> np.ndarray:
    """Return a vector at length one."""
    return v / np.linalg.norm(v)


def through(normal: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the plane with a normal through a point."""
    return np.append(normal, -normal @ p)


def not_normalised(p: np.ndarray) -> np.ndarray:
    """Leaves the normal as long as the cross product."""
    return NO_PLANE if on_one_line(p) else through(area_normal(p), p[0])


def all_four_normalised(p: np.ndarray) -> np.ndarray:
    """Divides a, b, c and d by the length of all four."""
    return NO_PLANE if on_one_line(p) else unit(through(area_normal(p), p[0]))


def d_left_long(p: np.ndarray) -> np.ndarray:
    """Normalises the normal after d was computed with the long one."""
    return NO_PLANE if on_one_line(p) else np.append(unit(area_normal(p)), -area_normal(p) @ p[0])


def sign_of_d(p: np.ndarray) -> np.ndarray:
    """Takes n . p for d."""
    return NO_PLANE if on_one_line(p) else np.append(unit(area_normal(p)), unit(area_normal(p)) @ p[0])


def d_forgotten(p: np.ndarray) -> np.ndarray:
    """Lets every plane go through the origin."""
    return NO_PLANE if on_one_line(p) else np.append(unit(area_normal(p)), 0.0)


def points_for_sides(p: np.ndarray) -> np.ndarray:
    """Multiplies two points instead of two sides."""
    return NO_PLANE if on_one_line(p) else through(unit(np.cross(p[0], p[1])), p[0])


def side_for_normal(p: np.ndarray) -> np.ndarray:
    """Takes a direction in the plane, the first row of the SVD, for the one at a right angle to it, the last."""
    return NO_PLANE if on_one_line(p) else through(np.linalg.svd(p - p.mean(0))[2][0], p.mean(0))


def height_over_the_floor(p: np.ndarray) -> np.ndarray:
    """Solves z = a x + b y + c, which no wall satisfies."""
    if on_one_line(p):
        return NO_PLANE
    a, b, c = np.linalg.solve(np.column_stack([p[:, :2], np.ones(3)]), p[:, 2])
    return np.array([-a, -b, 1.0, -c]) / np.linalg.norm([a, b, 1.0])


def d_set_to_one(p: np.ndarray) -> np.ndarray:
    """Solves a x + b y + c z = -1, which no plane through the origin satisfies."""
    if on_one_line(p):
        return NO_PLANE
    normal = np.linalg.solve(p, -np.ones(3))
    return np.append(normal, 1.0) / np.linalg.norm(normal)


def line_not_seen(p: np.ndarray) -> np.ndarray:
    """Divides by whatever area there is."""
    return through(unit(area_normal(p)), p[0])


def fixed_smallest_area(p: np.ndarray) -> np.ndarray:
    """Compares the cross product with a fixed number."""
    return NO_PLANE if np.linalg.norm(area_normal(p)) < 1e-5 else through(unit(area_normal(p)), p[0])


def line_refused(p: np.ndarray) -> np.ndarray:
    """Raises where nan is asked for."""
    if on_one_line(p):
        raise ValueError("the points are on one line")
    return through(unit(area_normal(p)), p[0])


def line_given_zeros(p: np.ndarray) -> np.ndarray:
    """Returns a plane of zeros where nan is asked for."""
    return np.zeros(4) if on_one_line(p) else through(unit(area_normal(p)), p[0])


def with_either_normal(name: str, function: Function, sentence: str) -> tuple[Mistake, Mistake]:
    """Return the mistake as it comes out with the sides multiplied in one order, and in the other."""
    return Mistake(name, function, sentence), Mistake(f"{name} (sides swapped)", lambda p: -function(p), sentence)


PLANE_MISTAKES = (
    *with_either_normal(
        "not normalised",
        not_normalised,
        "Your plane is right but its normal is not of length 1. Then |n . p + d| is no distance: it comes out multiplied by "
        "the normal's length, and so do the votes.",
    ),
    *with_either_normal(
        "all four normalised",
        all_four_normalised,
        "You divided by the length of (a, b, c, d). Only the normal (a, b, c) gets length 1: d is a distance and may be "
        "anything.",
    ),
    *with_either_normal(
        "d left long",
        d_left_long,
        "You normalised the normal but not d. Compute d = -n . p from the unit normal, or divide both by the same length.",
    ),
    *with_either_normal(
        "sign of d",
        sign_of_d,
        "Your d has the wrong sign: n . p + d = 0 at each point, so d = -n . p. Your plane is on the other side of the "
        "origin.",
    ),
    *with_either_normal(
        "d forgotten",
        d_forgotten,
        "Your normal is right, and your d is 0: that plane goes through the origin and not through the points. d = -n . p.",
    ),
    *with_either_normal(
        "points for sides",
        points_for_sides,
        "You took the cross product of points. It needs two sides, such as p[1] - p[0] and p[2] - p[0]: differences do not "
        "care where the origin is.",
    ),
    *with_either_normal(
        "side for normal",
        side_for_normal,
        "Your normal is a direction in the plane. Of the SVD of the centred points the last row, with the smallest singular "
        "value, is at a right angle to them.",
    ),
    *with_either_normal(
        "height over the floor",
        height_over_the_floor,
        "You solved z = a x + b y + c. A wall has no such equation. Take the cross product of two sides, which knows no up.",
    ),
    *with_either_normal(
        "d set to one",
        d_set_to_one,
        "You solved a x + b y + c z = -1, that is d = 1 before normalising. A plane through the origin has d = 0 and no "
        "such equation.",
    ),
    *with_either_normal(
        "line not seen",
        line_not_seen,
        "Points on one line get a plane that rounding chose. Return four nan where the cross product is tiny beside the "
        "squared longest side.",
    ),
    *with_either_normal(
        "fixed smallest area",
        fixed_smallest_area,
        "You compare the cross product with a fixed number, so small triangles are refused, or long lines let through. "
        "Compare it with the squared longest side.",
    ),
    Mistake(
        "line refused",
        line_refused,
        "You raise an error where the points are on one line. In RANSAC that happens by chance: return four nan, and the "
        "sample is passed over.",
    ),
    Mistake(
        "line given zeros",
        line_given_zeros,
        "You return zeros where the points are on one line. With n = 0 and d = 0 all points are at distance 0: such a plane "
        "wins every vote. Return four nan.",
    ),
)


def plane_by_svd(p: np.ndarray) -> np.ndarray:
    """Finds the direction in which the centred points do not extend; its largest entry is positive."""
    centre = p.mean(axis=0)
    _, s, Vt = np.linalg.svd(p - centre)
    if s[1] <= 1e-9 * s[0]:
        return np.full(4, np.nan)
    normal = Vt[2] * np.sign(Vt[2][np.argmax(np.abs(Vt[2]))])
    return np.append(normal, -normal @ centre)


def plane_by_hand(p: np.ndarray) -> list[float]:
    """Writes the cross product out, about the last point."""
    (ax, ay, az), (bx, by, bz) = (p[k] - p[2] for k in (0, 1))
    n = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
    size = max(ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz)
    length = math.sqrt(sum(c * c for c in n))
    if length <= 1e-9 * size:
        return [math.nan] * 4
    n = [float(c / length) for c in n]
    return [*n, -float(sum(c * x for c, x in zip(n, p[2], strict=True)))]


def plane_by_minors(p: np.ndarray) -> np.ndarray:
    """Takes the areas of the triangle's three shadows, one per axis."""
    q = p - p.mean(axis=0)
    sides = np.array([q[1] - q[0], q[2] - q[0]])
    shadows = [sides[:, axes] for axes in ([1, 2], [2, 0], [0, 1])]
    normal = np.array([s[0, 0] * s[1, 1] - s[0, 1] * s[1, 0] for s in shadows])
    length = np.sqrt(normal @ normal)
    if length <= 1e-9 * max(np.sum((p[i] - p[j]) ** 2) for i, j in ((0, 1), (0, 2), (1, 2))):
        return np.array([np.nan] * 4)
    normal = normal / length
    return np.concatenate([normal, [-(p @ normal).mean()]])


# count_inliers --------------------------------------------------------------------------------------------------------


def signed(plane: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the signed distances."""
    return p @ plane[:3] + plane[3]


def below_counts(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares the signed distance."""
    return int((signed(plane, p) <= inlier_distance).sum())


def above_only(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Leaves out the side from which the normal points away."""
    s = signed(plane, p)
    return int(((s >= 0) & (s <= inlier_distance)).sum())


def distance_squared(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares squared metres with metres."""
    return int((signed(plane, p) ** 2 <= inlier_distance).sum())


def limit_squared(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares metres with squared metres."""
    return int((np.abs(signed(plane, p)) <= inlier_distance**2).sum())


def limit_halved(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Takes the distance for the thickness of the layer."""
    return int((np.abs(signed(plane, p)) <= inlier_distance / 2).sum())


def offset_forgotten(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Lets the plane go through the origin."""
    return int((np.abs(p @ plane[:3]) <= inlier_distance).sum())


def offset_subtracted(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Takes d for the plane's distance along the normal."""
    return int((np.abs(p @ plane[:3] - plane[3]) <= inlier_distance).sum())


def outliers_counted(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Counts the others."""
    return int((np.abs(signed(plane, p)) > inlier_distance).sum())


def limit_left_out(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares with <."""
    return int((np.abs(signed(plane, p)) < inlier_distance).sum())


def along_the_height(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Measures straight up and down."""
    return int((np.abs(signed(plane, p) / plane[2]) <= inlier_distance).sum())


def to_the_foot(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Measures to the plane's point nearest to the origin."""
    return int((np.linalg.norm(p + plane[3] * plane[:3], axis=1) <= inlier_distance).sum())


def divided_by_all_four(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Divides by the length of (a, b, c, d)."""
    return int((np.abs(signed(plane, p)) / np.linalg.norm(plane) <= inlier_distance).sum())


def far_subtracted(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Counts whatever is not far, nan as well."""
    return len(p) - int((np.abs(signed(plane, p)) > inlier_distance).sum())


def share_returned(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> float:
    """Returns the share of inliers."""
    return float((np.abs(signed(plane, p)) <= inlier_distance).sum() / max(len(p), 1))


def mask_returned(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> np.ndarray:
    """Returns which points are inliers."""
    return np.abs(signed(plane, p)) <= inlier_distance


COUNT_MISTAKES = (
    Mistake(
        "below counts",
        below_counts,
        "You compare the signed distance: every point on the far side of the normal is negative and counts, however far it "
        "is. Take its absolute value.",
    ),
    Mistake(
        "above only",
        above_only,
        "You count the side of the normal only. The signed distance of a point just below the plane is negative: take its "
        "absolute value.",
    ),
    Mistake(
        "distance squared",
        distance_squared,
        "You compare squared distances with the inlier distance: square metres with metres. Square both or neither.",
    ),
    Mistake(
        "limit squared",
        limit_squared,
        "You square the inlier distance but not the distances: metres against square metres. Square both or neither.",
    ),
    Mistake(
        "limit halved",
        limit_halved,
        "You halve the inlier distance. It is how far a point may be on either side: the layer is twice as thick.",
    ),
    Mistake(
        "offset forgotten",
        offset_forgotten,
        "You left d out, so you count points near the parallel plane through the origin. The signed distance is n . p + d.",
    ),
    Mistake(
        "offset subtracted",
        offset_subtracted,
        "You subtract d: that is the plane on the other side of the origin. The signed distance is n . p + d.",
    ),
    Mistake("outliers counted", outliers_counted, "You count the points that are farther than the inlier distance."),
    Mistake(
        "limit left out",
        limit_left_out,
        "All is right but for points exactly on the limit: an inlier may be as far as the inlier distance, so <= and not <.",
    ),
    Mistake(
        "along the height",
        along_the_height,
        "You measure straight up and down. The distance to a slanted plane is shorter, at a right angle to it: |n . p + d|.",
    ),
    Mistake(
        "to the foot",
        to_the_foot,
        "You measure to one point of the plane, the one nearest to the origin. Only what is along the normal counts: "
        "|n . p + d|.",
    ),
    Mistake(
        "divided by all four",
        divided_by_all_four,
        "You divide by the length of (a, b, c, d). The length that matters is that of the normal (a, b, c), and it is 1.",
    ),
    Mistake(
        "far subtracted",
        far_subtracted,
        "You subtract the far points from all. A comparison with nan is always false, so what is nan counts as near: count "
        "the near ones.",
    ),
    Mistake(
        "share returned", share_returned, "You return the share of inliers. Return how many there are: a whole number."
    ),
    Mistake(
        "mask returned",
        mask_returned,
        "You return which points are inliers, one true or false each. Return how many there are: a whole number.",
    ),
)


def count_one_by_one(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Loops over the points."""
    a, b, c, d = plane
    near = 0
    for x, y, z in p:
        if abs(a * x + b * y + c * z + d) <= inlier_distance:
            near += 1
    return near


def count_in_homogeneous_coordinates(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Appends ones, squares both sides, and divides by the normal's length though it is 1."""
    p_h = np.column_stack([p, np.ones(len(p))])
    squares = (p_h @ plane) ** 2 / (plane[:3] @ plane[:3])
    return int(np.count_nonzero(squares <= inlier_distance**2))


# iterations_needed ----------------------------------------------------------------------------------------------------


def rounded_up(value: float) -> float:
    """Return a number of samples."""
    return max(1.0, float(np.ceil(value)))


def sample_size_forgotten(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Uses w for w^s."""
    return rounded_up(np.log1p(-confidence) / np.log1p(-inlier_ratio))


def outliers_for_inliers(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Uses 1 - w for w."""
    return rounded_up(np.log1p(-confidence) / np.log1p(-((1.0 - inlier_ratio) ** sample_size)))


def all_outliers(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Calls a sample spoilt only if all of its points are outliers."""
    return rounded_up(np.log1p(-confidence) / np.log((1.0 - inlier_ratio) ** sample_size))


def clean_for_spoilt(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Forgets the 1 - in the denominator."""
    return rounded_up(np.log1p(-confidence) / np.log(inlier_ratio**sample_size))


def confidence_for_its_rest(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Forgets the 1 - in the numerator."""
    return rounded_up(np.log(confidence) / np.log1p(-(inlier_ratio**sample_size)))


def turned_upside_down(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Divides the other way round."""
    return rounded_up(np.log1p(-(inlier_ratio**sample_size)) / np.log1p(-confidence))


def on_average(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Waits as long as a clean sample takes on average."""
    return rounded_up(1.0 / inlier_ratio**sample_size)


def rounded_down(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Cuts the fraction off."""
    return max(1.0, float(np.floor(np.log1p(-confidence) / np.log1p(-(inlier_ratio**sample_size)))))


def rounded_to_nearest(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Rounds to the nearest."""
    return max(1.0, float(np.round(np.log1p(-confidence) / np.log1p(-(inlier_ratio**sample_size)))))


def not_rounded(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Leaves the fraction."""
    return max(1.0, float(np.log1p(-confidence) / np.log1p(-(inlier_ratio**sample_size))))


def none_where_all_are_inliers(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Divides by log(0), which gives no sample at all."""
    clean = np.float64(inlier_ratio) ** sample_size
    return float(np.ceil(np.log1p(-confidence) / np.log1p(-clean)))


def no_inlier_not_seen(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Divides by log(1)."""
    clean = inlier_ratio**sample_size
    return 1 if clean == 1 else math.ceil(math.log(1 - confidence) / math.log1p(-clean))


def digits_lost(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Subtracts a tiny number from 1."""
    spoilt = 1.0 - inlier_ratio**sample_size
    if spoilt in (0.0, 1.0):
        return np.inf if spoilt else 1.0
    return rounded_up(np.log(1.0 - confidence) / np.log(spoilt))


NEEDED_MISTAKES = (
    Mistake(
        "sample size forgotten",
        sample_size_forgotten,
        "You use w itself. A sample is clean only if all of its points are inliers: that has probability w^s.",
    ),
    Mistake(
        "outliers for inliers",
        outliers_for_inliers,
        "You take the share of outliers for that of inliers: your numbers fall where there are more outliers. A clean "
        "sample has probability w^s.",
    ),
    Mistake(
        "all outliers",
        all_outliers,
        "You call a sample spoilt when all of its points are outliers, (1 - w)^s. One is enough: spoilt is whatever is not "
        "clean, 1 - w^s.",
    ),
    Mistake(
        "clean for spoilt",
        clean_for_spoilt,
        "You divide by log(w^s), the chance of a clean sample. It is the spoilt ones that must not go on: log(1 - w^s).",
    ),
    Mistake(
        "confidence for its rest",
        confidence_for_its_rest,
        "You take log(confidence). What may go wrong is the rest: all samples are spoilt with at most 1 - confidence.",
    ),
    Mistake(
        "turned upside down",
        turned_upside_down,
        "Your fraction is upside down: it is log(1 - confidence) over log(1 - w^s).",
    ),
    Mistake(
        "on average",
        on_average,
        "You return 1 / w^s: so long a clean sample takes on average. In about a third of all runs there is none by then; "
        "the confidence asks for more.",
    ),
    Mistake(
        "none where all are inliers",
        none_where_all_are_inliers,
        "Where all points are inliers you return 0, from a division by log(0). One sample must be drawn: answer 1.",
    ),
    Mistake(
        "rounded down",
        rounded_down,
        "You round down: with the fraction cut off the confidence is just missed. Round up.",
    ),
    Mistake(
        "rounded to the nearest",
        rounded_to_nearest,
        "You round to the nearest: in half of all cases the confidence is just missed. Round up.",
    ),
    Mistake("not rounded", not_rounded, "You leave a fraction. Nobody draws part of a sample: round up."),
    Mistake(
        "no inlier not seen",
        no_inlier_not_seen,
        "Where no point is an inlier you divide by log(1) = 0. No number of samples is enough then: return np.inf.",
    ),
    Mistake(
        "digits lost",
        digits_lost,
        "All is right until w^s is below 10⁻¹⁶: then 1 - w^s is 1 to the computer, and its log is 0. Use np.log1p(-w^s).",
    ),
)


def needed_with_math(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Uses Python's own logarithms and whole numbers."""
    clean = inlier_ratio**sample_size
    if clean == 0:
        return math.inf
    if clean == 1:
        return 1
    return math.ceil(math.log(1 - confidence) / math.log1p(-clean))


def needed_by_halving(inlier_ratio: float, sample_size: int, confidence: float) -> int | float:
    """Looks for the smallest number of samples that is enough, without dividing logarithms."""
    if inlier_ratio == 0.0:
        return np.inf
    if inlier_ratio == 1.0:
        return 1
    each = np.log1p(-np.exp(sample_size * np.log(inlier_ratio)))
    least, enough = 0, 1
    while enough * each > np.log(1.0 - confidence):
        least, enough = enough, 2 * enough
    while enough - least > 1:
        middle = (least + enough) // 2
        if middle * each > np.log(1.0 - confidence):
            least = middle
        else:
            enough = middle
    return enough
