"""Functions over a few numbers: muscles, cones of friction, sorting, matrices, text."""

import math
import random

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco._constants import mjMINVAL
from robohive.mujoco.functions.out import Vector, destination, vector, write


def mju_muscleGain(len: float, vel: float, lengthrange: ArrayLike, acc0: float, prm: ArrayLike) -> float:
    """Active force of a muscle for each unit of activation [N]; `prm` is range (2), force, scale, lmin, lmax, vmax, fpmax, fvmax."""
    return _core.muscle_forces(len, vel, vector(lengthrange, "lengthrange", 2), acc0, vector(prm, "prm", 9))[0]


def mju_muscleBias(len: float, lengthrange: ArrayLike, acc0: float, prm: ArrayLike) -> float:
    """Passive force of a muscle [N], with the parameters of `mju_muscleGain`."""
    return _core.muscle_forces(len, 0.0, vector(lengthrange, "lengthrange", 2), acc0, vector(prm, "prm", 9))[1]


def mju_muscleDynamics(ctrl: float, act: float, prm: ArrayLike) -> float:
    """Rate of a muscle's activation [1/s]; `prm` is time constants of activation and deactivation [s], and width of their blend."""
    return _core.muscle_rate(ctrl, act, vector(prm, "prm", 3))


def mju_encodePyramid(pyramid: Vector, force: ArrayLike, mu: ArrayLike) -> None:
    """Forces along the edges of a pyramidal cone that make `force` (normal, then tangential) with coefficients `mu`.

    Each pair of edges carries an equal share of the normal force, and as much of its tangential force as that allows. As
    MuJoCo's bindings do, this takes `n` coefficients, `n + 1` numbers of `force` and `2 n` edges for a contact of `n`
    dimensions, so that the last of `mu` and of `force` do not count, and the last pair of edges is left as it is.
    """
    friction = vector(mu, "mu")
    wanted, used = vector(force, "force", friction.size + 1), friction.size - 1
    destination(pyramid, "pyramid", "2 numbers for each of mu", (2 * friction.size,))
    if used > 0:
        share = wanted[0] / used
        across = np.minimum(share, wanted[1:-1] / friction[:-1])
        edges = np.stack([share + across, share - across], axis=1)
        write(pyramid, np.append(0.5 * edges, np.ravel(pyramid)[-2:]))


def mju_decodePyramid(force: Vector, pyramid: ArrayLike, mu: ArrayLike) -> None:
    """The force (normal, then tangential) of forces along the edges of a pyramidal cone; sizes are those of `mju_encodePyramid`,
    and the last number of `force` is left as it is."""
    friction = vector(mu, "mu")
    edges = vector(pyramid, "pyramid", 2 * friction.size).reshape(-1, 2)
    destination(force, "force", "one number more than mu", (friction.size + 1,))
    if friction.size == 1:
        write(force, [edges[0, 0], np.ravel(force)[1]])
        return
    pairs = edges[:-1]
    across = (pairs[:, 0] - pairs[:, 1]) * friction[:-1]
    write(force, np.concatenate([[sum(pairs.ravel().tolist())], across, np.ravel(force)[-1:]]))


def mju_springDamper(pos0: float, vel0: float, Kp: float, Kv: float, dt: float) -> float:
    """Position after `dt` [s] of a unit mass on a spring of stiffness `Kp` with damping `Kv`, released at `pos0` with `vel0`."""
    decay, discriminant = -0.5 * Kv, Kv * Kv - 4.0 * Kp
    rate = 0.5 * math.sqrt(abs(discriminant))
    drift = vel0 - decay * pos0
    if abs(discriminant) <= mjMINVAL:
        return math.exp(decay * dt) * (pos0 + drift * dt)
    if discriminant < 0:
        return math.exp(decay * dt) * (pos0 * math.cos(rate * dt) + drift / rate * math.sin(rate * dt))
    fast, slow = decay - rate, decay + rate
    return ((vel0 - fast * pos0) * math.exp(slow * dt) - (vel0 - slow * pos0) * math.exp(fast * dt)) / (2.0 * rate)


#: Draws of `mju_standardNormal`: the same in every process, as MuJoCo's.
_DRAWS = random.Random(0)


def mju_standardNormal(num2: Vector | None = None) -> float:
    """A number of the standard normal distribution; a second one goes into `num2` (1). Each process draws the same ones."""
    first, second = _DRAWS.gauss(0.0, 1.0), _DRAWS.gauss(0.0, 1.0)
    if isinstance(num2, np.ndarray):
        write(num2, second)
    return first


