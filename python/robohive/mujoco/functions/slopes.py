"""Derivatives: of one step, of inverse dynamics, of differences and integration of quaternions."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco import _engine as _core
from robohive.mujoco.functions import stages
from robohive.mujoco.functions.algebra import mj_integratePos
from robohive.mujoco.functions.out import Vector, destination, vector, write
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel


def mjd_transitionFD(
    m: MjModel, d: MjData, eps: float, flg_centered: bool, A: Any = None, B: Any = None, C: Any = None, D: Any = None
) -> None:
    """Linearises one step by finite differences of size `eps`.

    `A` (`2nv+na` squared) takes the slopes of the next state with the state, `B` with the controls, `C` and `D` those of
    the sensors.
    """
    state, results = 2 * m.nv + m.na, _core.step_slopes(m, d, eps, bool(flg_centered))
    shapes = ((state, state), (state, m.nu), (m.nsensordata, state), (m.nsensordata, m.nu))
    for out, name, shape, values in zip((A, B, C, D), "ABCD", shapes, results, strict=True):
        if out is not None:
            destination(out, name, f"shape {shape}", shape)
            write(out, values)


def mjd_inverseFD(
    m: MjModel,
    d: MjData,
    eps: float,
    flg_actuation: bool,
    DfDq: Any = None,
    DfDv: Any = None,
    DfDa: Any = None,
    DsDq: Any = None,
    DsDv: Any = None,
    DsDa: Any = None,
    DmDq: Any = None,
) -> None:
    """Linearises inverse dynamics by forward differences of size `eps`.

    Rows of `DfDq`, `DfDv`, `DfDa` (`nv x nv`) hold the change of the forces with one coordinate, velocity or acceleration;
    those of `DsD.` (`nv x nsensordata`) the change of the sensors, those of `DmDq` (`nv x nC`) of the inertia matrix. With
    `flg_actuation` actuator forces are subtracted.
    """
    places = {"q": (DfDq, DsDq, DmDq), "v": (DfDv, DsDv, None), "a": (DfDa, DsDa, None)}
    widths = (m.nv, m.nsensordata, m.nC)
    for letter, outs in places.items():
        for out, what, width in zip(outs, "fsm", widths, strict=True):
            if out is not None:
                destination(out, f"D{what}D{letter}", f"shape ({m.nv}, {width})", (m.nv, width))
    if flg_actuation or any(out is not None for out in (DsDq, DsDv, DsDa, DmDq)):
        _difference(m, d, eps, flg_actuation, places)
        return
    for out, values in zip((DfDq, DfDv, DfDa), _core.inverse_slopes(m, d, eps), strict=True):
        if out is not None:
            write(out, values)


def _difference(m: MjModel, d: MjData, eps: float, actuation: bool, places: dict[str, tuple[Any, ...]]) -> None:
    """Differences of forces, sensors and inertia, one coordinate after another."""

    def look() -> tuple[Vector, Vector, Vector]:
        _core.mj_inverse(m, d)
        forces = d.qfrc_inverse.copy()
        if actuation:
            stages.mj_fwdActuation(m, d)
            forces -= d.qfrc_actuator
        return forces, d.sensordata.copy(), d.M.copy()

    given = {"q": d.qpos.copy(), "v": d.qvel.copy(), "a": d.qacc.copy()}
    arrays = {"q": d.qpos, "v": d.qvel, "a": d.qacc}
    base = look()
    for letter, outs in places.items():
        if all(out is None for out in outs):
            continue
        for i in range(m.nv):
            if letter == "q":
                mj_integratePos(m, d.qpos, np.eye(m.nv)[i], eps)
            else:
                arrays[letter][i] += eps
            for out, now, before in zip(outs, look(), base, strict=True):
                if out is not None:
                    write(out[i], (now - before) / eps)
            arrays[letter][:] = given[letter]
    look()


def _skew(v: Vector) -> Vector:
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _right_jacobian(v: Vector) -> Vector:
    """How the rotation `exp(v)` turns, in its own frame, with `v` (Solà, Deray and Atchuthan, "A micro Lie theory",
    2018, equation 143)."""
    angle, cross = float(np.linalg.norm(v)), _skew(v)
    if angle < 1e-8:
        return np.eye(3) - 0.5 * cross
    first, second = (1 - math.cos(angle)) / angle**2, (angle - math.sin(angle)) / angle**3
    return np.asarray(np.eye(3) - first * cross + second * cross @ cross)


def _give(out: Any, name: str, values: Vector) -> None:
    if out is None:
        return
    if not isinstance(out, np.ndarray) or out.size != values.size:
        raise TypeError(f"{name} should be a numpy array of {values.size} numbers")
    write(out, values)


def mjd_subQuat(qa: ArrayLike, qb: ArrayLike, Da: Any = None, Db: Any = None) -> None:
    """Slopes (`3 x 3`) of `mju_subQuat` as `qa`, and as `qb`, turns in its own frame (Solà et al., equation 144)."""
    a, b = vector(qa, "qa", 4), vector(qb, "qb", 4)
    turn = np.array(_core.subtract(a, b))
    slope: Vector = np.asarray(np.linalg.inv(_right_jacobian(turn)), np.float64)
    _give(Da, "Da", slope)
    _give(Db, "Db", -slope.T)


def mjd_quatIntegrate(vel: ArrayLike, scale: float, Dquat: Any = None, Dvel: Any = None, Dscale: Any = None) -> None:
    """Slopes of `mju_quatIntegrate`, all in the turned frame: as the quaternion turns in its own frame (`3 x 3`), with
    `scale` times the velocity (`3 x 3`), with the duration (3)."""
    speed = vector(vel, "vel", 3)
    turn = scale * speed
    angle = float(np.linalg.norm(turn))
    axis = turn / angle if angle > 0 else np.array([1.0, 0.0, 0.0])
    back = np.reshape(_core.matrix(_core.of_axis_angle(axis, -angle)), (3, 3))
    _give(Dquat, "Dquat", back)
    _give(Dvel, "Dvel", _right_jacobian(turn))
    _give(Dscale, "Dscale", speed)
