"""What the stage `space` looks like: two clouds, some of their bands, three directions in each."""

import numpy as np

from lessons.pairs.inputs import Input
from lessons.pairs.space import HOME_DEGREES, SHARES, SIGMAS, Scans, State
from workbench.captions import counted, degrees, metres, number
from workbench.captions import fixed as decimals
from workbench.data.thinning import every
from workbench.geometry.motions import apply, rotation_angle
from workbench.geometry.polylines import between
from workbench.lesson import Look, say
from workbench.numerals import angle, brief
from workbench.scene import (
    Caption,
    Chart,
    Classes,
    Color,
    Label,
    Points,
    Primitive,
    Role,
    Scene,
    Segments,
)

COLORS: tuple[Role, Role, Role] = ("x", "y", "z")
REACH = 2.5  # standard deviations that a direction is drawn long, to either side
MOST_BANDS, MOST_MISSES = 80, 40
CM2 = 1e4  # square centimetres in a square metre
NAMES = {"least": "weakest", "middle": "middle", "largest": "strongest"}
RMSE, TURN = Chart("RMSE", unit="m"), Chart("Rotation error", unit="deg")
FOUND = Chart("Scale", unit="×")
OF_H = Chart("Strength of each direction", "direction", "strength (cm²)")
PRICE = Chart("Price of a flip", "direction", "added to RMSE² (cm²)")
SCALE = Chart("Scale found", "noise of each coordinate", "×", x_range=(0.0, 0.1), x_unit="m")
WRONG = Chart(
    "Error of the turn", "share of wrong partners", "deg", x_range=(0.0, 90.0), x_unit="%"
)
PLACES = {"pairs": "pairs", "centre": "middles", "cross": "matrix", "flip": "mirror?"}


def draw(look: Look[Input, Scans, State]) -> Scene:
    """Return the picture of one step."""
    scans = look.subject
    fit = look.now.now
    T = np.eye(4) if fit.stage == "pairs" else scans.T_world_target @ fit.T_target_source
    mirrored = bool(np.linalg.det(fit.T_target_source[:3, :3]) < 0)
    scene = _clouds(scans, T, mirrored) | _bands(scans, T)
    if fit.U is not None and fit.V is not None and fit.D is not None:
        reach = REACH * np.sqrt(np.maximum(fit.D, 1e-4))
        middle = scans.p_source.mean(axis=0)
        scene |= _lines("directions", middle, fit.V * reach, T=T, strength=fit.D)
        if fit.stage in ("cross", "in"):  # later they lie on each other
            target_middle = scans.p_target.mean(axis=0)
            T_target = scans.T_world_target
            scene |= _lines(
                "target directions", target_middle, fit.U * reach, T=T_target, strength=None
            )
    if fit.stage in ("flip", "scale"):
        scene |= _missed(scans, look.now, T)
    return scene | _charts(look) | {"caption": caption(look)}


def _clouds(scans: Scans, T: np.ndarray, mirrored: bool) -> dict[str, Primitive]:
    radius = float(np.clip(0.3 / np.sqrt(len(scans.p_source)), 0.003, 0.012))
    role: Role = "wrong" if mirrored else "source"
    name = "second scan as a mirror image" if mirrored else "second scan"
    target: Color = "target"
    if scans.is_wrong.any() and not scans.own:
        target = Classes.marking(
            scans.is_wrong, "wrong", "wrong partners", others=("target", "first scan")
        )
    return {
        "target": Points(scans.p_target, target, radius, scans.T_world_target, name="first scan"),
        "source": Points(scans.p_source, role, radius, T, name=name),
    }


def _bands(scans: Scans, T: np.ndarray) -> dict[str, Primitive]:
    rows = every(len(scans.p_source), MOST_BANDS)
    ends = between(
        apply(T, scans.p_source[rows]), apply(scans.T_world_target, scans.p_target[rows])
    )
    color: Color = "correspondence"
    if scans.is_wrong.any():
        color = Classes.marking(
            scans.is_wrong[rows], "wrong", "wrong bands", others=("correspondence", "some bands")
        )
    return {"bands": Segments(ends, color, 1.5, name="some of the bands")}


