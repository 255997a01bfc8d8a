"""The fit: nonlinear least squares by one of three minimisers."""

from __future__ import annotations

import io
import logging
from collections.abc import Callable
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco import minimize
from robohive.mujoco.sysid.optional import needed
from robohive.mujoco.sysid.parameters.collection import ParameterDict

Vector = NDArray[np.float64]
ResidualFn: TypeAlias = Callable[..., Any]
Optimizer: TypeAlias = Literal["scipy", "mujoco", "scipy_parallel_fd"]
Bounds: TypeAlias = tuple[Vector, Vector]
Objective: TypeAlias = Callable[[Vector], Vector]

_log = logging.getLogger("absl")
#: Size of differences.
_STEP = float(np.finfo(np.float64).eps ** 0.5)
#: Iterations by default.
_ITERATIONS = 200
#: The condition number of `J' J` from which on a fit is suspicious: a thousand times less than where steps have no digit left.
_ILL_CONDITIONED = 1e12
#: How near a bound is at it, as a share of the distance of the bounds.
_AT_BOUND = 1e-3


def optimize(
    initial_params: ParameterDict,
    residual_fn: ResidualFn,
    optimizer: Optimizer = "mujoco",
    verbose: bool = True,
    check_conditioning: bool = False,
    **optimizer_kwargs: Any,
) -> tuple[ParameterDict, Any]:
    """Minimises the sum of squares of residuals, within the bounds of parameters.

    Args:
        initial_params: where it begins; left as they are.
        residual_fn: of `build_residual_fn`, or one that takes points as columns `(nx, k)` and parameters, and returns a
            list of residuals and two values more.
        optimizer: `mujoco` is `mujoco.minimize.least_squares`, which simulates the differences of all parameters at once;
            `scipy` is `scipy.optimize.least_squares`, `scipy_parallel_fd` the same with such differences.
        verbose: logs a table of parameters in the end, and prints iterations.
        check_conditioning: computes one Jacobian more, and warns where it hardly tells parameters apart.
        optimizer_kwargs: of the minimiser: `max_iters` (200 by default), `x_scale`, and of scipy's `loss` and `diff_step`;
            `gtol`, `xtol` and others are passed on.

    Returns:
        Parameters at the optimum, and a `scipy.optimize.OptimizeResult` with `x`, `jac`, `grad`, and of `mujoco` in
        `extras` the `objective` and the `candidate` of each iteration.

    Raises:
        ImportError: scipy is not installed.
        ValueError: there is no such minimiser.
    """
    result_of = needed("scipy.optimize", "scipy").OptimizeResult
    if optimizer not in _MINIMISERS:
        raise ValueError(f"there is no optimizer {optimizer!r}; there are {', '.join(_MINIMISERS)}")
    found, x0, bounds = initial_params.copy(), initial_params.as_vector(), initial_params.get_bounds()
    if x0.size == 0:
        _log.warning("no parameter is to be fitted: there are none, or all of them are frozen")
        return found, result_of(x=x0, jac=np.zeros((0, 0)), grad=np.zeros(0), extras={})

    def objective(x: Vector) -> Vector:
        return np.concatenate(residual_fn(x, found)[0])

    if check_conditioning:
        _warn_of_conditioning(objective, x0, bounds, float(optimizer_kwargs.get("diff_step", _STEP)))
    _warn_of_bounds(x0, bounds)
    options = {"max_iters": _ITERATIONS, "verbose": verbose, **optimizer_kwargs}
    result = result_of(**_MINIMISERS[optimizer](objective, x0, bounds, options))
    found.update_from_vector(result.x)
    if verbose:
        table = found.compare_parameters(x0, result.x, initial_params.as_nominal_vector())
        _log.info("\n%s", table)
    return found, result


def _jacobian(objective: Objective, x: Vector, bounds: Bounds, step: float) -> Vector:
    """The Jacobian `(nr, nx)`, all differences in one call."""
    column = x.reshape(-1, 1)
    limits = [bound.reshape(-1, 1) for bound in bounds]
    return minimize.jacobian_fd(objective, column, objective(x).reshape(-1, 1), step, 0, limits)[0]


def _by_mujoco(objective: Objective, x0: Vector, bounds: Bounds, options: dict[str, Any]) -> dict[str, Any]:
    limit, verbose = options.pop("max_iters"), options.pop("verbose")
    # Iterations are kept with all their details only where they are printed too.
    said = {} if verbose else {"output": io.StringIO()}
    x, trace = minimize.least_squares(
        x0,
        objective,
        bounds,
        **{"verbose": minimize.Verbosity.FULLITER, "max_iter": limit, **said, **options},
    )
    last = trace[-1]
    jac, grad = last.jacobian, last.grad
    if jac is None or grad is None:
        jac = _jacobian(objective, x, bounds, float(options.get("eps", _STEP)))
        grad = jac.T @ np.reshape(objective(x), (-1, 1))
    extras = {
        "objective": [entry.objective for entry in trace],
        "candidate": [entry.candidate[:, 0] for entry in trace],
    }
    return {"x": x, "jac": jac, "grad": grad, "extras": extras}


def _by_scipy(objective: Objective, x0: Vector, bounds: Bounds, options: dict[str, Any]) -> dict[str, Any]:
    limit, verbose = options.pop("max_iters"), options.pop("verbose")
    solve = needed("scipy.optimize", "scipy").least_squares
    return dict(solve(objective, x0, bounds=bounds, max_nfev=limit, verbose=2 if verbose else 0, **options))


def _by_scipy_in_parallel(objective: Objective, x0: Vector, bounds: Bounds, options: dict[str, Any]) -> dict[str, Any]:
    step = float(options.pop("diff_step", _STEP))
    jacobian = {"jac": lambda x: _jacobian(objective, x, bounds, step)}
    return _by_scipy(objective, x0, bounds, options | jacobian)


_MINIMISERS: dict[str, Callable[[Objective, Vector, Bounds, dict[str, Any]], dict[str, Any]]] = {
    "mujoco": _by_mujoco,
    "scipy": _by_scipy,
    "scipy_parallel_fd": _by_scipy_in_parallel,
}


def _warn_of_conditioning(objective: Objective, x0: Vector, bounds: Bounds, step: float) -> None:
    condition = float(np.linalg.cond(_jacobian(objective, x0, bounds, step))) ** 2
    if not condition <= _ILL_CONDITIONED:
        _log.warning(
            "cond(J^T J) is %.1e where the fit begins: the measured signals hardly tell the parameters apart. "
            "x_scale='jac' helps where these have different units, else fit fewer, or measure more",
            condition,
        )


def _warn_of_bounds(x0: Vector, bounds: Bounds) -> None:
    low, high = bounds
    width = high - low
    feasible = (width > 0) & (low <= x0) & (x0 <= high)
    at = feasible & (np.minimum(x0 - low, high - x0) <= _AT_BOUND * width)
    if at.any():
        _log.warning(
            "%d of %d numbers begin at a bound, where a fit may stay; ParameterDict.move_off_bounds() moves them inside",
            int(at.sum()),
            x0.size,
        )
