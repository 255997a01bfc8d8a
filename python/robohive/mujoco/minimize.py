"""Nonlinear least squares with bounds, by the names of MuJoCo's `minimize`.

`least_squares` takes Levenberg-Marquardt steps (Marquardt, "An algorithm for least-squares estimation of nonlinear parameters",
1963; Nocedal and Wright, "Numerical optimization", 2006, section 10.3): the norm's quadratic model with a regularizer `mu` on
the diagonal, within the bounds by `mju_boxQP`'s projected Newton steps. `mu` grows by a factor while a step reduces too little
(Armijo's rule) or less than a quarter of what the model promises, and shrinks, faster each time, while it reduces more than
three quarters.
"""

import abc
import dataclasses
import enum
import sys
import time
from collections.abc import Callable, Sequence
from typing import Any, TextIO

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco.functions.box import _descend

Vector = NDArray[np.float64]
Residual = Callable[[Vector], Vector]

#: Armijo's share of the reduction that the slope promises; ratios of reductions at which `mu` grows and shrinks.
_ARMIJO, _POOR, _GOOD = 1e-2, 0.25, 0.75
#: How near derivatives are that agree with differences, relative to the largest.
_AGREES = 1e-6


class Verbosity(enum.Enum):
    """What is printed; with `FULLITER` the trace keeps residuals, Jacobians, gradients and steps too."""

    SILENT = 0
    FINAL = 1
    ITER = 2
    FULLITER = 3


class Status(enum.Enum):
    """Why a minimisation ended."""

    FACTORIZATION_FAILED = enum.auto()
    NO_IMPROVEMENT = enum.auto()
    MAX_ITER = enum.auto()
    DX_TOL = enum.auto()
    G_TOL = enum.auto()


_ENDS = {
    Status.FACTORIZATION_FAILED: "the model has no minimum.",
    Status.NO_IMPROVEMENT: "no step reduces enough.",
    Status.MAX_ITER: "maximum iterations reached.",
    Status.DX_TOL: "norm(dx) < tol.",
    Status.G_TOL: "norm(gradient) < tol.",
}


@dataclasses.dataclass(frozen=True)
class IterLog:
    """One iteration: the point it begins at, the objective there, how much a step with this regularizer reduces it; the rest
    is kept with `Verbosity.FULLITER`."""

    candidate: Vector
    objective: Any
    reduction: Any
    regularizer: Any
    residual: Vector | None = None
    jacobian: Vector | None = None
    grad: Vector | None = None
    step: Vector | None = None


class Norm(abc.ABC):
    """How large a residual is."""

    @abc.abstractmethod
    def value(self, r: Vector) -> Any:
        """The norm of a residual, a column `(nr, 1)`."""

    @abc.abstractmethod
    def grad_hess(self, r: Vector, proj: Vector) -> tuple[Vector, Vector]:
        """Gradient `proj' g` and Hessian `proj' H proj` at a residual, for the Jacobian `proj` `(nr, nx)`."""


class Quadratic(Norm):
    """Half the sum of squares."""

    def value(self, r: Vector) -> Any:
        """`r'r / 2`."""
        return 0.5 * (r.T @ r).item()

    def grad_hess(self, r: Vector, proj: Vector) -> tuple[Vector, Vector]:
        """`proj' r` and `proj' proj`."""
        return proj.T @ r, proj.T @ proj


class _Regularizer:
    """`mu`, which starts at 0."""

    def __init__(self, least: float, most: float, factor: float) -> None:
        if factor <= 1:
            raise ValueError("mu_factor must be > 1.")
        self.value, self._least, self._most, self._factor = 0.0, least, most, factor
        self._shrunk = 0

    def grow(self) -> bool:
        """Whether it may grow; then it does."""
        if self.value >= self._most:
            return False
        self.value = max(self._least, self._factor * self.value)
        self._shrunk = 0
        return True

    def shrink(self) -> None:
        """Shrinks by a factor whose power doubles each time, in the end to 0."""
        less = self.value * self._factor ** -(2.0**self._shrunk)
        self.value = less if less >= self._least else 0.0
        self._shrunk = min(self._shrunk + 1, 30)


