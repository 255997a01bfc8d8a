#!/usr/bin/env python3
"""Writes what MuJoCo 3.12.0 says of elements of flexes at random places, as a stream for `robohive-validation collide`.

    pip install mujoco==3.12.0
    python flex_pairs.py --count 20000 | robohive-validation collide

Pairs are a line, triangle or tetrahedron with a geom of every type, with one of another flex, and with a second one of
its own flex. Everything follows from the seed. The stream is a row of numpy archives, each after its length in eight
bytes, little endian: for each pair a compiled model, then chunks of placements, which have

    flexes, variant             names of the pair and of what is set otherwise than by default
    opt.NAME, model.NAME        what is set
    qpos, mocap_pos, mocap_quat     where everything is
    ncon, contact.NAME          contacts of every placement
    unstable                    MuJoCo's answer changes in count or by more than 1e-9 where every coordinate moves by
                                at most 1e-12, to and fro along one random direction
"""

import argparse
import io
import struct
import sys

import mujoco
import numpy as np

import record

NUDGE, STABLE, CHUNK = 1e-12, 1e-9, 1000
RADIUS = 0.01
GEOMS = {
    "plane": 'type="plane" size="1 1 .1"',
    "hfield": 'type="hfield" hfield="hills"',
    "sphere": 'type="sphere" size=".1"',
    "capsule": 'type="capsule" size=".06 .12"',
    "ellipsoid": 'type="ellipsoid" size=".1 .06 .14"',
    "cylinder": 'type="cylinder" size=".08 .12"',
    "box": 'type="box" size=".1 .07 .12"',
    "mesh": 'type="mesh" mesh="stone"',
}
FIXED = ("plane", "hfield")
NAMES = {1: "line", 2: "triangle", 3: "tetrahedron"}
VARIANTS = {"default": {}, "nativeccd disabled": {"disableflags": int(mujoco.mjtDisableBit.mjDSBL_NATIVECCD)}}


def flex(name, dim, elements):
    """Bodies that slide, and the flex of separate elements between them."""
    count = elements * (dim + 1)
    slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
    bodies = "".join(f'<body name="{name}{k}" pos="{0.05 * (k == 1)} {0.05 * (k == 2)} {0.05 * (k > 2) * k}">'
                     f'<inertial pos="0 0 0" mass=".01" diaginertia="1e-5 1e-5 1e-5"/>{slides}</body>'
                     for k in range(count))
    own = "narrow" if elements > 1 else "none"
    edge = '<edge stiffness="1"/>' if dim == 1 else ""
    return bodies, (f'<flex name="{name}" dim="{dim}" radius="{RADIUS}" '
                    f'body="{" ".join(name + str(k) for k in range(count))}" '
                    f'element="{" ".join(map(str, range(count)))}">'
                    f'<contact internal="false" selfcollide="{own}"/>{edge}</flex>')


def model(geom, flexes):
    """A model of one pair: `flexes` are the dimensions and numbers of elements of each flex."""
    rng = np.random.default_rng(3)
    stone = " ".join(f"{x:.3f}" for x in (rng.normal(size=(20, 3)) * 0.08).ravel())
    hills = " ".join(f"{x:.2f}" for x in rng.uniform(size=30))
    parts = [flex("ab"[k], *what) for k, what in enumerate(flexes)]
    bodies = "".join(body for body, _ in parts)
    if geom:
        free = 'mocap="true">' if geom in FIXED else "><freejoint/>"
        bodies += f'<body name="g" {free}<geom {GEOMS[geom]}/></body>'
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><asset><mesh name="stone" vertex="{stone}"/>'
        f'<hfield name="hills" nrow="5" ncol="6" size=".3 .25 .1 .05" elevation="{hills}"/></asset>'
        f'<worldbody>{bodies}</worldbody><deformable>{"".join(part for _, part in parts)}</deformable></mujoco>')


def compiled(m):
    """The arrays of a model that its contacts depend on; what is left out is zero."""
    needed = ("body_", "jnt_", "dof_", "tree_", "geom_", "flex", "mesh_", "hfield_", "bvh_", "oct_", "qpos")
    return {key: value for key, value in record.compiled(m).items()
            if key.startswith("opt.") or key == "size.ngeom" or np.any(value) and (
                key.startswith("size.") or key.startswith("model.") and key[6:].startswith(needed))}


