"""Passes and steps that call callbacks: stage by stage, in the order of `mj_forward` and `mj_step` (MuJoCo documentation,
Computation, "Forward dynamics")."""

from collections.abc import Iterator
from contextlib import contextmanager
from numbers import Real
from typing import Any

import numpy as np

from robohive.mujoco import callbacks
from robohive.mujoco._constants import mjMINVAL
from robohive.mujoco.enums.elements import mjtDyn, mjtSensor
from robohive.mujoco.enums.physics import mjtDisableBit, mjtIntegrator, mjtStage
from robohive.mujoco.functions import stages
from robohive.mujoco.functions.algebra import mj_integratePos
from robohive.mujoco.functions.out import Vector
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel


@contextmanager
def _timed() -> Iterator[None]:
    """Asks the clock, where one is set, before and after."""
    _now()
    yield
    _now()


def _now() -> None:
    clock = callbacks.get_mjcb_time()
    if clock is not None and not isinstance(clock(), Real):
        raise TypeError("mjcb_time callback did not return a number")


def _call(callback: Any, *arguments: Any) -> None:
    if callback is not None:
        callback(*arguments)


def _sensors(m: MjModel, d: MjData, stage: mjtStage) -> None:
    """Has user sensors of a stage read, where there are some."""
    if (np.asarray(m.sensor_type) == int(mjtSensor.mjSENS_USER))[np.asarray(m.sensor_needstage) == int(stage)].any():
        _call(callbacks.get_mjcb_sensor(), m, d, stage)


def _position_and_velocity(m: MjModel, d: MjData, skipstage: int) -> None:
    if skipstage < int(mjtStage.mjSTAGE_POS):
        stages.mj_fwdPosition(m, d)
        stages.mj_sensorPos(m, d)
        _sensors(m, d, mjtStage.mjSTAGE_POS)
    if skipstage < int(mjtStage.mjSTAGE_VEL):
        stages.mj_fwdVelocity(m, d)
        _call(callbacks.get_mjcb_passive(), m, d)
        stages.mj_sensorVel(m, d)
        _sensors(m, d, mjtStage.mjSTAGE_VEL)


def _control(m: MjModel, d: MjData) -> None:
    if not int(m.opt.disableflags) & int(mjtDisableBit.mjDSBL_ACTUATION):
        _call(callbacks.get_mjcb_control(), m, d)


def _acceleration(m: MjModel, d: MjData) -> None:
    stages.mj_fwdActuation(m, d)
    stages.mj_fwdAcceleration(m, d)
    stages.mj_fwdConstraint(m, d)
    stages.mj_sensorAcc(m, d)
    _sensors(m, d, mjtStage.mjSTAGE_ACC)


def forward(m: MjModel, d: MjData, skipstage: int = 0) -> None:
    """`mj_forward`, or the part of it after a stage."""
    with _timed():
        _position_and_velocity(m, d, int(skipstage))
        _control(m, d)
        _acceleration(m, d)


def _advanced(m: MjModel, act: Vector, rates: Vector) -> Vector:
    """Activations after a time step with these rates."""
    rates, step = rates.copy(), float(m.opt.timestep)
    for i in range(m.nactuator):
        if m.actuator_dyntype[i] == int(mjtDyn.mjDYN_FILTEREXACT):
            constant = max(mjMINVAL, m.actuator_dynprm[i, 0])
            at = slice(m.actuator_actadr[i], m.actuator_actadr[i] + m.actuator_actnum[i])
            rates[at] *= constant * -np.expm1(-step / constant) / step
    after = act + step * rates
    for i in np.flatnonzero(m.actuator_actlimited).tolist():
        at = slice(m.actuator_actadr[i], m.actuator_actadr[i] + m.actuator_actnum[i])
        after[at] = np.clip(after[at], *m.actuator_actrange[i])
    return after


#: Weights of earlier slopes at the inner passes of the classical Runge-Kutta method, and of all slopes at the end.
_INNER, _END = (0.5, 0.5, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)


def _runge_kutta(m: MjModel, d: MjData) -> None:
    """Advances by the classical Runge-Kutta method of order 4 (MuJoCo documentation, Computation, "Numerical integration")."""
    step, time = float(m.opt.timestep), d.time
    qpos, qvel, act = d.qpos.copy(), d.qvel.copy(), d.act.copy()

    def slopes() -> tuple[Vector, Vector, Vector]:
        return d.qvel.copy(), d.qacc.copy(), d.act_dot.copy()

    def move(rates: tuple[Vector, Vector, Vector], to: float) -> None:
        d.qpos[:], d.qvel[:] = qpos, qvel + step * rates[1]
        mj_integratePos(m, d.qpos, rates[0], step)
        d.time = time + to * step

    known = [slopes()]
    for weight in _INNER:
        last = known[-1]
        move((weight * last[0], weight * last[1], last[2]), weight)
        d.act[:] = act + weight * step * last[2]
        forward(m, d)
        known.append(slopes())
    mean = [sum(w * rates[part] for w, rates in zip(_END, known, strict=True)) for part in range(3)]
    move((np.asarray(mean[0]), np.asarray(mean[1]), np.asarray(mean[2])), 1.0)
    d.act[:] = _advanced(m, act, np.asarray(mean[2]))
    d.qacc_warmstart[:] = d.qacc


def _integrate(m: MjModel, d: MjData) -> None:
    if m.opt.integrator in (int(mjtIntegrator.mjINT_IMPLICIT), int(mjtIntegrator.mjINT_IMPLICITFAST)):
        stages.mj_implicit(m, d)
    elif m.opt.integrator == int(mjtIntegrator.mjINT_RK4):
        _runge_kutta(m, d)
    else:
        stages.mj_Euler(m, d)


def step(m: MjModel, d: MjData, count: int) -> None:
    """`mj_step`, `count` times.

    Raises:
        NotImplementedError: the integrator is Runge-Kutta's, and the model has delays or plugins with a state.
    """
    if m.opt.integrator == int(mjtIntegrator.mjINT_RK4) and (m.nhistory or m.npluginstate):
        raise NotImplementedError("callbacks with the integrator RK4 for models with delays, or with plugins that have a state")
    for _ in range(count):
        stages.mj_checkPos(m, d)
        stages.mj_checkVel(m, d)
        forward(m, d)
        stages.mj_checkAcc(m, d)
        _integrate(m, d)


def step1(m: MjModel, d: MjData) -> None:
    """`mj_step1`: the state is checked, what does not depend on controls is computed, and controls are asked for."""
    stages.mj_checkPos(m, d)
    stages.mj_checkVel(m, d)
    with _timed():
        _position_and_velocity(m, d, 0)
        _control(m, d)


def step2(m: MjModel, d: MjData) -> None:
    """`mj_step2`: accelerations, then the state advances, by Euler's method where the integrator is Runge-Kutta's."""
    with _timed():
        _acceleration(m, d)
    stages.mj_checkAcc(m, d)
    if m.opt.integrator == int(mjtIntegrator.mjINT_RK4):
        stages.mj_Euler(m, d)
    else:
        _integrate(m, d)