def _lines(
    path: str, p: np.ndarray, axes: np.ndarray, *, T: np.ndarray, strength: np.ndarray | None
) -> dict[str, Primitive]:
    """Return three lines through a point along the columns of a matrix, each with its strength."""
    ends = between(p - axes.T, p + axes.T)
    scene = dict[str, Primitive]()
    for k in range(3):
        opacity = 0.4 if strength is None else 1.0
        scene[f"{path}/{k + 1}"] = Segments(ends[[k]], COLORS[k], 4, T, opacity)
        if strength is not None:
            words = f"{brief(CM2 * strength[k])} cm²"
            scene[f"{path}/{k + 1} name"] = Label(words, 1.06 * ends[k, 1] - 0.06 * p, COLORS[k], T)
    return scene


def _missed(scans: Scans, state: State, T: np.ndarray) -> dict[str, Primitive]:
    """Return lines from where some points lie to where they belong, and how far the turn is off."""
    off = scans.degrees_off(state.now.T_target_source)
    if scans.T_target_source is None or not np.isfinite(off):
        return {}
    p = scans.p_source[every(len(scans.p_source), MOST_MISSES)]
    true = apply(scans.T_world_target @ scans.T_target_source, p)
    shown = (T, scans.p_source), (scans.T_world_target, scans.p_target)
    high = max(float(np.percentile(apply(T_here, q)[:, 2], 99)) for T_here, q in shown)
    home = off < HOME_DEGREES
    top = np.array([scans.T_world_target[0, 3], 0.0, high + 0.2])
    scene: dict[str, Primitive] = {
        "off": Label(f"{angle(off)} from the truth", top, "truth" if home else "wrong")
    }
    if not home:
        ends = between(apply(T, p), true)
        scene["missed"] = Segments(ends, "wrong", 1.5, opacity=0.8, name="to where points belong")
    return scene


def _charts(look: Look[Input, Scans, State]) -> dict[str, Primitive]:
    scans, state, params = look.subject, look.now, look.params
    fit = state.now
    begun = state.now.stage != "pairs"
    off = scans.degrees_off(fit.T_target_source) if begun else np.nan
    scene: dict[str, Primitive] = {
        "rmse": RMSE.scalar(fit.rmse if begun else np.nan, "RMSE of the pairs"),
        "rotation error": TURN.scalar(off, "rotation error", "truth"),
    }
    if scans.scales:
        scene["scale"] = FOUND.scalar(np.nan if fit.scale is None else fit.scale, "scale")
    if fit.D is not None:
        three = np.arange(1.0, 4.0)
        scene["strength"] = OF_H.bars(three, CM2 * fit.D, "singular value of H")
        if scans.mirrored:
            scene["price"] = PRICE.bars(three, 4.0 * CM2 * fit.D, "4 × its singular value", "wrong")
    if scans.scales:
        forth, back = scans.scales["there"], scans.scales["back"]
        at = params.noise
        scene |= {
            "scale/there": SCALE.whole(SIGMAS, forth, "orange to blue", "source"),
            "scale/back": SCALE.whole(SIGMAS, 1.0 / back, "1 over blue to orange", "target"),
            "scale/truth": SCALE.second(
                SIGMAS, np.full(len(SIGMAS), params.scale), "truth", "truth"
            ),
            "scale/mark": SCALE.mark(
                at, float(np.interp(at, SIGMAS, forth)), "here", "source", knob="noise"
            ),
        }
    if scans.off and fit.stage in ("flip", "scale"):
        at = params.wrong
        chosen = scans.off[params.mistakes if at else "shuffled"]
        scene |= {
            "wrong/shuffled": WRONG.whole(SHARES, scans.off["shuffled"], "shuffled", "source"),
            "wrong/together": WRONG.whole(
                SHARES, scans.off["together"], "all to one side", "wrong"
            ),
            "wrong/mark": WRONG.mark(
                at, float(np.interp(at, SHARES, chosen)), "here", "source", knob="wrong"
            ),
        }
    return scene


