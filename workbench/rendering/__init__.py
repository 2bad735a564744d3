"""Scenes as pixels, without a browser or a graphics card: a lens, what is drawn as plain shapes,
and a raster with a depth for each pixel.
"""
