"""Words and numbers as a page shows them: typeset text and axes.

- `typeset`: turns a lesson's page.md into HTML with typeset maths, for the live page and for
  published ones.
- `axis`: how numbers are laid on an axis: what counts as zero, where the axis ends, its ticks,
  and their words. For every home.
"""
