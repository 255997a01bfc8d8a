#!/usr/bin/env python3
"""Writes what MuJoCo 3.12.0 says of pairs of geoms at random places, as a stream for `robohive-validation collide`.

    pip install mujoco==3.12.0
    python collide.py --count 100000 --corpus CORPUS | robohive-validation collide

Everything follows from the seed. The stream is a row of numpy archives, each after its length in eight bytes, little
endian: a compiled model, then chunks of placements, then chunks of rays (see `rays.py`). A chunk of placements has

    variant, slots              settings; independent pairs that the model holds at a time
    pair                        geom types, of every `slots` placements
    opt.NAME                    the options that the variant changes
    size, rbound, aabb, dataid, margin, gap     of both geoms of every placement
    xpos, xmat                  where they are
    hfield_data                 heights, for every `slots` placements
    parameter.NAME              arrays of predefined pairs
    ncon, contact.NAME          contacts of every placement
    distmax, flip, distance, fromto     `mj_geomDistance`, of the geoms in either order
    unstable, unstable_distance     MuJoCo's answer changes in count or by more than 1e-9 where the second geom moves
                                    and turns by 1e-12, to and fro along one random direction
"""

import argparse
import io
import struct
import sys

import mujoco
import numpy as np

import rays
from placements import (HFIELD, PAIRS, PLANE, TYPES, Templates, build, corpus_meshes, depth_below, depths, height,
                        margins, model_arrays, orientations, own_meshes, skew, terrain)

NUDGE = 1e-12
STABLE = 1e-9
GROUPS = 64
FAR = 10.0

DISABLE, ENABLE = mujoco.mjtDisableBit, mujoco.mjtEnableBit
VARIANTS = {
    "default": {},
    "multiccd disabled": {"disableflags": int(DISABLE.mjDSBL_MULTICCD)},
    "nativeccd disabled": {"disableflags": int(DISABLE.mjDSBL_NATIVECCD)},
    "both disabled": {"disableflags": int(DISABLE.mjDSBL_NATIVECCD) | int(DISABLE.mjDSBL_MULTICCD)},
    "12 iterations, tolerance 1e-3": {"ccd_iterations": 12, "ccd_tolerance": 1e-3},
    "tolerance 1e-10": {"ccd_tolerance": 1e-10},
    "contact/pair": {},
    "global override": {"enableflags": int(ENABLE.mjENBL_OVERRIDE), "o_margin": 0.01},
}
PARAMETERS = ["includemargin", "friction", "solref", "solreffriction", "solimp", "dim", "exclude"]


class Scene:
    """A model and the pairs placed in it."""

    def __init__(self, model, slots):
        self.model, self.slots = model, slots
        self.data = mujoco.MjData(model)
        self.first = model.ngeom - 2 * slots
        self.templates = Templates(model)
        self.defaults = {n: np.copy(getattr(model.opt, n)) for n in ("disableflags", "enableflags", "o_margin",
                                                                      "ccd_iterations", "ccd_tolerance")}
        mujoco.mj_kinematics(model, self.data)

    def choose(self, options):
        for name, value in (self.defaults | options).items():
            setattr(self.model.opt, name, value.item() if isinstance(value, np.ndarray) else value)

    def put(self, case, group):
        """Places the pairs of one group; `case` arrays are [placement, geom of the pair, ...]."""
        rows = slice(group * self.slots, (group + 1) * self.slots)
        m, geoms = self.model, slice(self.first, None)
        m.geom_type[geoms].reshape(-1, 2)[:] = case["pair"][group]
        for name in ("size", "rbound", "aabb", "dataid", "margin", "gap"):
            array = getattr(m, "geom_" + name)[geoms]
            array[:] = case[name][rows].reshape(array.shape)
        for name in ("xpos", "xmat"):
            array = getattr(self.data, "geom_" + name)[geoms]
            array[:] = case[name][rows].reshape(array.shape)
        if "hfield_data" in case:
            m.hfield_data[:] = case["hfield_data"][group]
        for name in (n for n in case if n.startswith("parameter.")):
            getattr(m, name.removeprefix("parameter."))[:] = case[name][rows]

    def move(self, xpos, xmat, group):
        """Moves the second geoms to new places."""
        rows = slice(group * self.slots, (group + 1) * self.slots)
        self.data.geom_xpos[self.first + 1::2] = xpos[rows]
        self.data.geom_xmat[self.first + 1::2] = xmat[rows].reshape(-1, 9)

    def contacts(self):
        """Contacts of the group in order, with the slot of each."""
        mujoco.mj_collision(self.model, self.data)
        contact = self.data.contact
        out = {name: np.array(getattr(contact, name)) for name in ["geom", "dist", "pos", "frame"] + PARAMETERS}
        if not self.data.ncon:
            out["geom"] = np.zeros((0, 2), np.int32)
        out["slot"] = (out["geom"].min(axis=1) - self.first) // 2
        assert (np.diff(out["slot"]) >= 0).all()
        return out

    def distances(self, limits, flips):
        segment, dist, fromto = np.zeros(6), [], []
        for slot, (limit, flip) in enumerate(zip(limits, flips)):
            a, b = self.first + 2 * slot, self.first + 2 * slot + 1
            if flip:
                a, b = b, a
            dist.append(mujoco.mj_geomDistance(self.model, self.data, a, b, limit, segment))
            fromto.append(segment.copy())
        return np.array(dist), np.array(fromto)


