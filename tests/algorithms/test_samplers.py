import math
from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.robust.samplers import (
    draw_samples,
    prosac_samples,
    termination_length,
    uniform_samples,
)


@settings(max_examples=50, deadline=None)
@given(n=st.integers(2, 60), size=st.integers(2, 8), seed=st.integers(0, 99))
def test_a_sample_holds_different_rows(n, size, seed):
    if n < size:
        with pytest.raises(ValueError, match=f"needs {size}"):
            draw_samples(n, size, 5, rng=np.random.default_rng(seed))
        return
    samples = draw_samples(n, size, 40, rng=np.random.default_rng(seed))
    assert samples.shape == (40, size)
    assert samples.min() >= 0
    assert samples.max() < n
    assert all(len(set(sample)) == size for sample in samples.tolist())


@pytest.mark.parametrize("n", [8, 30])
def test_every_row_is_equally_likely(n):
    counts = np.bincount(
        draw_samples(n, 3, 20_000, rng=np.random.default_rng(0)).ravel(), minlength=n
    )
    expected = 20_000 * 3 / n
    assert np.abs(counts - expected).max() < 5 * np.sqrt(expected)


def test_uniform_samples_are_reproducible_and_endless():
    samples, two = (
        list(islice(uniform_samples(50, 4, np.random.default_rng(7)), 30)) for _ in range(2)
    )
    np.testing.assert_array_equal(samples, two)
    assert len({tuple(sample) for sample in np.array(samples).tolist()}) > 20


def test_prosac_starts_with_the_most_trusted_and_lets_the_others_in_by_rank():
    quality = np.random.default_rng(1).random(100)
    rank = np.argsort(np.argsort(-quality))
    samples = list(islice(prosac_samples(quality, 4, np.random.default_rng(0)), 400))
    worst = np.array([rank[sample].max() for sample in samples])
    assert worst[0] == 3
    assert (
        np.diff(worst[:20]) >= 0
    ).all()  # each of the first draws holds the newest row of the pool
    assert worst[:50].max() < worst[-50:].max()
    assert all(len(set(sample.tolist())) == 4 for sample in samples)


def test_prosac_becomes_uniform():
    quality = np.linspace(1, 0, 12)
    samples = np.array(
        list(islice(prosac_samples(quality, 3, np.random.default_rng(0), grown_after=50), 6000))
    )[500:]
    counts = np.bincount(samples.ravel(), minlength=12)
    expected = samples.size / 12
    assert np.abs(counts - expected).max() < 5 * np.sqrt(expected)


def test_prosac_finds_a_clean_sample_sooner_when_trust_means_something():
    needed = {"prosac": [], "uniform": []}
    for seed in range(30):
        rng = np.random.default_rng(seed)
        inlier = np.arange(200) < 60
        quality = rng.normal(np.where(inlier, 0.65, 0.4), 0.15)
        for name, samples in (
            ("prosac", prosac_samples(quality, 4, rng)),
            ("uniform", uniform_samples(200, 4, rng)),
        ):
            needed[name].append(
                next(t for t, sample in enumerate(samples, 1) if inlier[sample].all())
            )
    assert np.median(needed["prosac"]) < 0.2 * np.median(needed["uniform"])


@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 999),
    n=st.integers(4, 120),
    size=st.integers(2, 7),
    share=st.floats(0.0, 1.0),
)
def test_the_termination_length_is_the_papers(seed, n, size, *, share):
    """By the sums of its equations 7 to 9: the largest share that chance hardly gives, with all
    rows below twenty.
    """
    rng = np.random.default_rng(seed)
    inliers = rng.random(n) < share
    quality = rng.random(n)
    by_trust = inliers[np.argsort(-quality)]
    allowed = [(0.0, 0)]
    for k in range(min(20, n), n + 1):
        count = int(by_trust[:k].sum())
        tail = sum(
            math.comb(k - size, i) * 0.05**i * 0.95 ** (k - size - i)
            for i in range(max(count - size, 0), k - size + 1)
        )
        if k > size and count > size and tail < 0.05:
            allowed.append((count / k, k))
    best, length = max(allowed)
    assert termination_length(inliers, quality, size) == (length, pytest.approx(best))


def test_a_model_of_no_votes_ends_nothing():
    assert termination_length(np.zeros(50, bool), np.arange(50.0), 4) == (0, 0.0)
    # the sample itself is no evidence
    assert termination_length(np.arange(50) < 4, -np.arange(50.0), 4) == (0, 0.0)
    assert termination_length(np.ones(50, bool), np.arange(50.0), 4) == (50, 1.0)


def test_too_few_rows_are_refused():
    with pytest.raises(ValueError, match="only 2"):
        next(prosac_samples(np.zeros(2), 3, np.random.default_rng(0)))
    with pytest.raises(ValueError, match="only 2"):
        next(uniform_samples(2, 3, np.random.default_rng(0)))