def mju_insertionSort(list: Vector) -> None:
    """Sorts numbers in place, ascending."""
    destination(list, "list", "any size", (np.size(list),))
    write(list, np.sort(list, axis=None))


def mju_insertionSortInt(list: NDArray[np.int32]) -> None:
    """Sorts whole numbers in place, ascending."""
    destination(list, "list", "any size", (np.size(list),), np.int32)
    write(list, np.sort(list, axis=None))


def mju_mat2Rot(quat: Vector, mat: ArrayLike) -> int:
    """Turns `quat` to the rotation nearest to any matrix `mat` (9); returns the number of turns that it took, at most 500.

    Each turn is about the torque with which the columns of the matrix pull at those of the rotation (Müller et al., "A
    robust method to extract the rotational part of deformations", 2016).
    """
    destination(quat, "quat", "size 4", (4,))
    columns, now = vector(np.ravel(mat), "mat", 9).reshape(3, 3).T, np.ravel(quat).tolist()
    for turns in range(500):
        axes = np.reshape(_core.matrix(now), (3, 3)).T
        torque = np.cross(axes, columns).sum(axis=0) / (abs((axes * columns).sum()) + mjMINVAL)
        angle = float(np.linalg.norm(torque))
        if angle < 1e-9:
            break
        now = _core.normalise(_core.multiply(_core.of_axis_angle(torque / angle, angle), now))
    else:
        turns = 500
    write(quat, now)
    return turns


def mju_sqrMatTD(res: Vector, mat: ArrayLike, diag: ArrayLike | None = None) -> None:
    """`mat' diag mat`, of ones where `diag` is None."""
    left = np.asarray(mat, np.float64)
    destination(res, "res", "shape (nc, nc)", (left.shape[1], left.shape[1]))
    write(res, left.T @ left if diag is None else (left.T * vector(diag, "diag", left.shape[0])) @ left)


def mju_cholUpdate(mat: Vector, x: Vector, flg_plus: int) -> int:
    """Makes the factor `L` in the lower triangle of `mat` that of `L L' + x x'`, or of `- x x'` where not `flg_plus`.

    Returns the rank: less than the size where the result is not positive. `x` is overwritten.
    """
    size, sign = np.size(x), 1.0 if flg_plus else -1.0
    destination(mat, "mat", "shape (n, n), n that of x", (size, size))
    destination(x, "x", "size n", (size,))
    rest, rank = x.ravel().copy(), size
    for k in np.flatnonzero(rest):
        if rest[k] == 0.0:
            continue
        square = mat[k, k] ** 2 + sign * rest[k] ** 2
        if square < mjMINVAL:
            square, rank = mjMINVAL, rank - 1
        diagonal, before = math.sqrt(square), mat[k, k]
        cosine, sine = diagonal / before, rest[k] / before
        mat[k, k] = diagonal
        below = slice(k + 1, size)
        mat[below, k] = (mat[below, k] + sign * sine * rest[below]) / cosine
        rest[below] = cosine * rest[below] - sine * mat[below, k]
    write(x, rest)
    return rank


def mju_printMat(mat: ArrayLike) -> None:
    """Prints a matrix, eight digits after the point."""
    for row in np.atleast_2d(np.asarray(mat, np.float64)):
        print("".join(f"{number:.8f} " for number in row))
    print()


def mju_printMatSparse(mat: ArrayLike, rownnz: ArrayLike, rowadr: ArrayLike, colind: ArrayLike) -> None:
    """Prints a matrix in compressed rows: row, column and number of each entry."""
    numbers, columns = np.ravel(mat), np.ravel(colind)
    for row, (count, first) in enumerate(zip(np.ravel(rownnz).tolist(), np.ravel(rowadr).tolist(), strict=True)):
        print("".join(f"({row} {columns[k]}): {numbers[k]:9.6f}  " for k in range(first, first + count)))
    print()


def mju_writeNumBytes(nbytes: int) -> str:
    """A number of bytes by the largest unit that it is a multiple of: `3M`, `1025`."""
    power = 6
    while power and (nbytes == 0 or nbytes % 1024**power):
        power -= 1
    return f"{nbytes // 1024**power}{' KMGTPE'[power].strip()}"
