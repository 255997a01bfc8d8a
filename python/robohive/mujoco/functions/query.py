"""Questions about the present poses: Jacobians, rays, distances, velocities, forces of contacts.

All read what the last forward pass computed.
"""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from robohive.mujoco import _engine as _core
from robohive.mujoco.functions.out import Vector, destination, vector, write
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

_ORIGIN = [0.0, 0.0, 0.0]


def _jacobian(m: MjModel, d: MjData, what: str, outs: tuple[Any, Any], number: int, point: ArrayLike = _ORIGIN) -> None:
    names = ("jacPoint", "jacAxis") if what == "axis" else ("jacp", "jacr")
    for out, name in zip(outs, names, strict=True):
        if out is not None:
            destination(out, name, "shape (3, nv)", (3, m.nv))
    results = _core.jacobian(m, d, what, number, vector(point, "point", 3))
    for out, values in zip(outs, results, strict=True):
        if out is not None:
            write(out, values)


def mj_jac(m: MjModel, d: MjData, jacp: Vector | None, jacr: Vector | None, point: ArrayLike, body: int) -> None:
    """Jacobian of `point` [m, world] moving with `body`, into `jacp` (translation) and `jacr` (rotation), `3 x nv`."""
    _jacobian(m, d, "point", (jacp, jacr), body, point)


def mj_jacBody(m: MjModel, d: MjData, jacp: Vector | None, jacr: Vector | None, body: int) -> None:
    """Jacobian of the frame of a body."""
    _jacobian(m, d, "body", (jacp, jacr), body)


def mj_jacBodyCom(m: MjModel, d: MjData, jacp: Vector | None, jacr: Vector | None, body: int) -> None:
    """Jacobian of the centre of mass of a body."""
    _jacobian(m, d, "bodycom", (jacp, jacr), body)


def mj_jacSubtreeCom(m: MjModel, d: MjData, jacp: Vector | None, body: int) -> None:
    """Jacobian of the centre of mass of a body and all below it."""
    _jacobian(m, d, "subtree", (jacp, None), body)


def mj_jacGeom(m: MjModel, d: MjData, jacp: Vector | None, jacr: Vector | None, geom: int) -> None:
    """Jacobian of a geom."""
    _jacobian(m, d, "geom", (jacp, jacr), geom)


def mj_jacSite(m: MjModel, d: MjData, jacp: Vector | None, jacr: Vector | None, site: int) -> None:
    """Jacobian of a site."""
    _jacobian(m, d, "site", (jacp, jacr), site)


def mj_jacDot(m: MjModel, d: MjData, jacp: Vector | None, jacr: Vector | None, point: ArrayLike, body: int) -> None:
    """Rate of change of the Jacobian of `point` moving with `body`."""
    _jacobian(m, d, "rate", (jacp, jacr), body, point)


def mj_angmomMat(m: MjModel, d: MjData, mat: Vector, body: int) -> None:
    """The matrix, `3 x nv`, that makes angular momentum of a subtree from joint velocities."""
    _jacobian(m, d, "angmom", (mat, None), body)


def mj_jacPointAxis(
    m: MjModel, d: MjData, jacPoint: Vector | None, jacAxis: Vector | None, point: ArrayLike, axis: ArrayLike, body: int
) -> None:
    """Jacobians of a point and of an axis that move with a body."""
    _, turning = _core.jacobian(m, d, "point", body, vector(point, "point", 3))
    mj_jac(m, d, jacPoint, None, point, body)
    if jacAxis is not None:
        destination(jacAxis, "jacAxis", "shape (3, nv)", (3, m.nv))
        write(jacAxis, np.cross(turning.reshape(3, m.nv).T, vector(axis, "axis", 3)).T)


def mj_applyFT(
    m: MjModel, d: MjData, force: ArrayLike, torque: ArrayLike, point: ArrayLike, body: int, qfrc_target: Vector
) -> None:
    """Adds to `qfrc_target` what a force [N] and a torque [N m] at a point of a body amount to in joint space."""
    destination(qfrc_target, "qfrc_target", "size nv", (m.nv,))
    wrench = [vector(force, "force", 3), vector(torque, "torque", 3)]
    qfrc_target += _core.joint_forces(m, d, wrench, vector(point, "point", 3), body).reshape(qfrc_target.shape)


def _groups(geomgroup: ArrayLike | None) -> list[bool] | None:
    if geomgroup is None:
        return None
    groups = np.asarray(geomgroup).ravel()
    if groups.size != 6:
        raise TypeError("geomgroup should be a vector of size 6")
    return [bool(x) for x in groups]


def mj_ray(
    m: MjModel,
    d: MjData,
    pnt: ArrayLike,
    vec: ArrayLike,
    geomgroup: ArrayLike | None,
    flg_static: bool,
    bodyexclude: int,
    geomid: Any = None,
    normal: Vector | None = None,
) -> float:
    """Distance along a ray to the nearest geom, in lengths of `vec`; -1 when it hits none. Its id goes into `geomid`."""
    what = (_groups(geomgroup), bool(flg_static), bodyexclude)
    geom, distance, outward = _core.cast_ray(m, d, vector(pnt, "pnt", 3), vector(vec, "vec", 3), what)
    if geomid is not None:
        destination(geomid, "geomid", "size 1", (1,), np.int32)
        write(geomid, [geom])
    if normal is not None:
        destination(normal, "normal", "size 3", (3,))
        write(normal, outward)
    return distance