def unlike(a, b, slots):
    """Slots whose contacts differ in number or by more than the bound."""
    bad = np.bincount(a["slot"], minlength=slots) != np.bincount(b["slot"], minlength=slots)
    rows_a, rows_b = (np.flatnonzero(~bad[c["slot"]]) for c in (a, b))
    for name in ("geom", "dist", "pos", "frame"):
        gap = np.abs(a[name][rows_a].reshape(len(rows_a), -1) - b[name][rows_b].reshape(len(rows_b), -1))
        moved = ~(gap.max(axis=1, initial=0.0) <= STABLE)
        bad[a["slot"][rows_a[moved]]] = True
    return bad


def draw(scene, pair, n, rng):
    """Geoms and a first placement, apart from each other except above height fields."""
    a, b = pair
    largest = 0.12 if a == HFIELD else 0.3
    kinds = [scene.templates.draw(kind, n, rng, largest) for kind in pair]
    case = {"pair": np.tile(np.array(pair, np.int32), (n // scene.slots, 1))}
    case |= {name: np.stack(both, 1) for name, both in zip(["size", "rbound", "aabb", "dataid"], zip(*kinds))}
    bound = case["rbound"]
    length = bound[:, 1] if a in (PLANE, HFIELD) else bound.min(axis=1)
    case["margin"], case["gap"] = margins(rng, n, length)
    mat_a, mat_b, style = orientations(rng, n)
    pos_a = rng.normal(size=(n, 3)) * rng.choice([0.0, 0.5], (n, 1))
    along = rng.normal(size=(n, 3))
    straight = mat_a[np.arange(n), :, rng.integers(3, size=n)] * rng.choice([-1, 1], (n, 1))
    along = np.where((style == 0)[:, None], along, straight + along * rng.choice([0, 0.05, 0.3], (n, 1)))
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    pos_b = pos_a + 1.1 * along * bound.sum(axis=1, keepdims=True)
    if a == PLANE:
        pos_b = pos_a + mat_a[:, :, 2] * 1.1 * bound[:, 1:] + 0.1 * rng.normal(size=(n, 3)) @ np.diag([1, 1, 0])
        pos_b += mat_a[:, :, 2] * np.maximum(0, 1.1 * bound[:, 1] - ((pos_b - pos_a) * mat_a[:, :, 2]).sum(1))[:, None]
    if a == HFIELD:
        case["hfield_data"] = terrain(rng, n // scene.slots, scene.model)
        half, (depth, _) = case["size"][:, 0], depths(rng, n, length, (case["margin"] + case["gap"]).sum(axis=1))
        local = rng.uniform(-1.05, 1.05, (n, 3)) * half
        surface = height(scene.model, np.repeat(case["hfield_data"], scene.slots, 0), case["dataid"][:, 0],
                         local[:, 0], local[:, 1])
        turned = np.einsum("nji,njk->nik", mat_a, mat_b)
        local[:, 2] = surface + depth_below(b, case["size"][:, 1], case["aabb"][:, 1], turned) - depth
        pos_b = pos_a + np.einsum("nij,nj->ni", mat_a, local)
    case["xpos"], case["xmat"] = np.stack([pos_a, pos_b], 1), np.stack([mat_a, mat_b], 1)
    return case, length


def approach(scene, case, length, rng):
    """Moves the second geoms along the line of nearest points to their depth."""
    n = len(length)
    depth, kind = depths(rng, n, length, (case["margin"] + case["gap"]).sum(axis=1))
    every = np.full(scene.slots, FAR)
    for group in range(n // scene.slots):
        scene.put(case, group)
        rows = slice(group * scene.slots, (group + 1) * scene.slots)
        dist, fromto = scene.distances(every, every < 0)
        span = fromto[:, 3:] - fromto[:, :3]
        reach = np.linalg.norm(span, axis=1)
        normal = span / np.maximum(reach, 1e-300)[:, None]
        shift = np.where(reach > 0, dist + depth[rows], 0.0)
        case["xpos"][rows, 1] -= shift[:, None] * normal
    centred = (kind == 6)[:, None] & (case["pair"][0, 0] != PLANE)
    near = case["xpos"][:, 0] + length[:, None] * rng.normal(size=(n, 3)) * rng.choice([0.0, 1e-6, 0.1], (n, 1))
    case["xpos"][:, 1] = np.where(centred, near, case["xpos"][:, 1])


def predefine(model, n, rng):
    """Random parameters of predefined pairs, the margin as that of the geoms would be."""
    return {
        "parameter.pair_margin": 10 ** rng.uniform(-4, -1.5, n) * (rng.random(n) < 0.6),
        "parameter.pair_gap": 10 ** rng.uniform(-4, -1.5, n) * (rng.random(n) < 0.3),
        "parameter.pair_friction": rng.uniform(0.0, 2.0, (n, 5)),
        "parameter.pair_solref": np.stack([rng.uniform(0.005, 0.1, n), rng.uniform(0.5, 2, n)], 1),
        "parameter.pair_solreffriction": np.stack([rng.uniform(0.005, 0.1, n), rng.uniform(0.5, 2, n)], 1),
        "parameter.pair_solimp": model.pair_solimp[0] * rng.uniform(0.5, 1, (n, 5)),
        "parameter.pair_dim": rng.choice([1, 3, 4, 6], n).astype(np.int32),
    }


def chunk(scene, variant, pair, n, rng):
    """`n` placements and MuJoCo's answers."""
    slots, options = scene.slots, VARIANTS[variant]
    scene.choose({})
    case, length = draw(scene, pair, n, rng)
    if pair[0] != HFIELD:
        approach(scene, case, length, rng)
    if variant == "contact/pair":
        case |= predefine(scene.model, n, rng)
    scene.choose(options)
    case["distmax"], case["flip"] = 10 ** rng.uniform(-3, 0.5, n), rng.random(n) < 0.5
    step = rng.normal(size=(n, 6))
    step *= NUDGE / np.linalg.norm(step, axis=1, keepdims=True)
    nudged = [(case["xpos"][:, 1] + sign * step[:, :3],
               case["xmat"][:, 1] + sign * skew(step[:, 3:]) @ case["xmat"][:, 1]) for sign in (1, -1)]
    parts = {name: [] for name in ["ncon", "unstable", "unstable_distance", "distance", "fromto"]}
    kept = []
    for group in range(n // slots):
        rows = slice(group * slots, (group + 1) * slots)
        scene.put(case, group)
        found = scene.contacts()
        dist, fromto = scene.distances(case["distmax"][rows], case["flip"][rows])
        unstable, unstable_distance = np.zeros(slots, bool), np.zeros(slots, bool)
        for pose in nudged:
            scene.move(*pose, group)
            unstable |= unlike(found, scene.contacts(), slots)
            other, segment = scene.distances(case["distmax"][rows], case["flip"][rows])
            unstable_distance |= ~(np.abs(other - dist) <= STABLE) | ~(np.abs(segment - fromto).max(axis=1) <= STABLE)
        parts["ncon"].append(np.bincount(found["slot"], minlength=slots))
        for name, value in zip(["unstable", "unstable_distance", "distance", "fromto"],
                               [unstable, unstable_distance, dist, fromto]):
            parts[name].append(value)
        kept.append(found)
    out = case | {name: np.concatenate(value) for name, value in parts.items()}
    out["ncon"] = out["ncon"].astype(np.int32)
    shown = ["geom", "dist", "pos", "frame"] + (PARAMETERS if variant == "contact/pair" else [])
    out |= {"contact." + name: np.concatenate([k[name] for k in kept if len(k["slot"])] or [kept[0][name]])
            for name in shown}
    out |= {"opt." + name: np.asarray(value) for name, value in options.items()}
    return out | {"variant": np.frombuffer(variant.encode(), np.uint8), "slots": np.int64(slots)}


def merged(chunks):
    """Chunks of one variant as one; heights are zero where there are none."""
    groups = [len(c["pair"]) for c in chunks]
    wide = max((c["hfield_data"].shape[1] for c in chunks if "hfield_data" in c), default=0)
    for c, n in zip(chunks, groups):
        c.setdefault("hfield_data", np.zeros((n, wide), np.float32))
    shared = [name for name in chunks[0] if name in ("variant", "slots") or name.startswith("opt.")]
    return {name: chunks[0][name] if name in shared else np.concatenate([c[name] for c in chunks])
            for name in chunks[0]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=100_000, help="placements of every pair")
    parser.add_argument("--variant-count", type=int, default=10_000, help="placements of every pair in each variant")
    parser.add_argument("--rays", type=int, default=100_000, help="rays of every type")
    parser.add_argument("--corpus", help="folder whose meshes are used instead of our own")
    parser.add_argument("--meshes", type=int, default=20, help="how many")
    parser.add_argument("--slots", type=int, default=31, help="pairs that one model holds at a time, at most 31")
    parser.add_argument("--only", default="", help="pairs whose name contains this, such as box-mesh")
    parser.add_argument("--variants", nargs="*", default=list(VARIANTS), choices=list(VARIANTS), metavar="NAME")
    parser.add_argument("--pack", action="store_true", help="compress, with all pairs of a variant in one chunk, and "
                        "the rays through the model of the last variant")
    args = parser.parse_args()
    if mujoco.__version__ != "3.12.0":
        sys.exit(f"mujoco 3.12.0 is needed, this is {mujoco.__version__}")
    meshes = own_meshes()
    if args.corpus:
        chosen = corpus_meshes(args.corpus, args.meshes)
        print(*(name for name, _ in chosen), sep="\n", file=sys.stderr)
        meshes = [element for _, element in chosen]

    def send(arrays):
        file = io.BytesIO()
        (np.savez_compressed if args.pack else np.savez)(file, **arrays)
        sys.stdout.buffer.write(struct.pack("<Q", file.tell()) + file.getbuffer())

    scene, was_predefined = None, None
    for number, variant in enumerate(VARIANTS):
        count, predefined = args.variant_count if number else args.count, variant == "contact/pair"
        if not count or variant not in args.variants:
            continue
        if predefined != was_predefined:
            scene, was_predefined = Scene(build(meshes, args.slots, predefined), args.slots), predefined
            send(model_arrays(scene.model))
        chunks = []
        for pair in PAIRS:
            if args.only not in f"{TYPES[pair[0]]}-{TYPES[pair[1]]}":
                continue
            groups, part = -(-count // args.slots), 0
            while groups:
                now = min(groups, GROUPS)
                rng = np.random.default_rng([args.seed, number, *pair, part])
                chunks.append(chunk(scene, variant, pair, now * args.slots, rng))
                groups, part = groups - now, part + 1
                if not args.pack:
                    send(chunks.pop())
        if args.pack:
            send(merged(chunks))
        print(variant, file=sys.stderr, flush=True)
    if args.rays:
        rays.record(meshes, args, send)


if __name__ == "__main__":
    main()