def _columns(n: int, bounds: Sequence[ArrayLike] | None) -> tuple[Vector, Vector] | None:
    """Lower and upper bounds as columns.

    Raises:
        ValueError: these are not two vectors of `n` finite numbers, the first below the second.
    """
    if bounds is None:
        return None
    if len(bounds) != 2:
        raise ValueError(f"bounds are a lower and an upper vector, not {len(bounds)} values")
    low, high = (np.asarray(bound, np.float64) for bound in bounds)
    if low.size != n or high.size != n:
        raise ValueError(f"bounds have {low.size} and {high.size} numbers instead of {n}")
    if not np.isfinite([low, high]).all():
        raise ValueError("bounds are finite numbers")
    if (low >= high).any():
        raise ValueError("each lower bound is below the upper one")
    return low.reshape(n, 1), high.reshape(n, 1)


def _scales(n: int, x_scale: Any) -> Vector | None:
    """The scale of each variable; None where the Jacobian gives it.

    Raises:
        ValueError: it is neither "jac" nor positive, finite numbers.
    """
    if isinstance(x_scale, str):
        if x_scale != "jac":
            raise ValueError(f"x_scale is None, 'jac', a positive number or {n} of them, not {x_scale!r}")
        return None
    scale = np.asarray(1.0 if x_scale is None else x_scale, np.float64)
    if scale.shape not in ((), (n,)):
        raise ValueError(f"x_scale has the shape {scale.shape} instead of ({n},)")
    if not np.isfinite(scale).all() or (scale <= 0).any():
        raise ValueError("x_scale is positive and finite")
    return np.full((n, 1), 1.0) * scale.reshape(-1, 1)


def _norms(jacobian: Vector) -> Vector:
    """1 / length of each column, 1 of those that are zero."""
    lengths = np.linalg.norm(jacobian, axis=0).reshape(-1, 1)
    return np.asarray(1.0 / np.where(lengths > 0, lengths, 1.0))


def least_squares(
    x0: Vector,
    residual: Residual,
    bounds: Sequence[ArrayLike] | None = None,
    jacobian: Callable[[Vector, Vector], Vector] | None = None,
    norm: Norm | None = None,
    eps: float = np.finfo(np.float64).eps ** 0.5,
    mu_min: float = 1e-6,
    mu_max: float = 1e8,
    mu_factor: float = 10.0**0.1,
    xtol: float = 1e-8,
    gtol: float = 1e-8,
    max_iter: int = 100,
    verbose: Verbosity | int = Verbosity.ITER,
    output: TextIO | None = None,
    iter_callback: Callable[[list[IterLog]], None] | None = None,
    check_derivatives: bool = False,
    x_scale: float | Vector | str | None = None,
) -> tuple[Vector, list[IterLog]]:
    """Minimises the norm of a residual, within bounds.

    Args:
        x0: where to begin, `(nx,)`.
        residual: from points `(nx, k)`, one in each column, to residuals `(nr, k)`.
        bounds: least and largest values, each `(nx,)`.
        jacobian: of the residual, `(nr, nx)`, from a point `(nx, 1)` and its residual; differences where it is None.
        norm: what is minimised; half the sum of squares where it is None.
        eps: size of differences.
        mu_min: least regularizer but 0.
        mu_max: largest regularizer.
        mu_factor: how the regularizer grows and shrinks.
        xtol: ends when a step is shorter than this times `xtol` and the length of the point together.
        gtol: ends when the gradient, without what points out of the bounds, is no longer than this.
        max_iter: steps at most.
        verbose: what is printed.
        output: where it is printed, the standard output by default.
        iter_callback: called with the trace after each iteration.
        check_derivatives: compares `jacobian` and the derivatives of `norm` with differences first.
        x_scale: the problem is solved in `x / x_scale`: a number, one for each variable, or "jac" for one over the length of
            each column of the Jacobian.

    Returns:
        The best point `(nx,)`, and the iterations.

    Raises:
        ValueError: bounds, scales or factor do not fit, or a derivative is not what differences say.
    """
    n, level = x0.size, Verbosity(verbose).value
    regularizer = _Regularizer(mu_min, mu_max, mu_factor)
    limits, scales = _columns(n, bounds), _scales(n, x_scale)
    problem = _Problem(residual, jacobian, Quadratic() if norm is None else norm, float(eps), limits)
    x = np.array(x0, np.float64).reshape(n, 1)
    if limits is not None:
        x = np.clip(x, *limits)
    say = _Printer(level, output)
    if check_derivatives:
        problem.check(x, say)
    trace: list[IterLog] = []
    status, began = Status.MAX_ITER, time.perf_counter()
    state = problem.at(x)
    for iteration in range(max_iter + 1):
        jac = problem.jacobian_at(x, state[1])
        gradient, hessian = problem.norm.grad_hess(state[1], jac)
        gradient = gradient.reshape(n, 1)
        details = {"residual": state[1], "jacobian": jac, "grad": gradient} if level == 3 else {}
        slope = float(np.linalg.norm(_inward(x, gradient, limits)))
        step = None
        if slope <= gtol:
            status = Status.G_TOL
            if slope == 0:
                say(2, "The gradient is zero: exact minimum found?")
        elif iteration < max_iter:
            scale = _norms(jac) if scales is None else scales
            step = _step(problem, x, state, (gradient, hessian), scale, regularizer)
            status = step.status or status
        if step is None or step.status is not None:
            trace.append(IterLog(x.copy(), state[0], 0.0, regularizer.value, **details))
            break
        details.update({"step": step.change} if level == 3 else {})
        trace.append(IterLog(x.copy(), state[0], state[0] - step.state[0], step.regularizer, **details))
        say(2, f"iter: {iteration:<3d} obj: {state[0]:<11.5g} reduction: {state[0] - step.state[0]:<10.3g} mu: {step.regularizer:.3g}")
        if iter_callback is not None:
            iter_callback(trace)
        length, size = float(np.linalg.norm(step.change)), float(np.linalg.norm(x))
        x, state = step.point, step.state
        if length < xtol * (xtol + size):
            status = Status.DX_TOL
            trace.append(IterLog(x.copy(), state[0], 0.0, regularizer.value))
            break
    if iter_callback is not None:
        iter_callback(trace)
    say(1, f"Terminated after {len(trace) - 1} iterations: {_ENDS[status]} obj: {state[0]:.5g}")
    say(1, f"{problem.calls} residuals, {time.perf_counter() - began:.3g} s")
    return x.ravel(), trace


