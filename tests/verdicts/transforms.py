"""What the transforms lesson says of its maps, held against plain products of matrices."""

import itertools
import re
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from lessons.transforms.captions import caption_of_build, caption_of_move
from lessons.transforms.state import Built, Moved
from tests.readings import LENGTH, NUMBER, close, number, says, says_length
from tests.truths.transforms import (
    SMALL,
    apart,
    at_best,
    complete_at,
    corner_angles,
    cross_ratio,
    edges_of,
    farthest,
    fronts,
    left_after_undo,
    lengths,
    mapped,
    met,
    motion_of,
    moved_by,
    outer_axes_apart,
    poses,
    product,
    readings,
    rigid,
    rotation_of,
    squares,
    turn_between,
    turned,
    volume,
    volumes,
    wrong_undo,
)
from tests.verdicts import Claim, Run
from workbench.scene import Caption


def caption(state: Any) -> Caption:
    return caption_of_build(state) if isinstance(state, Built) else caption_of_move(state)


def right(run: Run, k: int) -> bool | None:
    """A build is right where what it shows as done is so; a move at its end, rigid and by the
    shortest turn.
    """
    state = run.states[k]
    if isinstance(state, Moved):
        if np.abs(volumes(run, k)[-1] - 1) > SMALL:
            return False
        if k < len(run.states) - 1:
            return None
        shortest = turn_between(*poses(run.params))
        return bool(
            met(run) and np.ptp(volumes(run, k)) < SMALL and turned(run, k).sum() < shortest + 0.1
        )
    if state.factor.kind == "undo":
        wrong = state.ghosts and farthest(*wrong_undo(run), state.body.solid.p) > SMALL
        return bool(left_after_undo(run) < SMALL and not wrong)
    if k == complete_at(run) and run.params.compare == "direction with w = 1":
        return bool(np.linalg.norm(np.subtract(*fronts(run, k))) < SMALL)
    return True


# The sentences ------------------------------------------------------------------------------------


def _start(run: Run, k: int, m: re.Match[str]) -> bool:
    p = run.states[0].body.solid.p
    return (
        k == 0
        and number(m[1]) == len(p)
        and says(m[2], volume(run, 0), 3)
        and np.array_equal(run.states[0].T, np.eye(4))
    )


def _scaled(run: Run, k: int, m: re.Match[str]) -> bool:
    change = np.abs(lengths(run, k) / lengths(run, k - 1) - 1).max()
    return says(m[1], 100 * change, 3) and says(m[2], float(np.prod(run.params.scale)))


def _sheared(run: Run, k: int, m: re.Match[str]) -> bool:
    return (
        says(m[1], float(np.abs(corner_angles(run, k) - corner_angles(run, k - 1)).max()))
        and says(m[2], float(np.linalg.det(product(run, k))))
        and close(volume(run, k), volume(run, k - 1))
    )


def _divided(run: Run, k: int, m: re.Match[str]) -> bool:
    p, T = run.states[0].body.solid.p, product(run, k)
    a, b = mapped(product(run, k - 1), p)[edges_of(run)].transpose(1, 0, 2)
    ends = [mapped(run.states[k].factor.matrix, q) for q in (a, 0.3 * a + 0.7 * b, b)]
    straight = np.abs(np.cross(ends[1] - ends[0], ends[2] - ends[0])).max() < SMALL
    return bool(straight) and says(m[1], apart(run, k)) and not close(T[3], (0, 0, 0, 1))


def _mirrored(run: Run, k: int, m: re.Match[str]) -> bool:
    M = run.states[k].factor.matrix[:3, :3]
    return (
        close(M.T @ M, np.eye(3)) and says(m[1], float(np.linalg.det(M))) and np.linalg.det(M) < 0
    )


def _translated(run: Run, k: int, m: re.Match[str]) -> bool:
    far = moved_by(run, k)
    return says_length(m[1], float(far.max())) and np.ptp(far) < SMALL


def _turned(run: Run, k: int, m: re.Match[str]) -> bool:
    kept = np.abs(lengths(run, k) / lengths(run, k - 1) - 1).max() < SMALL
    same = np.abs(corner_angles(run, k) - corner_angles(run, k - 1)).max() < 1e-4
    M = run.states[k].factor.matrix[:3, :3]
    is_turn = close(M.T @ M, np.eye(3), atol=1e-12) and close(np.linalg.det(M), 1)
    return bool(kept and same and is_turn) and says_length(m[2], float(moved_by(run, k)[int(m[1])]))


