"""Checks that run where a class is graded, by exercise: what is published leaves this out."""
