"""How well a fit knows its parameters."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.sysid.optional import needed

Vector = NDArray[np.float64]


def calculate_intervals(
    residuals_star: Sequence[Vector],
    J: Vector | None,
    alpha: float = 0.05,
    lambda_zero_thresh: float = 1e-15,
    v_zero_thresh: float = 1e-8,
) -> tuple[Vector, Vector]:
    """The covariance of the parameters, and their confidence intervals, by the model at the optimum (Seber and Wild,
    "Nonlinear regression", 2003, section 2.1.2). The variance of the noise is that of what is left, over the number of
    residuals less that of parameters.

    Args:
        residuals_star: residuals at the optimum.
        J: Jacobian there, `(nr, nx)`.
        alpha: how often an interval may miss.
        lambda_zero_thresh: eigenvalues of `J' J` below this share of the largest are zero.
        v_zero_thresh: parts of eigenvectors below this share of the largest part that a parameter has are zero.

    Returns:
        Covariance `(nx, nx)`, and half the length of each interval `(nx,)`, infinite of a parameter that a zero
        eigenvalue's direction moves. Both are empty without a Jacobian.

    Raises:
        ImportError: scipy is not installed.
    """
    if J is None or J.size == 0:
        return np.empty((0, 0)), np.empty(0)
    left = np.concatenate([np.ravel(part) for part in residuals_star])
    freedom = left.size - J.shape[1]
    variance = float(left @ left) / freedom
    values, vectors = np.linalg.eigh(J.T @ J)
    unknown = values < lambda_zero_thresh * values.max()
    share = np.abs(vectors) / np.abs(vectors).max(axis=1, keepdims=True)
    weights = np.where(share < v_zero_thresh, 0.0, vectors) ** 2
    inverse = 1 / np.where(unknown, np.inf, values)
    diagonal = np.where((weights[:, unknown] > 0).any(axis=1), np.inf, weights @ inverse)
    # As much as an eigenvalue of zero can be told from one.
    least = np.where(values == 0, lambda_zero_thresh, values)
    covariance = variance * (vectors / least) @ vectors.T
    quantile = float(needed("scipy.special", "scipy").stdtrit(freedom, 1 - alpha / 2))
    return covariance, quantile * np.sqrt(variance * diagonal)
