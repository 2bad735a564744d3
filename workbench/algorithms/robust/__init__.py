"""Robust estimation: models, samples, scores, and losses that bound what an outlier does.

- `estimators`: fits that use all points at once, and trust each by its distance.
- `ransac`: guess a model from few points, count who agrees, keep the best, refit it.
- `models`: what can be fitted, each as the five functions that both need.
- `samplers`: which points to try next, and when to stop.
- `scores`: how good a candidate is.
- `camera_model`: a camera's motion as a model.
"""

from workbench.algorithms.robust.estimators import (
    CAUCHY,
    GEMAN_MCCLURE,
    HUBER,
    LOSSES,
    SQUARES,
    TUKEY,
    Loss,
    Reweighted,
    Settled,
    Trusted,
    cascade,
    huber_loss,
    huber_weights,
    reweighted_fit,
)

__all__ = [
    "CAUCHY",
    "GEMAN_MCCLURE",
    "HUBER",
    "LOSSES",
    "SQUARES",
    "TUKEY",
    "Loss",
    "Reweighted",
    "Settled",
    "Trusted",
    "cascade",
    "huber_loss",
    "huber_weights",
    "reweighted_fit",
]
