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
    "wrong_cholesky_not_solved": "not inverted",
}


def right_loop(p, mean, covariance):
    inverse = np.linalg.inv(covariance)
    return np.array([np.sqrt((x - mean) @ inverse @ (x - mean)) for x in p])


def right_einsum(p, mean, covariance):
    v = p - mean
    return np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v) ** 0.5


def right_solve(p, mean, covariance):
    v = (p - mean).T
    return np.sqrt((v * np.linalg.solve(covariance, v)).sum(axis=0))


def right_cholesky(p, mean, covariance):
    from scipy.linalg import solve_triangular

    return np.linalg.norm(
        solve_triangular(np.linalg.cholesky(covariance), (p - mean).T, lower=True), axis=0
    )


def right_svd(p, mean, covariance):
    U, s, _ = np.linalg.svd(covariance)
    return np.linalg.norm((p - mean) @ U / np.sqrt(s), axis=1)


def right_list(p, mean, covariance):
    inverse = np.linalg.pinv(covariance)
    return [float(np.sqrt((x - mean).T @ inverse @ (x - mean))) for x in p]


def right_diag_of_product(p, mean, covariance):
    v = p - mean
    return np.sqrt(np.sum(v @ np.linalg.inv(covariance) * v, axis=1))


def right_inverse_root(p, mean, covariance):
    from scipy.linalg import sqrtm

    return np.linalg.norm((p - mean) @ np.linalg.inv(np.real(sqrtm(covariance))), axis=1)


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


def wrong_own_mean(p, mean, covariance):
    v = p - p.mean(axis=0)
    return np.sqrt(np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v))


def wrong_own_covariance(p, mean, covariance):
    v = p - mean
    S = np.atleast_2d(np.cov(p.T)) + 1e-9 * np.eye(p.shape[1])
    return np.sqrt(np.abs(np.einsum("ni,ij,nj->n", v, np.linalg.pinv(np.nan_to_num(S)), v)))


def wrong_half(p, mean, covariance):
    v = p - mean
    return np.sqrt(0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v))


def wrong_density(p, mean, covariance):
    v = p - mean
    return np.exp(-0.5 * np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v))


def wrong_cholesky_not_solved(p, mean, covariance):
    return np.linalg.norm((p - mean) @ np.linalg.cholesky(covariance), axis=1)


def wrong_cholesky_transposed(p, mean, covariance):
    return np.linalg.norm((p - mean) @ np.linalg.inv(np.linalg.cholesky(covariance)), axis=1)


def wrong_square_of_inverse(p, mean, covariance):
    return np.linalg.norm((p - mean) @ np.linalg.inv(covariance), axis=1)


def wrong_one_number(p, mean, covariance):
    v = p - mean
    return np.full(len(p), np.sqrt(np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v)).sum())


def wrong_over_dimensions(p, mean, covariance):
    v = p - mean
    return np.sqrt(np.einsum("ni,ij,nj->n", v, np.linalg.inv(covariance), v) / p.shape[1])


def wrong_eigenvalues_not_rooted(p, mean, covariance):
    values, axes = np.linalg.eigh(covariance)
    return np.linalg.norm((p - mean) @ axes / values, axis=1)


def wrong_axes_as_rows(p, mean, covariance):
    values, axes = np.linalg.eigh(covariance)
    return np.linalg.norm((p - mean) @ axes.T / np.sqrt(values), axis=1)


def wrong_in_place(p, mean, covariance):
    p -= mean
    return np.sqrt(np.einsum("ni,ij,nj->n", p, np.linalg.inv(covariance), p))


def wrong_a_little_on_the_diagonal(p, mean, covariance):
    return right_einsum(p, mean, covariance + 1e-9 * np.eye(len(covariance)))


def right_qr_of_a_root(p, mean, covariance):
    w, V = np.linalg.eigh(covariance)
    R = np.linalg.qr((V * np.sqrt(w)).T)[1]
    return np.sqrt(np.sum(np.linalg.solve(R.T, np.transpose(p - mean)) ** 2, axis=0))
