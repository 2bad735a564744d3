"""The exercises of the coordinates lesson."""