def caption(look: Look[Input, Scans, State]) -> Caption:
    """Return what just happened, with the number that changed."""
    scans = look.subject
    state = look.now
    fit = look.now.now
    place = PLACES.get(fit.stage, fit.stage)
    rmse = metres(fit.rmse)
    if fit.stage == "pairs":
        n = counted(len(scans.p_source), "pair")
        if not scans.is_wrong.any():
            return say("{n}: each point knows its partner.", n=n, place=place)
        wrong = int(np.count_nonzero(scans.is_wrong))
        return say("{n}, {wrong} of them wrong.", n=n, wrong=wrong, place=place)
    if fit.stage == "centre":
        return say("Middle on middle: RMSE {rmse}.", rmse=rmse, place=place)
    if fit.D is None or fit.V is None:
        raise AssertionError(fit.stage)
    if fit.stage == "cross":
        a, b, c = (number(CM2 * value) for value in fit.D)
        return say(
            "Three directions in each scan, held with {a}, {b} and {c} cm².",
            a=a,
            b=b,
            c=c,
            place=place,
        )
    if fit.stage == "in":
        turn = degrees(np.degrees(rotation_angle(fit.V.T)))
        words = "Vᵀ turns orange by {turn}, its directions onto x, y and z: RMSE {rmse}."
        return say(words, turn=turn, rmse=rmse, place=place)
    if fit.stage == "out":
        off = scans.degrees_off(fit.T_target_source)
        if fit.mirror:
            words = "The RMSE is {rmse}, but the determinant is −1: a mirror image."
            return say(words, rmse=rmse, place=place)
        words = "U turns on to the directions of blue: RMSE {rmse}"
        if not np.isfinite(off):
            return say(f"{words}.", rmse=rmse, place=place)
        return say(f"{words}, the turn {{off}} off.", rmse=rmse, off=degrees(off, 2), place=place)
    off = scans.degrees_off(fit.T_target_source)
    if fit.stage == "flip" and np.isfinite(off):
        words = "The determinant is +1. The turn is {off} off, RMSE {rmse}."
        return say(words, off=degrees(off), rmse=rmse, place=place)
    if fit.stage == "flip":
        return say(_of_flip(look), rmse=rmse, place=place)
    return _of_scale(scans, state)


def _of_flip(look: Look[Input, Scans, State]) -> str:
    if not look.now.now.mirror:
        return "The determinant is +1: RMSE {rmse}."
    flip = look.params.flip
    if flip == "none":
        return "Nothing is flipped, so it stays a mirror image: RMSE {rmse}."
    if flip == "whole":
        return "All three directions are flipped: RMSE {rmse}."
    return f"The {NAMES[flip]} direction is flipped: RMSE {{rmse}}."


def _of_scale(scans: Scans, state: State) -> Caption:
    fit = state.now
    assert fit.scale is not None
    scale = decimals(fit.scale, 3)
    rmse = metres(fit.rmse)
    off = scans.degrees_off(fit.T_target_source)
    if not np.isfinite(off):
        return say(
            "Scale {there} by least squares, RMSE {rmse}.", there=scale, rmse=rmse, place="scale"
        )
    words, tone = "The scale is {there}, and the turn is {off} off.", "wrong"
    if scans.at_home(fit.T_target_source, fit.scale):
        tone = "good"
    elif off < HOME_DEGREES:
        words = "The scale is {there} instead of {true}."
    values = {"there": scale, "true": number(scans.true_scale), "off": degrees(off, 2)}
    values = {name: value for name, value in values.items() if f"{{{name}}}" in words}
    return say(words, tone=tone, **values, place="scale")
