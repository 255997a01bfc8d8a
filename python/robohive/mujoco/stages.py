"""Single stages of a step, for programs that put a pass together themselves."""

from collections.abc import Callable

from robohive._core import mujoco as _core
from robohive.mujoco.data import MjData
from robohive.mujoco.model import MjModel

#: Stages by the name after `mj_`, with what they compute.
_STAGES = {
    "kinematics": "Poses of bodies, joints, geoms and sites.",
    "comPos": "Centres of mass, motion axes, inertias about them.",
    "camlight": "Poses of cameras and lights.",
    "tendon": "Tendon paths, lengths and Jacobians.",
    "fwdKinematics": "Poses, centres of mass, cameras, lights and tendons.",
    "makeM": "The inertia matrix.",
    "factorM": "The factor of the inertia matrix.",
    "collision": "Contacts.",
    "makeConstraint": "Constraint rows.",
    "island": "Constraint islands.",
    "transmission": "Lengths and moment arms of actuators.",
    "fwdPosition": "All that depends on positions.",
    "sensorPos": "Sensors of positions, and the potential energy.",
    "energyPos": "Potential energy [J].",
    "comVel": "Velocities of bodies.",
    "passive": "Forces of springs, dampers, fluid and gravity compensation.",
    "referenceConstraint": "Velocity and reference acceleration of constraint rows.",
    "fwdVelocity": "All that depends on velocities.",
    "sensorVel": "Sensors of velocities, and the kinetic energy.",
    "energyVel": "Kinetic energy [J].",
    "subtreeVel": "Linear velocities and angular momenta of subtrees.",
    "fwdActuation": "Actuator forces.",
    "fwdAcceleration": "Accelerations without constraints.",
    "fwdConstraint": "Constraint forces and accelerations.",
    "sensorAcc": "Sensors of accelerations and forces.",
    "rnePostConstraint": "Accelerations of bodies, and forces between them and from outside.",
    "compareFwdInv": "Differences of forward and inverse dynamics.",
    "Euler": "Advances the state by Euler's method.",
    "implicit": "Advances the state implicitly in velocity.",
}


def _stage(name: str, summary: str) -> Callable[[MjModel, MjData], None]:
    def run(m: MjModel, d: MjData) -> None:
        _core.stage(m, d, name)

    run.__name__ = run.__qualname__ = f"mj_{name}"
    run.__doc__ = summary
    return run


for _name, _summary in _STAGES.items():
    globals()[f"mj_{_name}"] = _stage(_name, _summary)


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


__all__ = [*(f"mj_{_name}" for _name in _STAGES), "mj_RungeKutta", "mj_crb"]
