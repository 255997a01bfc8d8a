"""Random rays for `collide.py`: against one geom of each type, and through scenes of many geoms.

A chunk of rays against one geom has `ray`, the type, and for every ray

    size, dataid, xpos, xmat    the geom; `hfield_data` holds for the whole chunk
    pnt, vec                    the ray
    distance, normal, unstable  `mj_rayMesh`, `mj_rayHfield` or `mju_rayGeom`; whether a nudge of the ray changes them

A scene has `scene` rays from one point, its geoms (`model.NAME`, `xpos`, `xmat`) and

    groups, skip_static, exclude, cutoff    the filter; no `groups` for all
    distance, geom, normal, unstable        `mj_ray`, a ray at a time; whether a nudge of the origin changes them
    multi_distance, multi_geom, multi_normal        `mj_multiRay`
    culled                                  `mj_ray` with the geoms beyond the cut-off hidden finds another geom
"""

import mujoco
import numpy as np

from placements import HFIELD, MESH, PLANE, TYPES, Templates, build, matrices, model_arrays, quaternions, terrain

CHUNK = 2000
PER_SCENE = 50
NUDGE = 1e-12
STABLE = 1e-9


def aim(rng, n, centre, reach):
    """Rays from about a geom, most of them towards it; some along the axes, some long or short."""
    pnt = centre + reach[:, None] * rng.normal(size=(n, 3)) * rng.choice([0.2, 1.5, 4], (n, 1))
    target = centre + reach[:, None] * rng.uniform(-0.6, 0.6, (n, 3))
    vec = np.where(rng.random((n, 1)) < 0.85, target - pnt, rng.normal(size=(n, 3)))
    axis = np.eye(3)[rng.integers(3, size=n)] * rng.choice([-1, 1], (n, 1))
    vec = np.where(rng.random((n, 1)) < 0.1, axis, vec)
    return pnt, vec / np.linalg.norm(vec, axis=1, keepdims=True) * 10 ** rng.uniform(-1, 1, (n, 1))


def poses(rng, n):
    """Places and turns; some geoms stand straight."""
    mat = np.where((rng.random(n) < 0.15)[:, None, None], np.eye(3), matrices(quaternions(rng, n)))
    return rng.normal(size=(n, 3)) * rng.choice([0.0, 0.5], (n, 1)), mat


def cast(model, data, geom, pnt, vec):
    normal, kind = np.zeros(3), model.geom_type[geom]
    if kind == MESH:
        return mujoco.mj_rayMesh(model, data, geom, pnt, vec, normal), normal
    if kind == HFIELD:
        return mujoco.mj_rayHfield(model, data, geom, pnt, vec, normal), normal
    pos, mat, size = data.geom_xpos[geom], data.geom_xmat[geom], model.geom_size[geom]
    return mujoco.mju_rayGeom(pos, mat, size, pnt, vec, kind, normal), normal


def one_geom(model, data, kind, n, rng):
    geom = model.ngeom - 1
    size, bound, _, dataid = Templates(model).draw(kind, n, rng, 0.3)
    xpos, xmat = poses(rng, n)
    pnt, vec = aim(rng, n, xpos, np.where(bound > 0, bound, 0.5))
    model.hfield_data[:] = terrain(rng, 1, model)[0]
    size = np.where(rng.random((n, 1)) < 0.5, size, 0.0) if kind == PLANE else size
    step = rng.normal(size=(n, 6)) * NUDGE
    model.geom_type[geom] = kind
    distance, normal, unstable = [], [], []
    for i in range(n):
        model.geom_size[geom], model.geom_dataid[geom] = size[i], dataid[i]
        data.geom_xpos[geom], data.geom_xmat[geom] = xpos[i], xmat[i].ravel()
        d, v = cast(model, data, geom, pnt[i], vec[i])
        moved = False
        for sign in (1, -1):
            other, w = cast(model, data, geom, pnt[i] + sign * step[i, :3], vec[i] + sign * step[i, 3:])
            moved |= not (abs(other - d) <= STABLE) or not (np.abs(w - v).max() <= STABLE)
        distance.append(d), normal.append(v), unstable.append(moved)
    return {"ray": np.int64(kind), "size": size, "dataid": dataid, "xpos": xpos, "xmat": xmat, "pnt": pnt, "vec": vec,
            "hfield_data": model.hfield_data.copy(), "distance": np.array(distance), "normal": np.array(normal),
            "unstable": np.array(unstable)}


def many(model, data, pnt, vec, groups, static, exclude, cutoff):
    n = len(vec)
    geom, distance, normal = np.zeros(n, np.int32), np.zeros(n), np.zeros(3 * n)
    mujoco.mj_multiRay(model, data, pnt, vec.ravel(), groups, static, exclude, geom, distance, normal, n, cutoff)
    return distance, geom, normal.reshape(n, 3)


