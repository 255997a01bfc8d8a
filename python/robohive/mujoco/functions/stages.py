"""Single stages of a step, for programs that put a pass together themselves."""

from collections.abc import Callable

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco import callbacks
from robohive.mujoco._constants import mjMAXVAL
from robohive.mujoco.enums.physics import mjtDisableBit, mjtWarning
from robohive.mujoco.functions import asked
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

_Stage = Callable[[MjModel, MjData], None]


#: Stages inside of which callbacks are asked, while these are set.
_ASKING: dict[str, tuple[tuple[str, ...], _Stage]] = {
    "collision": (("mjcb_contactfilter",), lambda m, d: asked.contacts(m, d, alone=True)),
    "fwdPosition": (("mjcb_contactfilter",), lambda m, d: asked.contacts(m, d, alone=False)),
    "fwdActuation": (("mjcb_act_dyn", "mjcb_act_gain", "mjcb_act_bias"), asked.actuation),
}


def _stage(name: str, summary: str, called: str | None = None) -> _Stage:
    wanted, asking = _ASKING.get(name, ((), None))

    def run(m: MjModel, d: MjData) -> None:
        if asking is not None and any(callbacks._set.get(callback) is not None for callback in wanted):
            asking(m, d)
        else:
            _core.stage(m, d, name)

    run.__name__ = run.__qualname__ = called or f"mj_{name}"
    run.__doc__ = f"{run.__name__}(m: mujoco._structs.MjModel, d: mujoco._structs.MjData) -> None\n\n{summary}\n"
    return run


mj_kinematics = _stage("kinematics", "Poses of bodies, joints, geoms and sites.")
mj_comPos = _stage("comPos", "Centres of mass, motion axes, inertias about them.")
mj_camlight = _stage("camlight", "Poses of cameras and lights.")
mj_tendon = _stage("tendon", "Tendon paths, lengths and Jacobians.")
mj_fwdKinematics = _stage("fwdKinematics", "Poses, centres of mass, cameras, lights and tendons.")
mj_makeM = _stage("makeM", "The inertia matrix.")
mj_factorM = _stage("factorM", "The factor of the inertia matrix.")
mj_collision = _stage("collision", "Contacts.")
mj_makeConstraint = _stage("makeConstraint", "Constraint rows.")
mj_island = _stage("island", "Constraint islands.")
mj_transmission = _stage("transmission", "Lengths and moment arms of actuators.")
mj_fwdPosition = _stage("fwdPosition", "All that depends on positions.")
mj_sensorPos = _stage("sensorPos", "Sensors of positions, and the potential energy.")
mj_energyPos = _stage("energyPos", "Potential energy [J].")
mj_invPosition = _stage("fwdPosition", "All that depends on positions, of inverse dynamics.", "mj_invPosition")
mj_invVelocity = _stage("fwdVelocity", "All that depends on velocities, of inverse dynamics.", "mj_invVelocity")
mj_invConstraint = _stage("invConstraint", "Constraint forces that go with the present acceleration.")
mj_comVel = _stage("comVel", "Velocities of bodies.")
mj_passive = _stage("passive", "Forces of springs, dampers, fluid and gravity compensation.")
mj_referenceConstraint = _stage("referenceConstraint", "Velocity and reference acceleration of constraint rows.")
mj_fwdVelocity = _stage("fwdVelocity", "All that depends on velocities.")
mj_sensorVel = _stage("sensorVel", "Sensors of velocities, and the kinetic energy.")
mj_energyVel = _stage("energyVel", "Kinetic energy [J].")
mj_subtreeVel = _stage("subtreeVel", "Linear velocities and angular momenta of subtrees.")
mj_fwdActuation = _stage("fwdActuation", "Actuator forces.")
mj_fwdAcceleration = _stage("fwdAcceleration", "Accelerations without constraints.")
mj_fwdConstraint = _stage("fwdConstraint", "Constraint forces and accelerations.")
mj_sensorAcc = _stage("sensorAcc", "Sensors of accelerations and forces.")
mj_rnePostConstraint = _stage("rnePostConstraint", "Accelerations of bodies, and forces between them and from outside.")
mj_compareFwdInv = _stage("compareFwdInv", "Differences of forward and inverse dynamics.")
mj_Euler = _stage("Euler", "Euler integrator, semi-implicit in velocity.")
mj_implicit = _stage("implicit", "Advances the state implicitly in velocity.")


def mj_crb(m: MjModel, d: MjData) -> None:
    """Composite inertias and the inertia matrix."""
    _core.stage(m, d, "makeM")


def mj_RungeKutta(m: MjModel, d: MjData, N: int) -> None:
    """Advances the state by the classical Runge-Kutta method.

    Raises:
        NotImplementedError: `N` is not 4.
    """
    if N != 4:
        raise NotImplementedError(f"Runge-Kutta of order {N}; there is order 4")
    _core.stage(m, d, "RungeKutta")


def _check(m: MjModel, d: MjData, array: str, kind: mjtWarning) -> bool:
    """Whether the numbers are fit; where not, and instability resets, resets and counts a warning."""
    values = getattr(d, array)
    bad = np.flatnonzero(~(np.abs(values) <= mjMAXVAL))
    if not bad.size:
        return True
    if not _core.resets():
        raise _core.FatalError(f"{array}[{bad[0]}] is {values[bad[0]]} at time {d.time} s; the simulation is unstable")
    place, time, number = int(bad[0]), d.time, d.warning[kind].number + 1
    if number == 1:
        callbacks._tell(int(kind), place, time)
    if not int(m.opt.disableflags) & int(mjtDisableBit.mjDSBL_AUTORESET):
        _core.mj_resetData(m, d)
    d.warning[kind].number, d.warning[kind].lastinfo = number, place
    return False


def mj_checkPos(m: MjModel, d: MjData) -> None:
    """Refuses positions that are not finite or too large: a `FatalError`, or a reset with a warning."""
    _check(m, d, "qpos", mjtWarning.mjWARN_BADQPOS)


def mj_checkVel(m: MjModel, d: MjData) -> None:
    """Refuses velocities that are not finite or too large: a `FatalError`, or a reset with a warning."""
    _check(m, d, "qvel", mjtWarning.mjWARN_BADQVEL)


def mj_checkAcc(m: MjModel, d: MjData) -> None:
    """Refuses accelerations that are not finite or too large: a `FatalError`, or a reset with a warning, and a pass."""
    if not _check(m, d, "qacc", mjtWarning.mjWARN_BADQACC):
        _core.mj_forward(m, d)
