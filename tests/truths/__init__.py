"""What is true of a lesson's run, by plain numpy and scipy: what its judge in `tests.verdicts`
holds its sentences to.
"""


def decided(right: bool, wrong: bool) -> bool | None:
    """Return what is claimed of a state that is truly right, truly wrong, or neither (None)."""
    if right:
        return True
    return False if wrong else None
