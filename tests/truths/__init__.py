"""What is true of a lesson's run, by plain numpy and scipy: what its judge in `tests.verdicts`
holds its sentences to.
"""
