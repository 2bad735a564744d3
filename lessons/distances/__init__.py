"""The distances lesson."""
