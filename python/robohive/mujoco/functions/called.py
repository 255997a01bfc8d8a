"""Passes and steps that call callbacks: stage by stage, in the order of `mj_forward` and `mj_step` (MuJoCo documentation,
Computation, "Forward dynamics")."""

from collections.abc import Iterator
from contextlib import contextmanager
from numbers import Real
from typing import Any

import numpy as np

from robohive.mujoco import callbacks
from robohive.mujoco.enums.elements import mjtSensor
from robohive.mujoco.enums.physics import mjtDisableBit, mjtIntegrator, mjtStage
from robohive.mujoco.functions import stages
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


def _integrate(m: MjModel, d: MjData) -> None:
    if m.opt.integrator in (int(mjtIntegrator.mjINT_IMPLICIT), int(mjtIntegrator.mjINT_IMPLICITFAST)):
        stages.mj_implicit(m, d)
    else:
        stages.mj_Euler(m, d)


def step(m: MjModel, d: MjData, count: int) -> None:
    """`mj_step`, so many times.

    Raises:
        NotImplementedError: the integrator is Runge-Kutta's, whose inner passes call nothing.
    """
    if m.opt.integrator == int(mjtIntegrator.mjINT_RK4):
        raise NotImplementedError("callbacks with the integrator RK4; there are Euler, implicit and implicitfast")
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
    """`mj_step2`: accelerations, then the state advances."""
    with _timed():
        _acceleration(m, d)
    stages.mj_checkAcc(m, d)
    _integrate(m, d)
