"""Pairs of geoms at random places, for `collide.py`: one model whose geoms change type, size and mesh at run time.

Slot k has geom a on a mocap body and geom b on a free body; contact types let a slot's geoms meet each other alone, so
every slot is an independent pair that passes the broad phase."""

from pathlib import Path

import mujoco
import numpy as np

from record import compiled

TYPES = ["plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh"]
PLANE, HFIELD, SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = range(8)
PAIRS = [(a, b) for a in range(8) for b in range(max(a, SPHERE), 8)]

EXTENT = 0.2
FIELDS = [(2, 2, 0.2), (5, 8, 0.5), (12, 15, 0.7), (16, 16, 0.8)]
"""Rows, columns and half-size of the height fields."""

# Of all placements: how the geoms are turned, and how deep they are put into each other.
TURNED, NEARLY_ALIGNED, ALIGNED = 0.65, 0.2, 0.15
DEPTHS = ["apart", "touching", "hair", "shallow", "deep", "deeper", "centred"]
DEPTH_SHARES = [0.15, 0.05, 0.1, 0.3, 0.25, 0.1, 0.05]


def own_meshes():
    """Small meshes: few and many vertices, flat and long faces, a shape that is not convex."""
    rng = np.random.default_rng(0)
    ring = [(np.cos(a), np.sin(a)) for a in 2 * np.pi * np.arange(14) / 14]
    corners = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
    cloud = rng.normal(size=(60, 3))
    points = {
        "tetrahedron": np.array([[1, 0, 0], [-0.5, 0.8, 0], [-0.5, -0.8, 0], [0, 0, 1.2]]),
        "cuboid": corners * [1, 0.6, 0.3],
        "drum": np.array([(x, y, z) for x, y in ring for z in (-0.5, 0.5)]),
        "needle": np.array([(0.08 * x, 0.08 * y, z) for x, y in ring[::2] for z in (-1, 1)]),
        "slab": corners * [1, 0.9, 0.02],
        "pebble": cloud / np.linalg.norm(cloud, axis=1, keepdims=True) * [1, 0.8, 0.6],
        "corner": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0.3, 0.3, 0.3], [1, 1, 0]]),
    }
    scaled = {name: EXTENT * p / np.ptp(p, axis=0).max() for name, p in points.items()}
    return [f'<mesh name="{name}" vertex="{" ".join(f"{x:.9g}" for x in p.ravel())}"/>' for name, p in scaled.items()]


def corpus_meshes(corpus, count):
    """`count` mesh files: all below `corpus`, sorted by path, at equal strides; one that MuJoCo refuses yields to the
    next. Each is scaled to the same extent."""
    files = sorted(p for p in Path(corpus).rglob("*") if p.suffix.lower() in (".stl", ".obj", ".msh"))
    chosen = []
    for k in range(count):
        for path in files[k * len(files) // count:]:
            try:
                alone = mujoco.MjModel.from_xml_string(
                    f'<mujoco><asset><mesh name="m" file="{path}"/></asset>'
                    '<worldbody><geom type="mesh" mesh="m"/></worldbody></mujoco>')
            except ValueError:
                continue
            scale = EXTENT / (2 * alone.geom_size[0].max())
            element = f'<mesh name="m{k}" file="{path}" scale="{scale:.9g} {scale:.9g} {scale:.9g}"/>'
            chosen.append((path.relative_to(corpus), element))
            break
    return chosen


def build(meshes, slots, predefined):
    """The model; `predefined` makes the pairs by `contact/pair` instead of contact types."""
    fields = "".join(f'<hfield name="h{k}" nrow="{r}" ncol="{c}" size="{s} {0.8 * s} 0.15 0.05"/>'
                     for k, (r, c, s) in enumerate(FIELDS))
    names = [element.split('"')[1] for element in meshes]
    templates = ['<geom type="plane" size="1 1 .1" {}/>']
    templates += [f'<geom type="hfield" hfield="h{k}" {{}}/>' for k in range(len(FIELDS))]
    templates += [f'<geom type="mesh" mesh="{n}" {{}}/>' for n in names]
    world = "".join(t.format(f'contype="0" conaffinity="0" pos="0 0 {-1.5 - 0.1 * k:.1f}"')
                    for k, t in enumerate(templates))
    bodies = "".join(
        f'<body mocap="true"><geom name="a{k}" size=".1" contype="{bit}" conaffinity="0"/></body>'
        f'<body><freejoint/><geom name="b{k}" size=".1" contype="0" conaffinity="{bit}"/></body>'
        for k, bit in enumerate([0 if predefined else 1 << k for k in range(slots)]))
    pairs = "".join(f'<pair geom1="a{k}" geom2="b{k}"/>' for k in range(slots)) if predefined else ""
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><size memory="64M"/><asset>{fields}{"".join(meshes)}</asset>'
        f'<worldbody>{world}{bodies}</worldbody><contact>{pairs}</contact></mujoco>')


NEEDED = ("opt.", "size.", "model.body_", "model.geom_", "model.mesh_", "model.hfield_", "model.bvh_", "model.pair_")


def model_arrays(model):
    """What collision and rays need of the compiled model, less what is zero."""
    return {name: value for name, value in compiled(model).items()
            if name.startswith(NEEDED) and (name.startswith("opt.") or np.any(value))}


