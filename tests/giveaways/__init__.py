"""Per lesson, what `tests.spoilers` cannot know: the sentences that would tell an answer, and what
its rules misread.

A lesson's module has `GIVEAWAYS`, for every question of the lesson patterns of the sentences that
would tell its answer, and where the rules misread a text `INNOCENT`, for a question the pattern of
it.
"""
