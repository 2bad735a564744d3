"""What students hand in for mahalanobis."""

import numpy as np

NAMED = {
    "wrong_no_root": "squared",
    "wrong_forgot_inverse": "not inverted",
    "wrong_variances_only": "diagonal only",
    "wrong_origin": "from the origin",
    "wrong_norm": "euclid",
    "wrong_one_over": "entries inverted",
    "wrong_divided_by_diagonal": "over variances",
}


def right_einsum(p, mean, covariance):
    v = p - mean
    return np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v) ** 0.5


def right_cholesky(p, mean, covariance):
    from scipy.linalg import solve_triangular

    return np.linalg.norm(
        solve_triangular(np.linalg.cholesky(covariance), (p - mean).T, lower=True), axis=0
    )


def right_svd(p, mean, covariance):
    U, s, _ = np.linalg.svd(covariance)
    return np.linalg.norm((p - mean) @ U / np.sqrt(s), axis=1)


def wrong_no_root(p, mean, covariance):
    v = p - mean
    return ((v @ np.linalg.inv(covariance)) * v).sum(axis=1)


def wrong_forgot_inverse(p, mean, covariance):
    return np.sqrt([(x - mean) @ covariance @ (x - mean) for x in p])


def wrong_variances_only(p, mean, covariance):
    return np.sqrt((((p - mean) ** 2) / np.diag(covariance)).sum(axis=1))


def wrong_origin(p, mean, covariance):
    return np.sqrt(np.einsum("ni,ij,nj->n", p, np.linalg.inv(covariance), p))


def wrong_norm(p, mean, covariance):
    return np.sqrt(((p - mean) ** 2).sum(axis=1))


def wrong_one_over(p, mean, covariance):
    v = p - mean
    with np.errstate(divide="ignore"):
        return np.sqrt(np.abs(np.einsum("ni,ij,nj->n", v, 1 / covariance, v)))


def wrong_divided_by_diagonal(p, mean, covariance):
    return np.linalg.norm((p - mean) / covariance.diagonal(), axis=1)


def wrong_in_place(p, mean, covariance):
    p -= mean
    return np.sqrt(np.einsum("ni,ij,nj->n", p, np.linalg.inv(covariance), p))


def wrong_a_little_on_the_diagonal(p, mean, covariance):
    return right_einsum(p, mean, covariance + 1e-9 * np.eye(len(covariance)))


def right_qr_of_a_root(p, mean, covariance):
    w, V = np.linalg.eigh(covariance)
    R = np.linalg.qr((V * np.sqrt(w)).T)[1]
    return np.sqrt(np.sum(np.linalg.solve(R.T, np.transpose(p - mean)) ** 2, axis=0))
