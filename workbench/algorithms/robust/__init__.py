"""Robust estimation: models, samples, scores, and losses that bound what an outlier does.

- `estimators`: robust fits: they use all points at once, and trust each by its distance.
- `ransac`: RANSAC: guess a model from as few points as determine it, count who agrees, keep the
  best guess, refit it.
- `models`: what can be fitted robustly: kinds of model, each as the five functions that RANSAC
  and Huber's method need.
- `samplers`: which points to try next: by chance alone, or the most trusted first; and among how
  many of these to say when to stop.
- `scores`: how good a candidate is, from the distances of all points to it: more is better, for
  every score.
- `camera_model`: A camera's motion as a model for RANSAC: rows are a world point and its pixel,
  three give up to four estimates.
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
