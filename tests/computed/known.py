"""Runs that tell something else in Pyodide than on a machine of 64 bits, each with its reason.

Sums are rounded in another order there (other instructions, another BLAS). What is decided by a
tie, or grows from a rounding, comes out otherwise; nothing of it is a defect of the lesson.
"""

SIGN = "a basis of equal eigenvalues is not determined"
PIECES = "a vector with one value on each piece: rounding puts the nodes of a piece in order"
LOWEST = "at the lowest error already: rounding decides whether another step lowers it"
GROWN = "training: a rounding grows over hundreds of updates"
DIVERGES = "steps that jump: a rounding grows from jump to jump"
HALF = "a number of which half a unit is left to round"
CHANCE = "two of 2,000 matches are as near as others: RANSAC has other pairs to draw from"

DIFFERENT = {
    "epipolar forward": HALF,
    "epipolar refined-f": HALF,
    "epipolar sideways": HALF,
    "epipolar wrong-f": HALF,
    "features random": CHANCE,
    "fitting basin": DIVERGES,
    "fitting basin-jumps": DIVERGES,
    "fitting jumps": DIVERGES,
    "graphs cotangent": SIGN,
    "graphs sphere": SIGN,
    "graphs split": PIECES,
    "learning euler": GROWN,
    "learning mean": GROWN,
    "learning quaternion-matrix": GROWN,
    "pose frontal": LOWEST,
    "pose marker": LOWEST,
    "pose tiny": LOWEST,
    "representations neural": GROWN,
    "representations plain": GROWN,
    "representations rabbit": GROWN,
    "transforms columns": HALF,
}
"""The reason by lesson and run."""

VERSIONS = "numpy 2.0 raises another error for the covariance of no points than later ones"
BOUND = "a wrong answer that is right by chance, or fails by it: rounding decides which"

OTHERWISE_JUDGED = {
    "meet wrong_solver": BOUND,
    "principal_axes right_np_cov": VERSIONS,
    "principal_axes wrong_cov_by_expectation": BOUND,
    "pose_from_distances wrong_no_determinant": BOUND,
    "choose_pose wrong_first_three": BOUND,
}
"""The reason by exercise and solution; that of VERSIONS goes with Pyodide 0.27."""
