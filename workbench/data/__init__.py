"""Seeded synthetic data, and readers for files that people bring."""