def draw(m, geom, rng):
    """Places one pair: elements of random shape, a point of each at the origin or close to it, the geom turned at
    random or not at all."""
    qpos, mocap_pos, mocap_quat = m.qpos0.copy(), np.zeros((m.nmocap, 3)), np.tile([1.0, 0, 0, 0], (m.nmocap, 1))
    spread, near = rng.uniform(0.03, 0.15), (0.06 if geom else RADIUS)
    for f in range(m.nflex):
        corners = m.flex_dim[f] + 1
        for first in range(0, m.flex_vertnum[f], corners):
            places = rng.normal(size=(corners, 3)) * spread
            places += rng.normal(size=3) * near - rng.dirichlet(np.ones(corners)) @ places
            for k, place in enumerate(places, first):
                body = m.flex_vertbodyid[m.flex_vertadr[f] + k]
                address = m.jnt_qposadr[m.body_jntadr[body]]
                qpos[address:address + 3] = place - m.body_pos[body]
    if geom:
        quat = np.array([1.0, 0, 0, 0]) if rng.random() < 0.25 else rng.normal(size=4)
        quat, place = quat / np.linalg.norm(quat), rng.normal(size=3) * 0.03
        if geom in FIXED:
            mocap_pos[0], mocap_quat[0] = place, quat
        else:
            qpos[-7:] = np.concatenate([place, quat])
    return qpos, mocap_pos, mocap_quat


FIELDS = ["geom", "flex", "elem", "vert", "dist", "pos", "frame"]


def contacts(m, d, qpos, mocap_pos, mocap_quat):
    d.qpos[:], d.mocap_pos[:], d.mocap_quat[:] = qpos, mocap_pos, mocap_quat
    mujoco.mj_kinematics(m, d)
    mujoco.mj_comPos(m, d)
    mujoco.mj_flex(m, d)
    mujoco.mj_collision(m, d)
    return {name: np.array(getattr(d.contact, name)) for name in FIELDS} if d.ncon else None


def unlike(a, b):
    """The contacts differ in number or by more than the bound."""
    if a is None or b is None:
        return a is not b
    return any(a[n].shape != b[n].shape or not (np.abs(a[n] - b[n]) <= STABLE).all() for n in FIELDS)


def chunk(m, d, geom, count, rng):
    """Placements and MuJoCo's answers."""
    m.flex_margin[:] = 10 ** rng.uniform(-4, -1.5) * (rng.random() < 0.4)
    m.flex_gap[:] = m.flex_margin * rng.random() * (rng.random() < 0.5)
    m.geom_margin[:] = 10 ** rng.uniform(-4, -1.5) * (rng.random() < 0.4)
    out = {"model." + name: getattr(m, name).copy() for name in ("flex_margin", "flex_gap", "geom_margin")}
    rows = {name: [] for name in ("qpos", "mocap_pos", "mocap_quat", "ncon", "unstable")}
    found = []
    for _ in range(count):
        at = draw(m, geom, rng)
        here = contacts(m, d, *at)
        step = rng.uniform(-NUDGE, NUDGE, m.nq)
        unstable = any(unlike(here, contacts(m, d, at[0] + sign * step, *at[1:])) for sign in (1, -1))
        for name, value in zip(rows, (*at, 0 if here is None else len(here["dist"]), unstable)):
            rows[name].append(value)
        if here is not None:
            found.append(here)
    empty = {"geom": (0, 2), "flex": (0, 2), "elem": (0, 2), "vert": (0, 2), "dist": (0,), "pos": (0, 3), "frame": (0, 9)}
    for name in FIELDS:
        out["contact." + name] = np.concatenate([f[name] for f in found]) if found else np.zeros(empty[name])
    return out | {name: np.array(value) for name, value in rows.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=20_000, help="placements of every pair")
    parser.add_argument("--variant-count", type=int, default=2_000, help="placements of every pair in each variant")
    parser.add_argument("--only", default="", help="pairs whose name contains this, such as line-box")
    parser.add_argument("--pack", action="store_true", help="compress")
    args = parser.parse_args()
    if mujoco.__version__ != "3.12.0":
        sys.exit(f"mujoco 3.12.0 is needed, this is {mujoco.__version__}")

    def send(arrays):
        file = io.BytesIO()
        (np.savez_compressed if args.pack else np.savez)(file, **arrays)
        sys.stdout.buffer.write(struct.pack("<Q", file.tell()) + file.getbuffer())

    pairs = [(f"{NAMES[dim]}–{geom}", geom, [(dim, 1)]) for dim in NAMES for geom in GEOMS]
    pairs += [(f"{NAMES[a]}–{NAMES[b]}", None, [(a, 1), (b, 1)]) for a in NAMES for b in NAMES if a <= b]
    pairs += [(f"{NAMES[dim]} of its own flex", None, [(dim, 2)]) for dim in NAMES]
    for number, (name, geom, flexes) in enumerate(pairs):
        if args.only not in name.replace("–", "-"):
            continue
        m = model(geom, flexes)
        d = mujoco.MjData(m)
        send(compiled(m))
        for variant, (label, options) in enumerate(VARIANTS.items()):
            count = args.variant_count if variant else args.count
            m.opt.disableflags = options.get("disableflags", 0)
            for part in range(0, count, CHUNK):
                rng = np.random.default_rng([args.seed, number, variant, part])
                texts = {key: np.frombuffer(text.encode(), np.uint8) for key, text in (("flexes", name), ("variant", label))}
                send(chunk(m, d, geom, min(CHUNK, count - part), rng) | texts
                     | {"opt.disableflags": np.int32(m.opt.disableflags)})
        print(name, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
