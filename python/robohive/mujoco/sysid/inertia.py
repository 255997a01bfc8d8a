"""Ten numbers of a body's inertia of which every value is possible.

The pseudo-inertia `J`, 4 x 4, has the second moments of the mass, the first ones and the mass. It is positive definite of every
body, and every positive definite matrix is that of a body. With `J = U U'`, `U` upper triangular with a positive diagonal, the
logarithms of the diagonal and the entries above it can have any value (Rucker and Wensing, "Smooth parameterization of rigid-body
inertia", IEEE Robotics and Automation Letters 7, 2022). With `U = exp(alpha) V` and `V[3, 3] = 1`:

    theta = alpha, log V[0,0], log V[1,1], log V[2,2], V[0,1], V[1,2], V[0,2], V[0,3], V[1,3], V[2,3]

`pi` is the mass [kg], the first moments [kg m], and the rotational inertia about the origin of the body, row by row [kg m²].
"""

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco.functions.rotation import mju_quat2Mat

Vector = NDArray[np.float64]

#: Rows and columns of the entries above the diagonal, in the order of `theta`.
_ABOVE = (np.array([0, 1, 0, 0, 1, 2]), np.array([1, 2, 2, 3, 3, 3]))


def skew(v: Vector) -> Vector:
    """The matrix of the cross product with a vector from the left, 3 x 3."""
    return np.asarray(np.cross(np.eye(3), np.asarray(v, np.float64)).T, np.float64)


def cholesky_decompose_upper(J: Vector) -> Vector:
    """The upper triangular `U` with `U U' = J`.

    Raises:
        numpy.linalg.LinAlgError: `J` is not positive definite.
    """
    return np.asarray(np.linalg.cholesky(np.flip(J))[::-1, ::-1], np.float64)


def pi_from_pseudoinertia(J: Vector) -> Vector:
    """`pi`, of thirteen numbers, from the pseudo-inertia."""
    second = J[:3, :3]
    return np.concatenate([J[3:, 3], J[:3, 3], (np.trace(second) * np.eye(3) - second).ravel()])


def pseudoinertia_from_pi(pi: Vector) -> Vector:
    """The pseudo-inertia, 4 x 4, from the thirteen numbers of `pi`."""
    inertia, first = pi[4:].reshape(3, 3), pi[1:4, np.newaxis]
    second = np.trace(inertia) / 2 * np.eye(3) - inertia
    return np.block([[second, first], [first.T, pi[:1, np.newaxis]]])


def pi_from_theta(theta: Vector) -> Vector:
    """`pi`, of thirteen numbers, from `theta`, of ten."""
    factor = np.diag(np.append(np.exp(theta[1:4]), 1.0))
    factor[_ABOVE] = theta[4:]
    return pi_from_pseudoinertia(np.exp(2 * theta[0]) * (factor @ factor.T))


def theta_from_pseudoinertia(J: Vector) -> Vector:
    """`theta`, of ten numbers, from the pseudo-inertia.

    Raises:
        numpy.linalg.LinAlgError: no body has it, since it is not positive definite.
    """
    factor = cholesky_decompose_upper(J)
    scale = factor[3, 3]
    factor = factor / scale
    return np.concatenate([[np.log(scale)], np.log(np.diagonal(factor)[:3]), factor[_ABOVE]])


def inertia_to_fullinertia(q: Vector, inertia: Vector) -> Vector:
    """A matrix 3 x 3 from the principal moments [kg m²] and the orientation of their axes, a quaternion."""
    flat = np.empty(9)
    mju_quat2Mat(flat, q)
    axes = flat.reshape(3, 3)
    return np.asarray((axes * inertia) @ axes.T)


def about_point(inertia: Vector, mass: float, offset: Vector) -> Vector:
    """The rotational inertia about a point at `offset` [m] from the centre of mass, from that about the centre of mass."""
    return np.asarray(inertia + mass * (offset @ offset * np.eye(3) - np.outer(offset, offset)))
