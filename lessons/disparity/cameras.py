"""Where the eye stands, for the lesson's pictures and the cameras that its story names."""

from workbench.lesson import View

VIEW = View(eye=(0.97, -3.73, 3.69), target=(-1.17, 0.77, 1.22), grid=None, axes=False)
FLAT = View(eye=(0.0, -3.2, 0.0), target=(0.0, 0.0, 0.0), grid=None, axes=False)
VIEWS = {"flat": FLAT, "scene": VIEW}
