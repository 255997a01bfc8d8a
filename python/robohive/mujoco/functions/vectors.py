"""Vectors and matrices: MuJoCo's small algebra, by numpy. Results are written into the first argument."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco.functions.out import Vector, vector, write


def _same(res: Any, values: Any, sizes: str = "res and the vectors differ in size") -> None:
    if np.size(res) != np.size(values):
        raise TypeError(sizes)
    write(res, values)


def _pair(a: ArrayLike, b: ArrayLike) -> tuple[Vector, Vector]:
    first, second = vector(a, "vec1"), vector(b, "vec2")
    if first.size != second.size:
        raise TypeError("vec1 and vec2 differ in size")
    return first, second


def mju_zero(res: Vector) -> None:
    """All zero."""
    res[...] = 0.0


def mju_fill(res: Vector, val: float) -> None:
    """All `val`."""
    res[...] = val


def mju_copy(res: Vector, vec: ArrayLike) -> None:
    """A copy."""
    _same(res, vector(vec, "vec"))


def mju_sum(vec: ArrayLike) -> float:
    """Sum of all numbers."""
    return float(sum(vector(vec, "vec").tolist()))


def mju_L1(vec: ArrayLike) -> float:
    """Sum of all magnitudes."""
    return float(np.abs(vector(vec, "vec")).sum())


def mju_scl(res: Vector, vec: ArrayLike, scl: float) -> None:
    """`vec * scl`."""
    _same(res, vector(vec, "vec") * scl)


def mju_add(res: Vector, vec1: ArrayLike, vec2: ArrayLike) -> None:
    """`vec1 + vec2`."""
    a, b = _pair(vec1, vec2)
    _same(res, a + b)


def mju_addTo(res: Vector, vec: ArrayLike) -> None:
    """Adds `vec`."""
    mju_add(res, res, vec)


def mju_sub(res: Vector, vec1: ArrayLike, vec2: ArrayLike) -> None:
    """`vec1 - vec2`."""
    a, b = _pair(vec1, vec2)
    _same(res, a - b)


def mju_subFrom(res: Vector, vec: ArrayLike) -> None:
    """Subtracts `vec`."""
    mju_sub(res, res, vec)


def mju_addScl(res: Vector, vec1: ArrayLike, vec2: ArrayLike, scl: float) -> None:
    """`vec1 + vec2 * scl`."""
    a, b = _pair(vec1, vec2)
    _same(res, a + b * scl)


def mju_addToScl(res: Vector, vec: ArrayLike, scl: float) -> None:
    """Adds `vec * scl`."""
    mju_addScl(res, res, vec, scl)


def mju_dot(vec1: ArrayLike, vec2: ArrayLike) -> float:
    """Dot product."""
    a, b = _pair(vec1, vec2)
    return float(a @ b)


def mju_norm(res: ArrayLike) -> float:
    """Length."""
    return math.sqrt(mju_dot(res, res))


def mju_normalize(res: Vector) -> float:
    """Scales to unit length and returns the length; zeros become the first axis."""
    length = mju_norm(res)
    if length < 1e-15:
        res[...] = 0.0
        res[:1] = 1.0
    else:
        res *= 1.0 / length
    return length


def mju_dist3(pos1: ArrayLike, pos2: ArrayLike) -> float:
    """Distance of two points."""
    a, b = _pair(pos1, pos2)
    return mju_norm(a - b)


def mju_cross(res: Vector, a: ArrayLike, b: ArrayLike) -> None:
    """Cross product."""
    _same(res, np.cross(vector(a, "a", 3), vector(b, "b", 3)))


def mju_isZero(vec: ArrayLike) -> int:
    """1 when all numbers are zero."""
    return int(not np.any(vector(vec, "vec")))


def _matrix(mat: ArrayLike, name: str = "mat") -> Vector:
    array = np.asarray(mat, np.float64)
    if array.ndim != 2:
        raise TypeError(f"{name} should be a matrix, not of shape {array.shape}")
    return array


def _product(res: Vector, a: Vector, b: Vector) -> None:
    if a.shape[1] != b.shape[0]:
        raise TypeError(f"matrices of shapes {a.shape} and {b.shape} have no product")
    _same(res, a @ b, "res should have the shape of the product")


def mju_mulMatVec(res: Vector, mat: ArrayLike, vec: ArrayLike) -> None:
    """`mat vec`."""
    _product(res, _matrix(mat), vector(vec, "vec")[:, None])


def mju_mulMatTVec(res: Vector, mat: ArrayLike, vec: ArrayLike) -> None:
    """`mat' vec`."""
    _product(res, _matrix(mat).T, vector(vec, "vec")[:, None])


def mju_mulMatVec3(res: Vector, mat: ArrayLike, vec: ArrayLike) -> None:
    """`mat vec` for a matrix of nine numbers."""
    mju_mulMatVec(res, vector(np.ravel(mat), "mat", 9).reshape(3, 3), vec)


def mju_mulMatTVec3(res: Vector, mat: ArrayLike, vec: ArrayLike) -> None:
    """`mat' vec` for a matrix of nine numbers."""
    mju_mulMatTVec(res, vector(np.ravel(mat), "mat", 9).reshape(3, 3), vec)


def mju_mulMatMat(res: Vector, mat1: ArrayLike, mat2: ArrayLike) -> None:
    """`mat1 mat2`."""
    _product(res, _matrix(mat1, "mat1"), _matrix(mat2, "mat2"))


def mju_mulMatMatT(res: Vector, mat1: ArrayLike, mat2: ArrayLike) -> None:
    """`mat1 mat2'`."""
    _product(res, _matrix(mat1, "mat1"), _matrix(mat2, "mat2").T)


def mju_mulMatTMat(res: Vector, mat1: ArrayLike, mat2: ArrayLike) -> None:
    """`mat1' mat2`."""
    _product(res, _matrix(mat1, "mat1").T, _matrix(mat2, "mat2"))


def mju_mulVecMatVec(vec1: ArrayLike, mat: ArrayLike, vec2: ArrayLike) -> float:
    """`vec1' mat vec2`."""
    return float(vector(vec1, "vec1") @ _matrix(mat) @ vector(vec2, "vec2"))


def mju_transpose(res: Vector, mat: ArrayLike) -> None:
    """The transposed matrix."""
    _same(res, _matrix(mat).T)


def mju_symmetrize(res: Vector, mat: ArrayLike) -> None:
    """Mean of a matrix and its transposed."""
    _same(res, 0.5 * (_matrix(mat) + _matrix(mat).T))


def mju_eye(mat: Vector) -> None:
    """The identity."""
    _same(mat, np.eye(len(mat)))


def mju_sym2dense(res: Vector, mat: ArrayLike, rownnz: ArrayLike, rowadr: ArrayLike, colind: ArrayLike) -> None:
    """A symmetric matrix of the compressed rows of its lower triangle."""
    mju_sparse2dense(res, mat, rownnz, rowadr, colind)
    lower = np.tril(res)
    write(res, lower + np.tril(lower, -1).T)


def mju_dense2sparse(res: Vector, mat: ArrayLike, rownnz: Any, rowadr: Any, colind: Any) -> int:
    """Compressed rows of a matrix: its numbers that are not 0, how many each row has, where it begins, their columns.
    Returns 1 where `res` or `colind` is too small, else 0."""
    full = np.atleast_2d(np.asarray(mat, np.float64))
    rows, columns = np.nonzero(full)
    if rownnz.size != len(full) or rowadr.size != len(full):
        raise TypeError("rownnz and rowadr should have a number for each row of mat")
    if rows.size > res.size or rows.size > colind.size:
        return 1
    counts = np.bincount(rows, minlength=len(full))
    rownnz[...] = counts
    rowadr[...] = np.cumsum(counts) - counts
    res[: rows.size] = full[rows, columns]
    colind[: rows.size] = columns
    return 0


def mju_sparse2dense(res: Vector, mat: ArrayLike, rownnz: ArrayLike, rowadr: ArrayLike, colind: ArrayLike) -> None:
    """A matrix of its compressed rows."""
    values, columns = vector(mat, "mat"), np.asarray(colind)
    res[...] = 0.0
    for row, (count, start) in enumerate(zip(np.asarray(rownnz), np.asarray(rowadr), strict=True)):
        res[row, columns[start : start + count]] = values[start : start + count]


def mju_transformSpatial(
    res: Vector, vec: ArrayLike, flg_force: int, newpos: ArrayLike, oldpos: ArrayLike, rotnew2old: ArrayLike
) -> None:
    """A motion or force vector, rotation first, seen from another point and orientation."""
    turning, moving = np.split(vector(vec, "vec", 6), 2)
    lever = vector(newpos, "newpos", 3) - vector(oldpos, "oldpos", 3)
    if flg_force:
        turning = turning - np.cross(lever, moving)
    else:
        moving = moving - np.cross(lever, turning)
    rotation = vector(np.ravel(rotnew2old), "rotnew2old", 9).reshape(3, 3)
    _same(res, np.concatenate((rotation.T @ turning, rotation.T @ moving)))


def mju_cholFactor(mat: Vector, mindiag: float) -> int:
    """Cholesky factor in place, in the lower triangle; returns the rank."""
    a, rank = mat, len(mat)
    for j in range(len(a)):
        diagonal = a[j, j] - a[j, :j] @ a[j, :j]
        if diagonal < mindiag:
            diagonal, rank = mindiag, rank - 1
        a[j, j] = math.sqrt(diagonal)
        a[j + 1 :, j] = (a[j + 1 :, j] - a[j + 1 :, :j] @ a[j, :j]) / a[j, j]
    return rank


def mju_cholSolve(res: Vector, mat: ArrayLike, vec: ArrayLike) -> None:
    """Solves with the factor that `mju_cholFactor` made."""
    factor = np.tril(_matrix(mat))
    _same(res, np.linalg.solve(factor.T, np.linalg.solve(factor, vector(vec, "vec"))))


def mju_min(a: float, b: float) -> float:
    """The smaller number."""
    return min(a, b)


def mju_max(a: float, b: float) -> float:
    """The larger number."""
    return max(a, b)


def mju_clip(x: float, min: float, max: float) -> float:
    """The number of the range that is nearest to `x`."""
    return min if x < min else max if x > max else x


def mju_sign(x: float) -> float:
    """1, -1 or 0."""
    return float((x > 0) - (x < 0))


def mju_round(x: float) -> int:
    """The nearest integer, halves upwards."""
    return math.floor(x + 0.5)


def mju_isBad(x: float) -> int:
    """1 for what is not finite or larger than physics accepts."""
    return int(math.isnan(x) or abs(x) > 1e10)


def mju_sigmoid(x: float) -> float:
    """A smooth step of fifth degree from 0 at 0 to 1 at 1."""
    return 0.0 if x <= 0 else 1.0 if x >= 1 else x * x * x * (3 * x * (2 * x - 5) + 10)


def mju_Halton(index: int, base: int) -> float:
    """Element of the Halton sequence of a base."""
    value, share = 0.0, 1.0 / base
    while index > 0:
        index, digit = divmod(index, base)
        value += digit * share
        share /= base
    return value


mju_zero3 = mju_zero4 = mju_zero
mju_copy3 = mju_copy4 = mju_copy
mju_scl3, mju_add3, mju_addTo3, mju_sub3, mju_subFrom3 = mju_scl, mju_add, mju_addTo, mju_sub, mju_subFrom
mju_addScl3, mju_addToScl3, mju_dot3, mju_norm3, mju_normalize3 = mju_addScl, mju_addToScl, mju_dot, mju_norm, mju_normalize
mju_n2d = mju_d2n = mju_n2f = mju_f2n = mju_copy
