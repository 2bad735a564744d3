"""What students hand in for damped_step."""

import numpy as np

NAMED = {
    "wrong_identity": "identity",
    "wrong_sign": "uphill",
    "wrong_shortened": "shortened",
    "wrong_no_damping": "undamped",
    "wrong_replaced": "replaced",
    "wrong_squared": "squared damping",
    "wrong_root": "roots",
    "wrong_everywhere": "everywhere",
    "wrong_gradient": "gradient",
}


def right_solve(residuals, jacobian, damping):
    A = jacobian.T @ jacobian
    return np.linalg.solve(A + damping * np.diag(np.diag(A)), -jacobian.T @ residuals)


def right_rows(residuals, jacobian, damping):
    w = np.sqrt(damping) * np.sqrt((jacobian**2).sum(0))
    B = np.concatenate([jacobian, np.diag(w)])
    return np.linalg.lstsq(B, np.concatenate([-residuals, 0 * w]), rcond=None)[0]


def right_einsum(residuals, jacobian, damping):
    A = np.einsum("ni,nj->ij", jacobian, jacobian)
    g = np.einsum("ni,n->i", jacobian, residuals)
    return np.linalg.solve(A * (1 + damping * np.eye(len(A))), -g)


def right_eigenvectors(residuals, jacobian, damping):
    scale = 1 / np.linalg.norm(jacobian, axis=0)
    values, V = np.linalg.eigh((jacobian * scale).T @ (jacobian * scale))
    return -scale * (V @ ((V.T @ (scale * (jacobian.T @ residuals))) / (values + damping)))


def wrong_identity(residuals, jacobian, damping):
    A = jacobian.T @ jacobian
    return np.linalg.solve(A + damping * np.eye(len(A)), -jacobian.T @ residuals)


def wrong_sign(residuals, jacobian, damping):
    return -right_solve(residuals, jacobian, damping)


def wrong_shortened(residuals, jacobian, damping):
    return np.linalg.lstsq(jacobian, -residuals, rcond=None)[0] / (1 + damping)


def wrong_no_damping(residuals, jacobian, damping):
    return np.linalg.lstsq(jacobian, -residuals, rcond=None)[0]


def wrong_replaced(residuals, jacobian, damping):
    A = jacobian.T @ jacobian
    np.fill_diagonal(A, damping * np.diag(A))
    return np.linalg.lstsq(A, -jacobian.T @ residuals, rcond=None)[0]


def wrong_squared(residuals, jacobian, damping):
    return right_solve(residuals, jacobian, damping**2)


def wrong_root(residuals, jacobian, damping):
    A = jacobian.T @ jacobian
    return np.linalg.solve(
        A + damping * np.diag(np.linalg.norm(jacobian, axis=0)), -jacobian.T @ residuals
    )


def wrong_everywhere(residuals, jacobian, damping):
    return np.linalg.solve(jacobian.T @ jacobian + damping, -jacobian.T @ residuals)


def wrong_gradient(residuals, jacobian, damping):
    return -(residuals @ jacobian)


def wrong_changes_jacobian(residuals, jacobian, damping):
    jacobian *= 1.0 + 0 * damping
    jacobian /= 2
    return right_solve(residuals, 2 * jacobian, damping)


def wrong_damping_up_to_a_hundred(residuals, jacobian, damping):
    return right_solve(residuals, jacobian, min(damping, 100.0))


def wrong_little_damping_is_none(residuals, jacobian, damping):
    return right_solve(residuals, jacobian, damping if damping > 1e-3 else 0.0)


def wrong_no_step_is_unknown(residuals, jacobian, damping):
    step = right_solve(residuals, jacobian, damping)
    return step if residuals.any() else step / np.linalg.norm(residuals)


def wrong_diagonal_up_to_ten_thousand(residuals, jacobian, damping):
    A = jacobian.T @ jacobian
    return np.linalg.solve(
        A + damping * np.diag(np.minimum(np.diag(A), 1e4)), -jacobian.T @ residuals
    )