def mj_multiRay(
    m: MjModel,
    d: MjData,
    pnt: ArrayLike,
    vec: ArrayLike,
    geomgroup: ArrayLike | None,
    flg_static: bool,
    bodyexclude: int,
    geomid: Any,
    dist: Vector,
    normal: Vector | None,
    nray: int,
    cutoff: float,
) -> None:
    """Casts `nray` rays from one point; ids of the nearest geoms and distances go into `geomid` and `dist`."""
    directions = vector(np.ravel(vec), "vec", 3 * nray).reshape(nray, 3)
    destination(geomid, "geomid", "size nray", (nray,), np.int32)
    destination(dist, "dist", "size nray", (nray,))
    what = (_groups(geomgroup), bool(flg_static), bodyexclude)
    found = _core.cast_rays(m, d, vector(pnt, "pnt", 3), directions, what, cutoff)
    write(geomid, [geom for geom, _, _ in found])
    write(dist, [distance for _, distance, _ in found])
    if normal is not None:
        destination(normal, "normal", "size 3*nray", (3 * nray,))
        write(normal, [outward for _, _, outward in found])


def _ray_at_geom(m: MjModel, d: MjData, geom: int, pnt: ArrayLike, vec: ArrayLike, normal: Vector | None) -> float:
    distance, outward = _core.cast_at_geom(m, d, geom, vector(pnt, "pnt", 3), vector(vec, "vec", 3))
    if normal is not None:
        write(normal, outward)
    return distance


def mj_rayMesh(m: MjModel, d: MjData, geomid: int, pnt: ArrayLike, vec: ArrayLike, normal: Vector | None = None) -> float:
    """Distance along a ray to a mesh geom, -1 when it is not hit."""
    return _ray_at_geom(m, d, geomid, pnt, vec, normal)


def mj_rayHfield(m: MjModel, d: MjData, geomid: int, pnt: ArrayLike, vec: ArrayLike, normal: Vector | None = None) -> float:
    """Distance along a ray to a height field geom, -1 when it is not hit."""
    return _ray_at_geom(m, d, geomid, pnt, vec, normal)


def mju_rayGeom(
    pos: ArrayLike,
    mat: ArrayLike,
    size: ArrayLike,
    pnt: ArrayLike,
    vec: ArrayLike,
    geomtype: int,
    normal: Vector | None = None,
) -> float:
    """Distance along a ray to a primitive shape of this pose and size, -1 when it is not hit."""
    shape = (int(geomtype), vector(size, "size", 3))
    pose = (vector(pos, "pos", 3), vector(np.ravel(mat), "mat", 9))
    distance, outward = _core.cast_at_shape(shape, pose, vector(pnt, "pnt", 3), vector(vec, "vec", 3))
    if normal is not None:
        write(normal, outward)
    return distance


def mj_geomDistance(m: MjModel, d: MjData, geom1: int, geom2: int, distmax: float, fromto: Vector | None) -> float:
    """Signed distance of two geoms [m], at most `distmax`; the nearest points go into `fromto` (6)."""
    distance, points = _core.geom_distance(m, d, [geom1, geom2], distmax)
    if fromto is not None:
        destination(fromto, "fromto", "size 6", (6,))
        write(fromto, points)
    return distance


def mj_objectVelocity(m: MjModel, d: MjData, objtype: int, objid: int, res: Vector, flg_local: int) -> None:
    """Velocity of an object, rotation first [rad/s, m/s], in the orientation of the world or of the object."""
    destination(res, "res", "size 6", (6,))
    write(res, _core.object_motion(m, d, (int(objtype), objid), False, bool(flg_local)))


def mj_objectAcceleration(m: MjModel, d: MjData, objtype: int, objid: int, res: Vector, flg_local: int) -> None:
    """Acceleration of an object, rotation first, after `mj_rnePostConstraint`."""
    destination(res, "res", "size 6", (6,))
    write(res, _core.object_motion(m, d, (int(objtype), objid), True, bool(flg_local)))


def mj_contactForce(m: MjModel, d: MjData, id: int, result: Vector) -> None:
    """Force and torque of contact `id` in its own frame [N, N m], normal first."""
    destination(result, "result", "size 6", (6,))
    write(result, _core.contact_force(m, d, id))


def mj_getTotalmass(m: MjModel) -> float:
    """Sum of the masses of all bodies [kg]."""
    return float(m.body_mass.sum())


def mj_setTotalmass(m: MjModel, newmass: float) -> None:
    """Scales masses and inertias to a total mass [kg]; `mj_setConst` then derives what follows."""
    scale = max(1e-15, newmass / max(1e-15, mj_getTotalmass(m)))
    m.body_mass *= scale
    m.body_inertia *= scale
    m._set_const()