class _Printer:
    """Prints what the level allows."""

    def __init__(self, level: int, output: TextIO | None) -> None:
        self._level, self._output = level, output

    def __call__(self, level: int, text: str) -> None:
        if self._level >= level:
            print(text, file=sys.stdout if self._output is None else self._output)


def _inward(x: Vector, gradient: Vector, limits: tuple[Vector, Vector] | None) -> Vector:
    """The gradient without what points out of the bounds at which the point stands."""
    if limits is None:
        return gradient
    held = ((x <= limits[0]) & (gradient > 0)) | ((x >= limits[1]) & (gradient < 0))
    return np.where(held, 0.0, gradient)


#: Objective and residual `(nr, 1)` at a point.
_State = tuple[Any, Vector]


@dataclasses.dataclass
class _Problem:
    """What is minimised."""

    residual: Residual
    given: Callable[[Vector, Vector], Vector] | None
    norm: Norm
    eps: float
    limits: tuple[Vector, Vector] | None
    calls: int = 0

    def at(self, x: Vector) -> _State:
        """Objective and residual."""
        self.calls += 1
        r = np.asarray(self.residual(x), np.float64).reshape(-1, 1)
        return self.norm.value(r), r

    def jacobian_at(self, x: Vector, r: Vector) -> Vector:
        """The Jacobian, given or by differences."""
        if self.given is not None:
            return np.asarray(self.given(x, r), np.float64)
        return self._difference(x, r)

    def _difference(self, x: Vector, r: Vector) -> Vector:
        jac, self.calls = jacobian_fd(self.residual, x, r, self.eps, self.calls, self.limits)
        return jac

    def check(self, x: Vector, say: _Printer) -> None:
        """Compares given derivatives with differences; see `least_squares`."""
        r = self.at(x)[1]
        if self.given is not None:
            check_jacobian(self.given(x, r), self._difference(x, r))
            say(1, "User-provided Jacobian matches finite-differences.")
        if not isinstance(self.norm, Quadratic):
            check_norm(r, self.norm, self.eps)
            say(1, "User-provided norm gradient matches finite-differences.")
            say(1, "User-provided norm Hessian matches finite-differences.")


@dataclasses.dataclass
class _Step:
    """A step that reduces enough, or why there is none."""

    point: Vector
    change: Vector
    state: _State
    regularizer: float
    status: Status | None = None


