"""The graphs lesson."""