def _locked(run: Run, k: int, m: re.Match[str]) -> bool:
    triple = tuple(number(part) for part in m[1].split(", "))
    same = close(
        rotation_of(run.params, triple), rotation_of(run.params, run.params.angles), atol=1e-9
    )
    return same and triple != run.params.angles and outer_axes_apart(run.params) < 0.01


def _beside(run: Run, k: int, m: re.Match[str]) -> bool:
    off = [distance for distance in readings(run) if distance >= SMALL]
    low, high = (
        (says_length(m[1], min(off)), says_length(m[2] or m[1], max(off)))
        if off
        else (False, False)
    )
    return low and high and k == complete_at(run)


def _count(run: Run, k: int, m: re.Match[str]) -> bool:
    found = readings(run)
    return (number(m[1]), number(m[2])) == (sum(distance < SMALL for distance in found), len(found))


def _all_same(run: Run, k: int, m: re.Match[str]) -> bool:
    return max(readings(run)) < SMALL and (m[1] is None or number(m[1]) == len(readings(run)))


def _front(run: Run, k: int, m: re.Match[str]) -> bool:
    v, w = fronts(run, k)
    return says(
        m[1], float(np.degrees(np.arccos(v @ w / np.linalg.norm(v) / np.linalg.norm(w)))), 2
    )


def _off(run: Run, k: int, m: re.Match[str]) -> bool:
    state, t = run.states[k], k / (len(run.states) - 1)
    origin = float(np.linalg.norm(state.T_world_body[:3, 3] - t * poses(run.params)[1][:3, 3]))
    on_path = origin < SMALL if m[2] is None else says_length(m[2], origin)
    off = turn_between(at_best(run, k), state.T_world_body)
    return on_path and (
        off < 1e-5 if m[1].startswith("on the") else says(m[1].split("°")[0], off, 2)
    )


def _gone(run: Run, k: int, m: re.Match[str]) -> bool:
    t = k / (len(run.states) - 1)
    return (
        says(m[1], t)
        and says(m[2], float(turned(run, k).sum()))
        and says(m[3], float(turned(run, k)[-1]))
    )


def _volume(run: Run, k: int, m: re.Match[str]) -> bool:
    R = run.states[k].T_world_body[:3, :3]
    return says(m[1], 100 * float(volumes(run, k)[-1]), 3) and not close(
        R.T @ R, np.eye(3), atol=1e-9
    )


def _best_of_all(run: Run, k: int, m: re.Match[str]) -> bool:
    """By squares: no rotation of a grid of them about the middle brings the mirrored house nearer
    than Kabsch's.
    """
    p, q = (
        run.states[0].body.solid.p,
        mapped(product(run, complete_at(run)), run.states[0].body.solid.p),
    )
    p, q = p - p.mean(axis=0), q - q.mean(axis=0)
    best = squares(run)
    tried = Rotation.random(400, rng=np.random.default_rng(0))
    return bool(all(((R.apply(p) - q) ** 2).sum() >= best - SMALL for R in tried))


def _stays(run: Run, k: int, m: re.Match[str]) -> bool:
    """The last body does not lie on the first, by the factors that are named, and has so much of
    its volume.
    """
    p, params = run.states[0].body.solid.p, run.params
    named = {
        "scale": params.scale != (1, 1, 1),
        "shear": params.shear != 0,
        "division by w": params.perspective != 0,
        "reflection": params.mirror != "none",
    }
    grown = abs(volume(run, k) / volume(run, 0))
    size = abs(grown - 1) < SMALL if m[2] is None else says(m[2], grown)
    apart_by = farthest(product(run, k), np.eye(4), p)
    return (
        m[1].split(" and the ") == [name for name, is_there in named.items() if is_there]
        and size
        and apart_by > 0.01
    )


