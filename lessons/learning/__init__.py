"""The learning lesson."""
