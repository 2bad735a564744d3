"""Closed-form maths on arrays: no state, no steps, no display."""
