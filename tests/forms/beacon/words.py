"""The sentences of the steps."""

from workbench.scene import Caption

from .state import State


def caption(state: State) -> Caption:
    """Say what the last fix changed, with its numbers."""
    n, share = len(state.p), state.w[-1] / state.w.sum()
    if n == 1:
        return Caption(f"One fix is the estimate: {1000 * state.error:.0f} mm from the beacon.")
    return Caption(
        f"Fix {n} has {100 * share:.1f} % of all weight. The estimate is {1000 * state.error:.0f}"
        " mm from the beacon."
    )