def _step(
    problem: _Problem,
    x: Vector,
    state: _State,
    slopes: tuple[Vector, Vector],
    scale: Vector,
    regularizer: _Regularizer,
) -> _Step:
    """The step from `x`, in scaled variables, with the least regularizer from the present one on that reduces enough;
    `slopes` are gradient and Hessian."""
    (gradient, hessian), n = slopes, x.size
    g, h = scale * gradient, scale * hessian * scale.T
    infinite = np.full(n, np.inf)
    low, high = (-infinite, infinite) if problem.limits is None else (((b - x) / scale).ravel() for b in problem.limits)
    while True:
        used = regularizer.value
        change, _, factor = _descend(h + used * np.eye(n), g.ravel(), np.zeros(n), low, high)
        failed = Status.FACTORIZATION_FAILED if factor is None else Status.NO_IMPROVEMENT
        if factor is not None:
            dx = scale * change.reshape(n, 1)
            point = x + dx if problem.limits is None else np.clip(x + dx, *problem.limits)
            new = problem.at(point)
            reduction, promised = state[0] - new[0], -float((gradient.T @ dx).item())
            if promised > 0 and reduction >= _ARMIJO * promised:
                modelled = promised - 0.5 * float((dx.T @ hessian @ dx).item())
                if reduction > _GOOD * modelled:
                    regularizer.shrink()
                elif reduction < _POOR * modelled:
                    regularizer.grow()
                return _Step(point, point - x, new, used)
        if not regularizer.grow():
            return _Step(x, np.zeros_like(x), state, used, failed)


def jacobian_fd(
    residual: Residual, x: Vector, r: Vector, eps: float, n_res: int, bounds: Sequence[Vector] | None = None
) -> tuple[Vector, int]:
    """The Jacobian by differences of size `eps`, all in one call of `residual`, each away from the nearer bound; and `n_res`
    plus the number of points."""
    n = x.size
    steps = np.full((n, 1), eps)
    if bounds is not None:
        middle = 0.5 * (np.reshape(bounds[0], (n, 1)) + np.reshape(bounds[1], (n, 1)))
        steps = np.where(x > middle, -steps, steps)
    values = np.asarray(residual(x + np.diag(steps.ravel())), np.float64).reshape(-1, n)
    return (values - r.reshape(-1, 1)) / steps.T, n_res + n


def _agrees(given: Vector, differences: Vector) -> bool:
    largest = max(1.0, float(np.abs(differences).max(initial=0.0)))
    return given.shape == differences.shape and bool(np.abs(given - differences).max(initial=0.0) <= _AGREES * largest)


def check_jacobian(given: Vector, differences: Vector) -> None:
    """Compares a Jacobian with differences.

    Raises:
        ValueError: it is another.
    """
    if not _agrees(np.asarray(given, np.float64), differences):
        raise ValueError("User-provided Jacobian does not match finite-differences")


def check_norm(r: Vector, norm: Norm, eps: float) -> None:
    """Compares the derivatives of a norm at a residual with differences.

    Raises:
        ValueError: one is another, or the Hessian is not symmetric or not positive definite.
    """
    n, unit = r.size, np.eye(r.size)
    gradient, hessian = norm.grad_hess(r, unit)
    points = [(r + eps * unit[:, [i]], r - eps * unit[:, [i]]) for i in range(n)]
    slopes = np.array([(float(norm.value(a)) - float(norm.value(b))) / (2 * eps) for a, b in points])
    if not _agrees(gradient.ravel(), slopes):
        raise ValueError("User-provided norm gradient does not match finite-differences")
    if np.abs(hessian - hessian.T).max() > 1e-6 * max(1.0, float(np.abs(hessian).max())):
        raise ValueError("User-provided norm Hessian is not symmetric")
    if np.linalg.eigvalsh(hessian).min() < -1e-9 * max(1.0, float(np.abs(hessian).max())):
        raise ValueError("User-provided norm Hessian is not positive definite")
    turns = [(norm.grad_hess(a, unit)[0] - norm.grad_hess(b, unit)[0]).ravel() / (2 * eps) for a, b in points]
    if not _agrees(hessian, np.array(turns).T):
        raise ValueError("User-provided norm Hessian does not match finite-differences")