CAPTIONS = (
    Claim("Beside it: best rigid motion", _best_of_all),
    Claim(
        rf"The \S+ before anything is done: ({NUMBER}) vertices, volume ({NUMBER}) m³; T is the"
        r" identity",
        _start,
    ),
    Claim(rf"edges change by up to ({NUMBER}) %, volumes × ({NUMBER})", _scaled),
    Claim(
        rf"angles change by up to ({NUMBER})°, yet det is ({NUMBER}): the volume stays", _sheared
    ),
    Claim(
        rf"straight edges stay straight, but edges that were parallel are now up to ({NUMBER})°"
        r" apart. The last row of T is"
        " no longer 0 0 0 1",
        _divided,
    ),
    Claim(
        rf"det is ({NUMBER}). Every length and angle is kept, but a left hand would now be a right"
        r" one; no rotation does"
        " that",
        _mirrored,
    ),
    Claim(rf"every point \(w = 1\) moved ({LENGTH}), every direction \(w = 0\) 0 m", _translated),
    Claim(rf"vertex (\d+) moved ({LENGTH}), and every length, angle and volume survived", _turned),
    Claim(
        "that is not at all: nothing moved", lambda run, k, m: bool(moved_by(run, k).max() < SMALL)
    ),
    Claim(
        r"Gimbal lock: angles 1 and 3 turn about one axis; \((.*?)\)° is the same rotation", _locked
    ),
    Claim(
        rf"(?<=, )farthest vertex ({LENGTH})(?: to ({LENGTH}))? off",
        lambda run, k, m: (
            _beside(run, k, m)
            and len(readings(run)) == sum(distance >= SMALL for distance in readings(run))
        ),
    ),
    Claim(rf"(?<=: )farthest vertex ({LENGTH})(?: to ({LENGTH}))? off", _beside),
    Claim(rf"({NUMBER}) of ({NUMBER}) the same", _count),
    Claim(rf"(?:all ({NUMBER}) )?the same motion", _all_same),
    Claim(rf"The front taken with w = 1 points ({NUMBER})° away from it", _front),
    Claim(
        rf"all ({NUMBER}) vertices are where they were before the motion",
        lambda run, k, m: (
            left_after_undo(run) < SMALL and number(m[1]) == len(run.states[0].body.solid.p)
        ),
    ),
    Claim(
        rf"The (.*?) came before it and stays?(?:, and with it the volume × ({NUMBER}))?\.", _stays
    ),
    Claim(
        rf"leaves its farthest vertex ({LENGTH}) off",
        lambda run, k, m: says_length(m[1], farthest(*wrong_undo(run), run.states[0].body.solid.p)),
    ),
    Claim(
        rf"[Tt]he shortest turn(?: to the end)? is ({NUMBER})°",
        lambda run, k, m: says(m[1], turn_between(*poses(run.params))),
    ),
    Claim(
        rf"t = ({NUMBER}) by .*: turned ({NUMBER})° so far, pose by pose, ({NUMBER})° of it in this"
        r" step",
        _gone,
    ),
    Claim(rf"the volume is ({NUMBER}) % of the start's, so this is no rotation", _volume),
    Claim(
        rf"((?:{NUMBER}° from|on) the shortest turn)(?:, its origin ({LENGTH}) from where lerp has"
        r" it)?",
        _off,
    ),
    Claim(
        rf"on the way the volume fell to ({NUMBER}) %",
        lambda run, k, m: says(m[1], 100 * float(volumes(run, k).min()), 3),
    ),
    Claim("The end is met", lambda run, k, m: met(run)),
)


def _order(run: Run, k: int, m: re.Match[str]) -> bool:
    return min(readings(run)) > 0.5


def _helix(run: Run, k: int, m: re.Match[str]) -> bool:
    """The origin climbs evenly along one line, at one distance from it."""
    start, end = poses(run.params)
    n = Rotation.from_matrix(end[:3, :3] @ start[:3, :3].T).as_rotvec()
    n /= np.linalg.norm(n)
    origins = np.array([state.T_world_body[:3, 3] for state in run.states])
    climb, flat = np.diff(origins @ n), origins - np.outer(origins @ n, n)
    c = np.linalg.lstsq(2 * np.diff(flat, axis=0), np.diff((flat**2).sum(axis=1)))[0]
    radius = np.linalg.norm(flat - c, axis=1)
    return bool(
        np.ptp(climb) < SMALL and abs(climb[0]) > 1e-3 and np.ptp(radius) < 1e-6 and radius[0] > 0.1
    )