def single(model, data, pnt, vec, groups, static, exclude):
    geom, normal, out = np.zeros(1, np.int32), np.zeros(3), []
    for v in vec:
        out.append((mujoco.mj_ray(model, data, pnt, v, groups, static, exclude, geom, normal), geom[0], normal.copy()))
    return [np.array(x) for x in zip(*out)]


def scene(model, data, rng):
    """Geoms of all types, and rays of one origin through them."""
    m, n = model, model.nbody - 1
    first = m.ngeom - n
    templates = Templates(m)
    kinds = rng.integers(len(TYPES), size=n)
    for k, kind in enumerate(kinds):
        size, bound, aabb, dataid = templates.draw(kind, 1, rng, 0.3)
        g = first + k
        m.geom_type[g], m.geom_size[g], m.geom_rbound[g] = kind, size[0], bound[0]
        m.geom_aabb[g], m.geom_dataid[g] = aabb[0], dataid[0]
        m.bvh_aabb[m.body_bvhadr[1 + k]] = aabb[0]
    m.hfield_data[:] = terrain(rng, 1, m)[0]
    m.geom_group[first:] = rng.integers(-1, 7, size=n)
    m.geom_rgba[first:, 3] = rng.random(n) < 0.9
    quat = np.where(rng.random((n, 1)) < 0.2, [1.0, 0, 0, 0], quaternions(rng, n))
    data.mocap_pos[:], data.mocap_quat[:] = rng.normal(size=(n // 2, 3)), quat[::2]
    data.qpos[:] = np.concatenate([rng.normal(size=(n // 2, 3)), quat[1::2]], 1).ravel()
    mujoco.mj_kinematics(m, data)
    mujoco.mj_comPos(m, data)
    pnt, vec = rng.normal(size=3) * 1.5, rng.normal(size=(PER_SCENE, 3))
    vec[:25] = rng.normal(size=(25, 3)) * 0.8 - pnt
    groups = (rng.random(6) < 0.7).astype(np.uint8) if rng.random() < 0.5 else None
    static, exclude = bool(rng.random() < 0.7), int(rng.integers(-1, m.nbody))
    cutoff = float(rng.choice([1e10, 1.0, 2.0]))
    query = (groups, static, exclude)
    out = {"scene": np.int64(PER_SCENE), "pnt": pnt, "vec": vec, "skip_static": np.int64(not static),
           "exclude": np.int64(exclude), "cutoff": np.float64(cutoff), "xpos": data.geom_xpos.copy(),
           "xmat": data.geom_xmat.copy()}
    out |= {} if groups is None else {"groups": groups}
    out |= {"model." + name: getattr(m, name).copy() for name in
            ["geom_type", "geom_size", "geom_rbound", "geom_dataid", "geom_group", "geom_rgba", "hfield_data"]}
    out["distance"], out["geom"], out["normal"] = single(m, data, pnt, vec, *query)
    step, unstable = rng.normal(size=3) * NUDGE, np.zeros(len(vec), bool)
    for sign in (1, -1):
        distance, geom, normal = single(m, data, pnt + sign * step, vec, *query)
        unstable |= (geom != out["geom"]) | ~(np.abs(distance - out["distance"]) <= STABLE)
        unstable |= ~(np.abs(normal - out["normal"]).max(axis=1) <= STABLE)
    out["unstable"] = unstable
    out["multi_distance"], out["multi_geom"], out["multi_normal"] = many(m, data, pnt, vec, *query, cutoff)
    hidden = np.linalg.norm(data.geom_xpos - pnt, axis=1) > cutoff + m.geom_rbound
    hidden &= m.body_bvhadr[m.geom_bodyid] >= 0
    alpha = m.geom_rgba[:, 3].copy()
    m.geom_rgba[hidden, 3] = 0
    out["culled"] = single(m, data, pnt, vec, *query)[1] != out["multi_geom"]
    m.geom_rgba[:, 3] = alpha
    return out


def record(meshes, args, send):
    model = build(meshes, args.slots, predefined=False)
    data = mujoco.MjData(model)
    if not args.pack:
        send(model_arrays(model))
    for kind, name in enumerate(TYPES):
        if args.only in name:
            for part, start in enumerate(range(0, args.rays, CHUNK)):
                rng = np.random.default_rng([args.seed, kind, part])
                send(one_geom(model, data, kind, min(CHUNK, args.rays - start), rng))
    if not args.only:
        for part in range(-(-args.rays // PER_SCENE)):
            send(scene(model, data, np.random.default_rng([args.seed, len(TYPES), part])))
