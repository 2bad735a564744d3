"""Decides what the lesson on Chamfer and earth mover's says: by whole distance matrices and scipy's
plain assignment.
"""

from lessons.chamfer_emd import blurred, bunch, far_dot, twelve
from lessons.chamfer_emd.captions import caption as caption_of_flows
from lessons.chamfer_emd.state import Clouds, state_of
from tests.truths import decided
from tests.verdicts import Run
from tests.verdicts.chamfer_emd.captions import CAPTIONS
from tests.verdicts.chamfer_emd.texts import LINES, WHYS
from tests.verdicts.chamfer_emd.values import (
    VALUES,
    chamfer,
    index_mse,
    larger,
    measured,
    moving,
    out_of_place,
)
from workbench.lesson import Look
from workbench.scene import Caption

__all__ = ["CAPTIONS", "LINES", "VALUES", "WHYS", "caption", "right"]

CAPTIONS_OF = {
    twelve.Twelve: lambda look: twelve.caption(look.params, look.now),
    bunch.Rings: lambda look: bunch.caption(look.now),
    far_dot.Ring: lambda look: far_dot.caption(look.now),
    blurred.Pairs: lambda look: blurred.caption(look.now),
    Clouds: lambda look: caption_of_flows(state_of(look)),
}


def caption(look: Look) -> Caption:
    """Return the caption alone, without the picture."""
    return CAPTIONS_OF[type(look.subject)](look)


def ranks_differ(run: Run) -> bool:
    p = moving(run, 0, "left")
    other = larger(run)
    return (chamfer(p, run) < chamfer(other, run)) != (
        measured(p, run)[2] < measured(other, run)[2]
    )


def blind(run: Run) -> bool:
    """Whether some number of the start says "equal" or "closer" of clouds that are not."""
    p = moving(run, 0, "left")
    to_target, to_source, moved, _ = measured(p, run)
    one_way = {"source to target": to_target, "target to source": to_source}.get(
        run.params.lowers, 1.0
    )
    return (
        ranks_differ(run)
        or (to_target + to_source == 0 and (moved > 0 or index_mse(run) > 0))
        or one_way == 0 < moved
    )


def right(run: Run, k: int) -> bool | None:
    if run.params.stage != "flows":
        return None
    if k == 0:
        return not blind(run)
    left, other = out_of_place(run, k, "left"), out_of_place(run, k, "right")
    return decided(left < 0.15 and other < 0.15, wrong=left > other + 0.05)