class Templates:
    """Size, bounds and data of each type, by type and choice of mesh or height field."""

    def __init__(self, model):
        self.model = model
        kinds = model.geom_type
        self.by_type = {t: np.flatnonzero((kinds == t) & (model.geom_bodyid == 0)) for t in (PLANE, HFIELD, MESH)}

    def draw(self, kind, n, rng, largest):
        """`n` geoms of a type: arrays of sizes, bounding radii, boxes, data ids."""
        m = self.model
        if kind in self.by_type:
            geoms = rng.choice(self.by_type[kind], n)
            return (m.geom_size[geoms], m.geom_rbound[geoms], m.geom_aabb[geoms], m.geom_dataid[geoms])
        size = np.exp(rng.uniform(np.log(0.01), np.log(largest), (n, 3))).astype(np.float32).astype(float)
        r, h, flat = size[:, 0], size[:, 1], np.zeros(n)
        if kind == SPHERE:
            size, bound, half = np.stack([r, flat, flat], 1), r, np.stack([r, r, r], 1)
        elif kind == CAPSULE:
            size, bound, half = np.stack([r, h, flat], 1), r + h, np.stack([r, r, r + h], 1)
        elif kind == CYLINDER:
            size, bound, half = np.stack([r, h, flat], 1), np.sqrt(r * r + h * h), np.stack([r, r, h], 1)
        else:
            bound = size.max(1) if kind == ELLIPSOID else np.sqrt((size * size).sum(1))
            half = size
        return size, bound, np.concatenate([np.zeros((n, 3)), half], 1), np.full(n, -1)


def depth_below(kind, size, aabb, mat):
    """How far geoms reach below their origin; meshes by their boxes."""
    down = mat[:, 2, :]
    flat = np.sqrt(np.maximum(0, 1 - down[:, 2] ** 2))
    if kind == SPHERE:
        return size[:, 0]
    if kind == CAPSULE:
        return size[:, 0] + size[:, 1] * np.abs(down[:, 2])
    if kind == ELLIPSOID:
        return np.sqrt(((size * down) ** 2).sum(1))
    if kind == CYLINDER:
        return size[:, 1] * np.abs(down[:, 2]) + size[:, 0] * flat
    return (np.abs(down) * aabb[:, 3:]).sum(1) - (down * aabb[:, :3]).sum(1)


def terrain(rng, groups, model):
    """Heights for every group of placements: level, gentle, or rough."""
    noise = rng.random((groups, model.nhfielddata)) - 0.5
    heights = 0.5 + noise * rng.choice([0, 0.1, 1], (groups, 1), p=[0.2, 0.5, 0.3])
    return (np.round(256 * heights) / 256).astype(np.float32)


def height(model, heights, field, x, y):
    """Height of a field at a place, from the nearest node."""
    size, columns, rows = model.hfield_size[field], model.hfield_ncol[field], model.hfield_nrow[field]
    node = lambda at, half, count: np.clip(np.rint((at / half + 1) / 2 * (count - 1)), 0, count - 1).astype(int)
    cell = node(y, size[:, 1], rows) * columns + node(x, size[:, 0], columns)
    return heights[np.arange(len(x)), model.hfield_adr[field] + cell] * size[:, 2]


def quaternions(rng, n):
    q = rng.normal(size=(n, 4))
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def matrices(q):
    w, x, y, z = q.T
    rows = [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
            2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
            2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]
    return np.stack(rows, 1).reshape(-1, 3, 3)


def cube_turns():
    """The 24 rotations of a cube."""
    axes = np.eye(3)
    turns = []
    for i in range(3):
        for j in (k for k in range(3) if k != i):
            for s in (1, -1):
                for t in (1, -1):
                    x, y = s * axes[i], t * axes[j]
                    turns.append(np.stack([x, y, np.cross(x, y)]))
    return np.array(turns)


def skew(v):
    x, y, z = v.T
    o = np.zeros(len(v))
    return np.stack([o, -z, y, z, o, -x, -y, x, o], 1).reshape(-1, 3, 3)


def orientations(rng, n):
    """Matrices of both geoms, and which of them are aligned with each other or nearly so."""
    cube = cube_turns()
    style = rng.choice(3, n, p=[TURNED, NEARLY_ALIGNED, ALIGNED])[:, None, None]
    a = matrices(quaternions(rng, n))
    turn = cube[rng.integers(24, size=n)]
    tilt = rng.normal(size=(n, 4)) * 10 ** rng.uniform(-9, -1, (n, 1)) + [1, 0, 0, 0]
    near = a @ turn @ matrices(tilt / np.linalg.norm(tilt, axis=1, keepdims=True))
    straight = cube[rng.integers(24, size=n)]
    mat_a = np.where(style == 2, straight, a)
    free, other = matrices(quaternions(rng, n)), cube[rng.integers(24, size=n)]
    mat_b = np.where(style == 0, free, np.where(style == 1, near, other))
    return mat_a, mat_b, style[:, 0, 0]


def margins(rng, n, length):
    """Margin and gap of each geom: none in most pairs."""
    drawn = length[:, None] * 10 ** rng.uniform(-3, -0.5, (n, 4))
    has = rng.random((n, 1)) < 0.4
    gap = rng.random((n, 2)) < 0.5
    return np.where(has, drawn[:, :2], 0.0), np.where(has & gap, drawn[:, 2:], 0.0)


def depths(rng, n, length, reach):
    """How far the surfaces overlap along the line of nearest points; negative for a distance."""
    kind = rng.choice(len(DEPTHS), n, p=DEPTH_SHARES)
    power = lambda low, high: 10 ** rng.uniform(low, high, n)
    apart = np.where(reach > 0, rng.uniform(0, 1.2, n) * reach, length * power(-6, 0))
    choices = [-apart, np.zeros(n), power(-12, -7), length * power(-5, -2), length * rng.uniform(0.01, 0.3, n),
               length * rng.uniform(0.3, 1.2, n), np.zeros(n)]
    return np.choose(kind, choices), kind
