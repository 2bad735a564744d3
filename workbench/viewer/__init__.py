"""The live page: a server hears browsers, computes what they want, and sends it."""
