"""What a step says: what was just done, the number that changed, and in the end whether the motion
is right.
"""

import numpy as np

from lessons.epipolar.state import State
from workbench.algorithms.two_views import Followed, Related
from workbench.certain import sure
from workbench.geometry.motions import rotation_angle
from workbench.geometry.points.metrics import rms
from workbench.geometry.two_views.epipolar import epipoles, fundamental_from_cameras
from workbench.geometry.two_views.rectification import growth, torn
from workbench.numerals import angle, brief, coordinates, counted, fixed, length, percent, pixels
from workbench.scene import Caption

FLAT = 1e-9  # of the singular value before: what is left of one that was dropped


def caption(state: State) -> Caption:
    """Return the caption of a step."""
    result = state.now
    if isinstance(result, Followed):
        return Caption(_followed(state, result))
    if result.stage == "rectified":
        return _rectified(state, result)
    return Caption(
        {
            "equations": _equations,
            "rank three": _rank_three,
            "rank two": _rank_two,
            "refined F": _refined,
            "essential": _essential,
            "pose": _pose,
            "points": _points,
            "refined": _refined,
        }[result.stage](state, result)
    )


def to_lines(state: State) -> str:
    """Write how far matches are from their lines, and points without noise where they are known."""
    text = f"matches are {pixels(state.to_lines(state.views.matches))} from their lines (rms)"
    clean = state.to_lines(state.views.clean)
    return text if np.isnan(clean) else f"{text}, other points without noise {pixels(clean)}"


def off(state: State) -> str:
    """Write how far the motion is from the true one."""
    if state.moved:
        return (
            f"the rotation is {angle(state.turn_error)} off, the direction"
            f" {angle(state.direction_error)}"
        )
    return f"the rotation is {angle(state.turn_error)} off"


def _followed(state: State, ray: Followed) -> str:
    pixel = f"Pixel {coordinates(state.uv_first, 0)}"
    if ray.stage == "plane":
        return (
            f"{pixel}, its ray and the second camera's centre span a plane. It cuts the second"
            " picture in a line: whatever the depth, the partner is on it."
        )
    if ray.stage == "pencil":
        F = fundamental_from_cameras(state.views.K_first, state.views.K_second, sure(state.T_true))
        u, v, w = epipoles(F)[1]
        far = abs(w) * 1e6 < max(abs(u), abs(v))
        where = "at infinity" if far else f"at column {fixed(u / w, 0)}, row {fixed(v / w, 0)}"
        return (
            "Every pixel has such a plane, and all planes hold the baseline. So all lines meet in"
            f" one point, the epipole {where}, where the line between both centres meets the"
            " picture."
        )
    z = float(ray.depths[-1])
    uv = ray.uv_second[-1]
    where = "Infinitely far along its ray" if np.isinf(z) else f"{length(z)} deep along its ray"
    if np.isnan(uv).any():
        return f"{pixel}: {where} a point lies behind the second camera, which does not see it."
    text = f"{pixel}: {where} a point is seen at {coordinates(uv, 1)} in the second picture."
    if not state.moved:
        return (
            f"{text} It is this pixel at every depth: a camera that only turns sees the whole ray"
            " as one point."
        )
    return (
        text if np.isfinite(z) else f"{text} Here its line ends: at the vanishing point of the ray."
    )


def _equations(state: State, estimate: Related) -> str:
    n = len(state.views.matches)
    values = estimate.singular_values
    text = f"{counted(n, 'match', 'matches')}, as many equations for the nine numbers of F"
    text += (
        ", in coordinates about 0 and of size 1." if state.params.normalise else ", in raw pixels."
    )
    ratio = values[7] / values[0]
    share = percent(ratio) if ratio > 1e-4 else f"{brief(1e6 * ratio)} millionths"
    return (
        f"{text} The eighth singular value is {share} of the first: the smaller, the more answers"
        " fit nearly as well."
    )


