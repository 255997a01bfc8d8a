"""What is asked of single elements, and simulations brought back to neutral values."""

import numpy as np

from robohive.mujoco import _engine as _core
from robohive.mujoco._constants import mjMAXCONPAIR
from robohive.mujoco.enums.elements import mjtGain, mjtGeom
from robohive.mujoco.enums.physics import mjtDisableBit, mjtEnableBit
from robohive.mujoco.structs.contacts import MjContact
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

#: Names of inputs: of an orientation as a rotation vector, of one as a quaternion, of servos by bit of `actuator_ctrlspec`.
_VECTOR, _QUATERNION, _SERVO = ("rx", "ry", "rz"), ("qw", "qx", "qy", "qz"), ("pos", "vel", "ff", "voltage")
#: What `actuator_ctrlspec` says of quaternions.
_IDENTITY = 2
_SERVOS = (mjtGain.mjGAIN_PID, mjtGain.mjGAIN_DCMOTOR)


def mj_actuatorInputName(m: MjModel, id: int, input: int) -> str | None:
    """What an input of an actuator is called, None where it has no name."""
    if not 0 <= id < m.nactuator or not 0 <= input < m.actuator_ctrlnum[id]:
        return None
    kind, spec = int(m.actuator_gaintype[id]), int(m.actuator_ctrlspec[id])
    if kind == mjtGain.mjGAIN_SO3:
        return (_QUATERNION if spec == _IDENTITY else _VECTOR)[input]
    present = [name for bit, name in enumerate(_SERVO) if spec >> bit & 1]
    return present[input] if kind in _SERVOS and input < len(present) else None


def mj_resetCtrl(m: MjModel, d: MjData) -> None:
    """Sets all controls to zero, those that are quaternions to the identity."""
    d.ctrl[:] = 0.0
    turning = (m.actuator_gaintype == int(mjtGain.mjGAIN_SO3)) & (m.actuator_ctrlspec == _IDENTITY)
    d.ctrl[m.actuator_ctrladr[turning]] = 1.0


def mj_resetDataDebug(m: MjModel, d: MjData, debug_value: int) -> None:
    """`mj_resetData`: there is no memory that a reset leaves unset, so that nothing is filled with `debug_value`."""
    _core.mj_resetData(m, d)


def mj_flex(m: MjModel, d: MjData) -> None:
    """Vertices, edges and boxes of flexes."""
    _core.stage(m, d, "flex")


def mj_addContact(m: MjModel, d: MjData, con: MjContact) -> int:
    """Appends a contact, of which `mj_makeConstraint` makes rows; returns 0."""
    fields = {name: values for name, values in _core.contacts(d).items() if name in con._empty and name != "H"}
    names = [name for name in fields if name not in ("geom1", "geom2", "H")]
    more = {name: np.append(np.ravel(fields[name]), np.ravel(getattr(con, name))).tolist() for name in names}
    _core.set_contacts(m, d, more)
    return 0


def _has_margin(m: MjModel, g1: int, g2: int) -> bool:
    if int(m.opt.enableflags) & int(mjtEnableBit.mjENBL_OVERRIDE):
        return bool(m.opt.o_margin > 0)
    for a, b, margin in zip(m.pair_geom1.tolist(), m.pair_geom2.tolist(), m.pair_margin.tolist(), strict=True):
        if {a, b} == {g1, g2}:
            return bool(margin > 0)
    return bool(m.geom_margin[g1] > 0 or m.geom_margin[g2] > 0)


#: Most contacts of a plane with geoms that are not round on all sides, and of pairs that are solved in closed form.
_ON_PLANE = {mjtGeom.mjGEOM_CAPSULE: 2, mjtGeom.mjGEOM_CYLINDER: 4, mjtGeom.mjGEOM_BOX: 4, mjtGeom.mjGEOM_MESH: 3}
_CLOSED = {
    (mjtGeom.mjGEOM_BOX, mjtGeom.mjGEOM_BOX): 8,
    (mjtGeom.mjGEOM_CAPSULE, mjtGeom.mjGEOM_CAPSULE): 2,
    (mjtGeom.mjGEOM_CAPSULE, mjtGeom.mjGEOM_BOX): 4,
}


def mj_maxContact(m: MjModel, g1: int, g2: int, has_margin: int) -> int:
    """Most contacts that two geoms can have; with `has_margin` -1 their margin is the model's, else it says whether they have one."""
    low, high = sorted((int(m.geom_type[g1]), int(m.geom_type[g2])))
    if high == mjtGeom.mjGEOM_SDF:
        return int(m.opt.sdf_initpoints)
    if mjtGeom.mjGEOM_HFIELD in (low, high):
        return mjMAXCONPAIR if low == mjtGeom.mjGEOM_HFIELD and high != mjtGeom.mjGEOM_HFIELD else 0
    if {low, high} & {int(mjtGeom.mjGEOM_SPHERE), int(mjtGeom.mjGEOM_ELLIPSOID)}:
        return 1
    if (low, high) in _CLOSED:
        return _CLOSED[low, high]  # type: ignore[index]
    if low == mjtGeom.mjGEOM_PLANE:
        return int(_ON_PLANE.get(high, 0))  # type: ignore[call-overload]
    disabled = int(m.opt.disableflags)
    if disabled & int(mjtDisableBit.mjDSBL_MULTICCD):
        return 1
    rolls = {low, high} & {int(mjtGeom.mjGEOM_CAPSULE), int(mjtGeom.mjGEOM_CYLINDER)}
    if rolls or disabled & int(mjtDisableBit.mjDSBL_NATIVECCD):
        return 5
    return 5 if (_has_margin(m, g1, g2) if has_margin < 0 else has_margin) else 4
