"""The inertia matrix by its factor, inverse dynamics in parts, and constraint forces at given residuals."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco.enums.physics import mjtCone, mjtConstraint, mjtConstraintState
from robohive.mujoco.functions.out import Vector, destination, vector, write
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel


def _factor(m: MjModel, d: MjData) -> tuple[Vector, Vector]:
    """`L` and the diagonal `D` of the inertia matrix, which is `L' D L`."""
    lower, last = np.eye(m.nv), m.M_rowadr + m.M_rownnz - 1
    for i in range(m.nv):
        off = slice(m.M_rowadr[i], last[i])
        lower[i, m.M_colind[off]] = d.qLD[off]
    return lower, d.qLD[last]


def mj_mulM2(m: MjModel, d: MjData, res: Vector, vec: ArrayLike) -> None:
    """`res = sqrt(D) L vec`, whose square is the kinetic energy's: the inertia matrix is `L' D L`."""
    destination(res, "res", "size nv", (m.nv,))
    lower, diagonal = _factor(m, d)
    write(res, np.sqrt(diagonal) * (lower @ vector(vec, "vec", m.nv)))


def mj_solveM2(m: MjModel, d: MjData, x: Vector, y: ArrayLike, sqrtInvD: ArrayLike) -> None:
    """`x = sqrtInvD inv(L') y` for every row of `y` (`n x nv`)."""
    right = np.atleast_2d(np.asarray(y, np.float64))
    destination(x, "x", "the shape of y", np.shape(y))
    if right.shape[1] != m.nv:
        raise TypeError(f"y must have nv = {m.nv} columns")
    lower, _ = _factor(m, d)
    write(x, np.linalg.solve(lower.T, right.T).T * np.ravel(sqrtInvD))


def mj_addM(
    m: MjModel,
    d: MjData,
    dst: Vector,
    rownnz: NDArray[np.int32] | None = None,
    rowadr: NDArray[np.int32] | None = None,
    colind: NDArray[np.int32] | None = None,
) -> None:
    """Adds the inertia matrix to `dst`: in compressed rows, where its pattern is given and has room for it, or the lower
    triangle of a dense matrix (`nv x nv`).

    Raises:
        TypeError: the pattern lacks an entry of the inertia matrix.
    """
    full = np.zeros((m.nv, m.nv))
    for i in range(m.nv):
        row = slice(m.M_rowadr[i], m.M_rowadr[i] + m.M_rownnz[i])
        full[i, m.M_colind[row]] = d.M[row]
    if rownnz is None or rowadr is None or colind is None:
        destination(dst, "dst", "size nv * nv", (m.nv * m.nv,))
        write(dst, np.ravel(dst) + full.ravel())
        return
    for i in range(m.nv):
        row = slice(int(rowadr[i]), int(rowadr[i]) + int(rownnz[i]))
        if np.setdiff1d(np.flatnonzero(full[i]), colind[row]).size:
            raise TypeError(f"row {i} of the pattern has no room for the inertia matrix")
        dst[row] += full[i, colind[row]]


def mj_inverseSkip(m: MjModel, d: MjData, skipstage: int, skipsensor: int) -> None:
    """`mj_inverse` without the stages before `skipstage` (`mjtStage`), and without sensors where `skipsensor`."""
    _core.inverse_skip(m, d, int(skipstage), not skipsensor)


def mj_constraintUpdate(m: MjModel, d: MjData, jar: ArrayLike, cost: Vector | None, flg_coneHessian: int) -> None:
    """Forces and states of the constraint rows at residuals `jar`, their sum in `qfrc_constraint`, and into `cost` (1) what
    they cost. Hessians of cones are kept inside of the engine, whatever `flg_coneHessian` says."""
    residual = vector(jar, "jar", d.nefc)
    if cost is not None:
        destination(cost, "cost", "size 1", (1,))
    _core.forces_at(m, d, residual.tolist())
    if cost is not None:
        write(cost, _cost(m, d, residual))


def _cost(m: MjModel, d: MjData, residual: Vector) -> float:
    """Cost of the rows by their states (MuJoCo documentation, Computation, "Primal")."""
    state, loss = d.efc_state, d.efc_frictionloss
    half = 0.5 * d.efc_D * residual**2
    slack = loss * (np.abs(residual) - 0.5 * d.efc_R * loss)
    quadratic = state == mjtConstraintState.mjCNSTRSTATE_QUADRATIC
    linear = np.isin(state, (mjtConstraintState.mjCNSTRSTATE_LINEARNEG, mjtConstraintState.mjCNSTRSTATE_LINEARPOS))
    total = float(half[quadratic].sum() + slack[linear].sum())
    if m.opt.cone != mjtCone.mjCONE_ELLIPTIC:
        return total
    elliptic = d.efc_type == int(mjtConstraint.mjCNSTR_CONTACT_ELLIPTIC)
    for contact in d.contact:
        at = contact.efc_address
        if at < 0 or not elliptic[at] or state[at] != mjtConstraintState.mjCNSTRSTATE_CONE:
            continue
        across = np.linalg.norm(residual[at + 1 : at + contact.dim] * contact.friction[: contact.dim - 1])
        depth = contact.mu * (residual[at] * 1.0) - contact.mu * across
        total += 0.5 * d.efc_D[at] / (contact.mu**2 * (1.0 + contact.mu**2)) * float(depth) ** 2
    return total
