"""Guess, count, keep the best."""