def _rank_three(state: State, estimate: Related) -> str:
    s = np.linalg.svd(estimate.F)[1]
    if s[2] < FLAT * s[1]:
        return (
            "F has rank two already: without noise the equations need no more. The"
            f" {to_lines(state)}."
        )
    return (
        f"The vector of the smallest singular value is F, and {to_lines(state)}. But F has rank"
        " three: no point lies on all its lines."
    )


def _rank_two(state: State, estimate: Related) -> str:
    s = np.linalg.svd(estimate.F)[1]
    if not s[2] < FLAT * s[1]:
        return f"F still has rank three, and no epipole; {to_lines(state)}."
    return f"The smallest singular value of F is dropped, all lines meet: {to_lines(state)}."


def _refined(state: State, estimate: Related) -> str:
    unknowns = (
        "the seven numbers of F"
        if estimate.stage == "refined F"
        else "the five numbers of a motion"
    )
    text = f"Round {estimate.rounds} over {unknowns}: {to_lines(state)}"
    return text + ("." if np.isnan(state.turn_error) else f"; {off(state)}.")


def _essential(state: State, estimate: Related) -> str:
    first, second = sure(estimate.E_values)[:2]
    return (
        f"With K it is E = K′ᵀ F K. Its second singular value is {percent(second / first)} of its"
        " first; of a motion they are equal, so both become their mean."
    )


def _pose(state: State, estimate: Related) -> str:
    k = len(estimate.tested)
    n = len(state.views.matches)
    turn = angle(float(np.degrees(rotation_angle(estimate.tested[-1][:3, :3]))))
    return (
        f"Motion {k} of 4 that E allows, turned by {turn}: it puts {estimate.in_front[-1]:,} of"
        f" {n:,} points in front of both cameras."
    )


def _points(state: State, estimate: Related) -> str:
    n = len(state.views.matches)
    text = f"The motion with the most points in front is kept, {max(estimate.in_front):,} of {n:,}"
    if state.views.p_first is None or estimate.p_first is None or not state.moved:
        return f"{text}. The length of its baseline is made up: no picture tells it."
    miss = np.median(np.abs(state.length * estimate.p_first[:, 2] - state.views.p_first[:, 2]))
    medians = f"parallax is {pixels(state.parallax)}, depths are {length(float(miss))} off"
    text = f"{text}: {off(state)}. In the median {medians} with the baseline's true length"
    return f"{text}. Noise is {pixels(state.params.noise)}."


def _rectified(state: State, estimate: Related) -> Caption:
    text = _rows(state, estimate)
    if state.right is None:
        return Caption(text)
    if not state.moved:
        made_up = (
            "The camera only turned: there is no direction, and the one of this motion is made up."
        )
        return Caption.verdict(f"{text} {made_up}", right=False, settled=False)
    off = f"{angle(state.turn_error)} in rotation and {angle(state.direction_error)} in direction"
    if state.right:
        return Caption.verdict(f"{text} The motion is {off} from the true one: right.", right=True)
    return Caption.verdict(
        f"{text} The motion is {off} from the true one.", right=False, settled=False
    )


def _rows(state: State, estimate: Related) -> str:
    rectification = estimate.rectification
    sizes = state.views.sizes
    if rectification is None:
        return (
            "The baseline runs along the optical axes: no turn of the cameras makes rows"
            " correspond."
        )
    Hs = rectification.H_first, rectification.H_second
    if any(torn(H, size) for H, size in zip(Hs, sizes, strict=True)):
        return (
            "Turned to the baseline, a picture would be torn: a part of it would look backwards. No"
            " rows correspond."
        )
    text = (
        f"Both cameras turned: matched rows are {pixels(rms(sure(state.disparities)[:, 1]))} apart"
        " (rms)"
    )
    times = max(growth(H, size) for H, size in zip(Hs, sizes, strict=True))
    if times > 3:
        text += f", in pictures {brief(times, 2)} times as large"
    if rotation_angle(rectification.R_rectified_first) > np.pi / 2:
        text += (
            "; they are upside down, turned by"
            f" {angle(float(np.degrees(rotation_angle(rectification.R_rectified_first))))}"
        )
    return f"{text}."
