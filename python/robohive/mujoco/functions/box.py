"""Quadratic programs with bounds on each variable."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco.functions.out import Vector, destination, vector, write

#: Iterations at most; the least gradient; the least decrease, relative; the shrink of a step, and the least; Armijo's share.
_ITERATIONS, _GRADIENT, _DECREASE, _SHRINK, _STEP, _SHARE = 100, 1e-16, 1e-16, 0.5, 1e-10, 0.1


def mju_boxQP(
    res: Vector, R: Vector, index: Any, H: ArrayLike, g: ArrayLike, lower: ArrayLike | None, upper: ArrayLike | None
) -> int:
    """Minimises `x'Hx/2 + x'g` with `lower <= x <= upper`, from `res` on, by projected Newton steps (Bertsekas,
    "Projected Newton methods for optimization problems with simple constraints", 1982; for limits of controls Tassa, Mansard and
    Todorov, "Control-limited differential dynamic programming", 2014).

    `res` takes the solution, `index` the free variables, `R` the Cholesky factor (lower) of their part of `H`.
    Returns how many are free, -1 where `H` is not positive definite.
    """
    linear = vector(g, "g")
    n = linear.size
    hessian = np.asarray(H, np.float64)
    if hessian.shape != (n, n):
        raise TypeError("H should be a square matrix of the size of g")
    destination(res, "res", "the size of g", (n,))
    if not isinstance(R, np.ndarray) or R.size < n * (n + 7):
        raise TypeError("R should have size n*(n+7)")
    low = np.full(n, -np.inf) if lower is None else vector(lower, "lower", n)
    high = np.full(n, np.inf) if upper is None else vector(upper, "upper", n)
    hessian = np.tril(hessian) + np.tril(hessian, -1).T
    x, free, factor = _descend(hessian, linear, np.clip(vector(res, "res", n), low, high), low, high)
    if factor is None:
        return -1
    write(res, x)
    count = int(free.sum())
    R.ravel()[: count * count] = factor.ravel()
    if index is not None:
        index[:count] = np.flatnonzero(free)
    return count


def _descend(h: Vector, g: Vector, x: Vector, low: Vector, high: Vector) -> tuple[Vector, Any, Any]:
    """The minimum, which variables are free there, and the factor of their part of `h`; None where that has none."""

    def cost(at: Vector) -> float:
        return float(at @ (0.5 * h @ at + g))

    free: Any = None
    factor: Any = None
    before = cost(x)
    for _ in range(_ITERATIONS):
        slope = g + h @ x
        now_free = ~(((x <= low) & (slope > 0)) | ((x >= high) & (slope < 0)))
        if free is None or (now_free != free).any():
            free = now_free
            try:
                factor = np.linalg.cholesky(h[np.ix_(free, free)]) if free.any() else np.zeros((0, 0))
            except np.linalg.LinAlgError:
                return x, free, None
        if np.linalg.norm(slope[free]) < _GRADIENT or not free.any():
            break
        search = np.zeros_like(x)
        fixed = g + h @ np.where(free, 0.0, x)
        search[free] = -np.linalg.solve(factor.T, np.linalg.solve(factor, fixed[free])) - x[free]
        step, along = 1.0, float(search @ slope)
        if along >= 0:
            break
        new = np.clip(x + search, low, high)
        while before - cost(new) < -_SHARE * step * along:
            step *= _SHRINK
            if step < _STEP:
                return x, free, factor
            new = np.clip(x + step * search, low, high)
        after = cost(new)
        x, decrease, before = new, before - after, after
        if decrease <= _DECREASE * abs(before):
            break
    return x, free, factor