def _squeezed(run: Run, k: int, m: re.Match[str]) -> bool:
    middle = run.states[(len(run.states) - 1) // 2]
    long, *short = np.linalg.svd(middle.T_world_body[:3, :3])[1]
    return bool(close(long, 1) and max(short) < 0.1) and close(
        turn_between(*poses(run.params)), 170
    )


def _layers(run: Run, k: int, m: re.Match[str]) -> bool:
    S, p = run.states[1].factor.matrix, run.states[0].body.solid.p
    moved = mapped(S, p) - p
    flat = (
        np.abs(moved[:, 2]).max() < SMALL
        and np.abs(np.diff(moved[np.argsort(p[:, 2]), 0]) >= -SMALL).all()
    )
    parallel = apart(run, 1) < 1e-4
    changed = np.abs(lengths(run, 1) / lengths(run, 0) - 1).max() > 0.05
    return bool(
        flat
        and parallel
        and changed
        and np.abs(corner_angles(run, 1) - corner_angles(run, 0)).max() > 5
    )


def _one_point(run: Run, k: int, m: re.Match[str]) -> bool:
    p = run.states[0].body.solid.p
    q = mapped(run.states[1].factor.matrix, p)
    meeting = np.array([0, 0, 1 / run.params.perspective])
    at_one = np.abs(np.cross(q[:4] - meeting, q[4:] - meeting)).max() < SMALL
    t = np.array([0.0, 1.0, 2.0, 4.0])[:, None] * [0.1, 0.02, 0.2] + [0.1, 0.1, 0.0]
    ratio = [cross_ratio(points) for points in (t, mapped(run.states[1].factor.matrix, t))]
    lost = np.abs(lengths(run, 1) / lengths(run, 0) - 1).max() > 0.05 and apart(run, 1) > 5
    return bool(at_one and lost and close(*ratio))


def _grown(run: Run, k: int, m: re.Match[str]) -> bool:
    p = run.states[0].body.solid.p
    size = np.ptp(mapped(wrong_undo(run)[0], p), axis=0) / np.ptp(p, axis=0)
    return close(size, 1.69) and run.params.scale == (1.3, 1.3, 1.3)


def _misread(run: Run, k: int, m: re.Match[str]) -> bool:
    w, x, y, z = np.cos(np.radians(20)), 0, 0, np.sin(np.radians(20))
    meant, got = (
        Rotation.from_quat([x, y, z, w]).as_rotvec(),
        Rotation.from_quat([w, x, y, z]).as_rotvec(),
    )
    ghost = run.states[complete_at(run)].ghosts[0].T[:3, :3]
    return (
        close(np.degrees(meant), (0, 0, 40))
        and close(np.degrees(got), (140, 0, 0))
        and close(Rotation.from_matrix(ghost).as_rotvec(), got)
    )


def _misses_by_more(run: Run, k: int, m: re.Match[str]) -> bool:
    t = float(np.linalg.norm(run.params.pose[:3]))
    quarter = abs(turn_between(np.eye(4), motion_of(run.params)) - 90) < SMALL
    off = farthest(*wrong_undo(run), run.states[0].body.solid.p)
    return quarter and says(m[1], off) and says(m[2], t) and off > t


def _pace(run: Run, k: int, m: re.Match[str]) -> bool:
    off = max(
        turn_between(at_best(run, j), state.T_world_body) for j, state in enumerate(run.states)
    )
    steps = turned(run, len(run.states) - 1)
    return off > 10 and steps.max() > 1.5 * steps.min()


def _steady(run: Run, k: int, m: re.Match[str]) -> bool:
    off = max(
        turn_between(at_best(run, j), state.T_world_body) for j, state in enumerate(run.states)
    )
    steps = turned(run, len(run.states) - 1)
    return off < SMALL and steps.max() < (1 + SMALL) * steps.min() and met(run)


LINES = {
    "order": (Claim("a rotation turns about the world's origin, so it swings along", _order),),
    "gimbal": (
        Claim(
            "The pose is reached all the same, even by a whole family of triples",
            lambda run, k, m: max(readings(run)) < SMALL and len(readings(run)) > 2,
        ),
    ),
    "conventions": (
        Claim(
            r"\(40, 30, 70\)° are four different rotations",
            lambda run, k, m: (
                run.params.angles == (40, 30, 70)
                and min(
                    turn_between(
                        rigid(rotation_of(None, run.params.angles, a), np.zeros(3)),
                        rigid(rotation_of(None, run.params.angles, b), np.zeros(3)),
                    )
                    for a, b in itertools.combinations(("xyz", "XYZ", "ZYX", "ZXZ"), 2)
                )
                > 5
            ),
        ),
    ),
    "fixed-own": (
        Claim(
            "xyz about fixed axes is ZYX about carried axes with the numbers in reverse",
            lambda run, k, m: readings(run)[0] < SMALL,
        ),
        Claim("XYZ with the same numbers is not", lambda run, k, m: readings(run)[1] > 0.1),
    ),
    "mirror": (
        Claim(
            "Every length and angle survives, yet det is −1",
            lambda run, k, m: bool(
                close(np.linalg.det(product(run, 1)), -1)
                and close(lengths(run, 1), lengths(run, 0))
            ),
        ),
        Claim(
            "the best of all rigid motions, by the sum of squared distances: it does not fit",
            lambda run, k, m: _best_of_all(run, k, m) and squares(run) > 0.1,
        ),
    ),
    "shear": (Claim("Each horizontal layer slides as it is, the higher the farther", _layers),),
    "perspective": (Claim("keeps straight lines straight.*run to one point", _one_point),),
    "transpose": (
        Claim(
            "80° from where it belongs",
            lambda run, k, m: close(
                turn_between(motion_of(run.params), run.states[complete_at(run)].ghosts[0].T), 80
            ),
        ),
    ),
    "inverse": (
        Claim(r"\(Rᵀ, −Rᵀt\) returns to the start", lambda run, k, m: left_after_undo(run) < SMALL),
        Claim(
            rf"this quarter turn \(Rᵀ, −t\) misses it by ({NUMBER}) m, farther than t is long"
            rf" \(({NUMBER}) m\)",
            _misses_by_more,
        ),
    ),
    "hidden-scale": (Claim("the house ends 1.3² = 1.69 times as long, wide and high", _grown),),
    "xyzw": (Claim("a turn of 40° about z has become one of 140° about x", _misread),),
    "direction": (
        Claim(
            "no longer points to the front",
            lambda run, k, m: float(np.linalg.norm(np.cross(*fronts(run, complete_at(run))))) > 0.1,
        ),
    ),
    "minus-q": (
        Claim(
            "still arrives, but turns 300° where 60° would do",
            lambda run, k, m: (
                met(run)
                and close(turned(run, k).sum(), 300)
                and close(turn_between(*poses(run.params)), 60)
            ),
        ),
        Claim(
            "the wrong one",
            lambda run, k, m: turned(run, k).sum() > turn_between(*poses(run.params)) + 1,
        ),
    ),
    "one-axis": (Claim("the body turns about it at constant speed", _steady),),
    "wobble": (Claim("the body leaves the shortest turn and changes its pace", _pace),),
    "average": (
        Claim(
            "Two headings, 20° apart",
            lambda run, k, m: bool(
                close(turn_between(*poses(run.params)), 20) and turned(run, k).sum() > 180
            ),
        ),
    ),
    "entries": (
        Claim("Each entry of the matrix runs evenly to that of a rotation 170° away", _squeezed),
    ),
    "screw": (
        Claim(
            "The origin follows a helix, not a straight line|the origin follows a helix, not a"
            " straight line",
            _helix,
        ),
    ),
}


def _two_directions(run: Run, k: int, m: re.Match[str]) -> bool:
    """As many as small changes of the angles reach, by finite differences."""
    R, tiny = rotation_of(run.params, run.params.angles), 1e-5
    J = [
        Rotation.from_matrix(
            rotation_of(run.params, tuple(np.array(run.params.angles) + tiny * e)) @ R.T
        ).as_rotvec()
        for e in np.eye(3)
    ]
    return number(m[1]) == np.sum(np.linalg.svd(J)[1] > 1e-3 * np.radians(tiny))


def _jump(run: Run, k: int, m: re.Match[str]) -> bool:
    here, there = (tuple(number(part) for part in text.split(", ")) for text in (m[1], m[2]))
    R, other = rotation_of(run.params, here), rotation_of(run.params, there)
    turn = turn_between(rigid(R, np.zeros(3)), rigid(other, np.zeros(3)))
    far = np.abs((np.subtract(there, here) + 180) % 360 - 180).max()
    return here == run.params.angles and abs(turn - 1) < 0.02 and far > 45


WHYS = {
    "which-order": (
        Claim(
            rf"({NUMBER}) m: turned last, .* are √2 · 1.5 m apart",
            lambda run, k, m: (
                says(m[1], readings(run)[0]) and close(readings(run)[0], 1.5 * np.sqrt(2))
            ),
        ),
    ),
    "lost-direction": (
        Claim(rf"({NUMBER}): angles 1 and 3 turn about the same line", _two_directions),
        Claim(r"needs a jump from \((.*?)\)° to \((.*?)\)°", _jump),
    ),
    "sheared-volume": (
        Claim(
            rf"It is ({NUMBER}) % of what it was.*det = ({NUMBER})",
            lambda run, k, m: (
                says(m[1], 100 * volume(run, 1) / volume(run, 0))
                and says(m[2], float(np.linalg.det(product(run, 1))))
            ),
        ),
    ),
    "mean-heading": (
        Claim(
            rf"({NUMBER})°: the number runs through 0°. The two headings are only ({NUMBER})°"
            r" apart",
            lambda run, k, m: (
                says(m[1], float(turned(run, k).sum()))
                and says(m[2], turn_between(*poses(run.params)))
            ),
        ),
    ),
    "mean-matrix": (
        Claim(
            rf"({NUMBER}) %: across the axis every length shrinks to cos 85° = 0.087",
            lambda run, k, m: (
                says(m[1], 100 * np.cos(np.radians(85)) ** 2)
                and says(m[1], 100 * float(volumes(run, 15)[-1]))
            ),
        ),
    ),
}
