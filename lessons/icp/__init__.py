"""Match, fit, repeat."""
