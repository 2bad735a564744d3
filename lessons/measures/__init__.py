"""The measures lesson."""
