"""The representations lesson."""
