"""Matrices with a band along the diagonal and, at the end, dense rows (an arrow), kept as the lower triangle.

The first `ntotal - ndense` rows keep `nband` numbers each, of which the last is on the diagonal; the `ndense` rows after them
keep all `ntotal`.
"""

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco.functions.out import Vector, destination, vector, write


def mju_bandDiag(i: int, ntotal: int, nband: int, ndense: int) -> int:
    """Where the diagonal number of row `i` is kept."""
    sparse = ntotal - ndense
    return i * nband + nband - 1 if i < sparse else sparse * nband + (i - sparse) * ntotal + i


def _rows(ntotal: int, nband: int, ndense: int) -> list[tuple[slice, slice]]:
    """For each row where its numbers are kept, and in which columns they stand, up to the diagonal."""
    rows = []
    for i in range(ntotal):
        diagonal = mju_bandDiag(i, ntotal, nband, ndense)
        width = min(i + 1, nband) if i < ntotal - ndense else i + 1
        rows.append((slice(diagonal + 1 - width, diagonal + 1), slice(i + 1 - width, i + 1)))
    return rows


def _size(ntotal: int, nband: int, ndense: int) -> int:
    return nband * (ntotal - ndense) + ntotal * ndense


def _dense(mat: ArrayLike, ntotal: int, nband: int, ndense: int) -> Vector:
    """The lower triangle, dense."""
    kept = vector(mat, "mat", _size(ntotal, nband, ndense))
    full = np.zeros((ntotal, ntotal))
    for i, (places, columns) in enumerate(_rows(ntotal, nband, ndense)):
        full[i, columns] = kept[places]
    return full


def mju_dense2Band(res: Vector, mat: ArrayLike, ntotal: int, nband: int, ndense: int) -> None:
    """Keeps the band and the dense rows of a matrix; numbers outside are dropped."""
    full = np.asarray(mat, np.float64)
    if full.shape != (ntotal, ntotal):
        raise TypeError("mat should have shape (ntotal, ntotal)")
    size = _size(ntotal, nband, ndense)
    destination(res, "res", "size nband*(ntotal-ndense) + ntotal*ndense", (size,))
    band = np.zeros(size)
    for i, (places, columns) in enumerate(_rows(ntotal, nband, ndense)):
        band[places] = full[i, columns]
    write(res, band)


def mju_band2Dense(res: Vector, mat: ArrayLike, ntotal: int, nband: int, ndense: int, flg_sym: bool) -> None:
    """The matrix in full, with `flg_sym` its upper triangle too."""
    destination(res, "res", "shape (ntotal, ntotal)", (ntotal, ntotal))
    lower = _dense(mat, ntotal, nband, ndense)
    write(res, lower + np.tril(lower, -1).T if flg_sym else lower)


def mju_bandMulMatVec(
    res: Vector, mat: ArrayLike, vec: ArrayLike, ntotal: int, nband: int, ndense: int, nvec: int, flg_sym: bool
) -> None:
    """`mat vec` for `nvec` vectors, one after another."""
    lower = _dense(mat, ntotal, nband, ndense)
    full = lower + np.tril(lower, -1).T if flg_sym else lower
    vectors = np.asarray(vec, np.float64).reshape(nvec, ntotal)
    destination(res, "res", "size ntotal*nvec", (vectors.size,))
    write(res, vectors @ full.T)


def mju_cholFactorBand(mat: Vector, ntotal: int, nband: int, ndense: int, diagadd: float, diagmul: float) -> float:
    """Replaces a matrix by its Cholesky factor, after `diagadd + diagmul * itself` is added to the diagonal.

    Returns the least diagonal number met, which is 0 where the matrix is not positive definite.
    """
    full = _dense(mat, ntotal, nband, ndense)
    np.fill_diagonal(full, np.diag(full) * (1 + diagmul) + diagadd)
    least = np.inf
    for j in range(ntotal):
        square = full[j, j] - full[j, :j] @ full[j, :j]
        least = min(least, square)
        if least < 1e-15:
            return 0.0
        full[j, j] = np.sqrt(square)
        full[j + 1 :, j] = (full[j + 1 :, j] - full[j + 1 :, :j] @ full[j, :j]) / full[j, j]
    # The factor fills nothing outside of the band and the dense rows.
    mju_dense2Band(mat, full, ntotal, nband, ndense)
    return float(least)


def mju_cholSolveBand(res: Vector, mat: ArrayLike, vec: ArrayLike, ntotal: int, nband: int, ndense: int) -> None:
    """Solves with the factor that `mju_cholFactorBand` left."""
    factor = _dense(mat, ntotal, nband, ndense)
    x = np.array(vec, np.float64).reshape(ntotal)
    for i in range(ntotal):
        x[i] = (x[i] - factor[i, :i] @ x[:i]) / factor[i, i]
    for i in reversed(range(ntotal)):
        x[i] = (x[i] - factor[i + 1 :, i] @ x[i + 1 :]) / factor[i, i]
    write(res, x)
