"""Matrices of dynamics, positions and velocities, states as vectors."""

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco import _engine as _core
from robohive.mujoco.functions.out import Vector, destination, vector, write
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel


def mj_fullM(m: MjModel, d: MjData, dst: Vector) -> None:
    """The inertia matrix of the last forward pass, dense, into `dst` (`nv x nv`)."""
    destination(dst, "dst", "shape (nv, nv)", (m.nv, m.nv))
    write(dst, _core.full_matrix(m, d))


def mj_mulM(m: MjModel, d: MjData, res: Vector, vec: ArrayLike) -> None:
    """`res = M vec`."""
    destination(res, "res", "size nv", (m.nv,))
    write(res, _core.mul_inertia(m, d, vector(vec, "vec", m.nv)))


def mj_solveM(m: MjModel, d: MjData, x: Vector, y: ArrayLike) -> None:
    """`M x = y` for every row of `y` (`n x nv`)."""
    right = np.ascontiguousarray(y, np.float64)
    if right.shape[-1] != m.nv:
        raise TypeError("the shape of y must be (n, nv)")
    destination(x, "x", "the shape of y", right.shape)
    write(x, _core.solve_inertia(m, d, right.ravel()))


def mj_mulJacVec(m: MjModel, d: MjData, res: Vector, vec: ArrayLike) -> None:
    """`res = J vec` with the Jacobian of the constraint rows."""
    destination(res, "res", "size nefc", (d.nefc,))
    write(res, _core.dense_jacobian(d, m.nv).reshape(d.nefc, m.nv) @ vector(vec, "vec", m.nv))


def mj_mulJacTVec(m: MjModel, d: MjData, res: Vector, vec: ArrayLike) -> None:
    """`res = J' vec` with the Jacobian of the constraint rows."""
    destination(res, "res", "size nv", (m.nv,))
    write(res, _core.dense_jacobian(d, m.nv).reshape(d.nefc, m.nv).T @ vector(vec, "vec", d.nefc))


def mj_rne(m: MjModel, d: MjData, flg_acc: int, result: Vector) -> None:
    """Forces that the bodies need at the present velocity, with `flg_acc` also at the present acceleration."""
    destination(result, "result", "size nv", (m.nv,))
    write(result, _core.newton_euler(m, d, bool(flg_acc)))


def mj_integratePos(m: MjModel, qpos: Vector, qvel: ArrayLike, dt: float) -> None:
    """Moves `qpos` with velocity `qvel` for `dt` [s]."""
    destination(qpos, "qpos", "size nq", (m.nq,))
    write(qpos, _core.moved(m, vector(qpos, "qpos", m.nq), vector(qvel, "qvel", m.nv), dt))


def mj_differentiatePos(m: MjModel, qvel: Vector, dt: float, qpos1: ArrayLike, qpos2: ArrayLike) -> None:
    """The velocity that moves `qpos1` to `qpos2` in `dt` [s]."""
    destination(qvel, "qvel", "size nv", (m.nv,))
    write(qvel, _core.difference(m, vector(qpos1, "qpos1", m.nq), vector(qpos2, "qpos2", m.nq), dt))


def mj_normalizeQuat(m: MjModel, qpos: Vector) -> None:
    """Scales all quaternions in `qpos` to unit length."""
    destination(qpos, "qpos", "size nq", (m.nq,))
    for joint in range(m.njnt):
        if m.jnt_type[joint] < 2:
            start = m.jnt_qposadr[joint] + 3 * (m.jnt_type[joint] == 0)
            qpos[start : start + 4] = _core.normalise(qpos[start : start + 4])


def mj_stateSize(m: MjModel, sig: int) -> int:
    """Number of scalars of a state with the bits `sig` (`mjtState`).

    Raises:
        FatalError: there are other bits.
    """
    return _core.state_size(m, int(sig))


def mj_getState(m: MjModel, d: MjData, state: Vector, sig: int) -> None:
    """The parts of the state that `sig` names, into `state`."""
    _check_state(m, state, sig)
    write(state, _core.get_state(m, d, int(sig)))


def mj_setState(m: MjModel, d: MjData, state: ArrayLike, sig: int) -> None:
    """Overwrites the parts of the state that `sig` names."""
    _check_state(m, state, sig)
    _core.set_state(m, d, vector(state, "state"), int(sig))


def _check_state(m: MjModel, state: ArrayLike, sig: int) -> None:
    if np.size(state) != mj_stateSize(m, sig):
        raise TypeError("state size should equal mj_stateSize(m, sig)")


def mj_copyState(m: MjModel, src: MjData, dst: MjData, sig: int) -> None:
    """Copies the parts of the state that `sig` names."""
    _core.set_state(m, dst, _core.get_state(m, src, int(sig)), int(sig))


def mj_extractState(m: MjModel, src: ArrayLike, srcsig: int, dst: Vector, dstsig: int) -> None:
    """Takes a part, `dstsig`, of a state vector of signature `srcsig`.

    Raises:
        ValueError: `dstsig` names more than `srcsig`.
    """
    if int(dstsig) & ~int(srcsig):
        raise ValueError("the bits dstsig are no part of srcsig")
    values = vector(src, "src", mj_stateSize(m, srcsig))
    parts, start = [], 0
    for bit in range(14):
        if srcsig & (1 << bit):
            size = mj_stateSize(m, 1 << bit)
            parts += [values[start : start + size]] if dstsig & (1 << bit) else []
            start += size
    destination(dst, "dst", "size mj_stateSize", (mj_stateSize(m, dstsig),))
    write(dst, np.concatenate(parts) if parts else np.zeros(0))


def mj_copyData(dest: MjData, m: MjModel, src: MjData) -> MjData:
    """Copies everything of a simulation."""
    dest._assign(src)
    return dest


def mj_setConst(m: MjModel, d: MjData) -> None:
    """Recomputes what follows from masses, poses and gears at `qpos0`: inverse weights, lengths, statistics."""
    m._set_const()


def mj_setKeyframe(m: MjModel, d: MjData, k: int) -> None:
    """Overwrites keyframe `k` of the model by the present state.

    Raises:
        FatalError: the model has no such keyframe.
    """
    if not 0 <= k < m.nkey:
        raise _core.FatalError(f"mj_setKeyframe: index must be smaller than {m.nkey} (keyframes allocated in model)")
    m.key_time[k] = d.time
    pairs = (("qpos", d.qpos), ("qvel", d.qvel), ("act", d.act), ("ctrl", d.ctrl), ("mpos", d.mocap_pos), ("mquat", d.mocap_quat))
    for field, values in pairs:
        write(getattr(m, f"key_{field}")[k], values)
