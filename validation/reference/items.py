#!/usr/bin/env python3
"""Records the scenes that MuJoCo 3.12.0 assembles for a picture: what is drawn, by which lights, from which camera.

    pip install mujoco==3.12.0
    python items.py --out DIR [--brief] MODEL.xml [MODEL.xml ...]
    python items.py --out DIR --corpus FOLDER --list FILE

One archive a model, named after its path. Its arrays:

    state.NAME      rows of states, taken from a moving rollout, with forces on some bodies
    selection.NAME  the selected body and what it is pulled to
    scene.state, scene.camera, scene.variant, scene.view     one row a scene: row of the state, camera (-1 free, -2 free
                    and tracking the selected body), row of VARIANTS; camera between both eyes: pos, forward, up,
                    frustum center, width, bottom, top, near, far, orthographic
    scene.items, scene.lights   how many rows of the following belong to a scene
    item.code       type, dataid, objtype, objid, category, segid, matid
    item.number     pos, mat, size, rgba, emission, specular, shininess, reflectance, modelrbound
    item.label      text, in bytes
    light.code      type, headlight, castshadow
    light.number    pos, dir, attenuation, exponent, cutoff, ambient, diffuse, specular

Every scene is updated twice, since infinite planes are centred by the camera of the previous update. With --brief there
are one state and few numbers, for a record to be kept.
"""

import sys

import mujoco
import numpy as np

from record import INPUTS, arguments, controls, jobs, load, rollout

STATES, EVERY = 3, 40
CAMERAS = 4
FLAG = mujoco.mjtVisFlag
LABEL = mujoco.mjtLabel
FRAME = mujoco.mjtFrame


def flags(*names, off=()):
    def choose(option, _):
        for name in names:
            option.flags[getattr(FLAG, "mjVIS_" + name)] = 1
        for name in off:
            option.flags[getattr(FLAG, "mjVIS_" + name)] = 0
    return choose


def groups(*shown):
    def choose(option, _):
        for kind in ("geom", "site", "joint", "tendon", "actuator"):
            getattr(option, kind + "group")[:] = [g in shown for g in range(6)]
        flags("JOINT", "ACTUATOR")(option, None)
    return choose


def label(name, *also, frame=None):
    def choose(option, _):
        option.label = getattr(LABEL, "mjLABEL_" + name)
        if frame:
            option.frame = getattr(FRAME, "mjFRAME_" + frame)
        flags(*also)(option, None)
    return choose


def frame(name, *also):
    return label("NONE", *also, frame=name)


def pull(first, second, *also):
    def choose(option, perturb):
        perturb.active, perturb.active2 = first, second
        flags(*also)(option, None)
    return choose


def deep(name, depth):
    def choose(option, _):
        flags(name)(option, None)
        option.bvh_depth = depth
    return choose


VARIANTS = [
    lambda option, perturb: None,
    flags("CONVEXHULL"), flags(off=["TEXTURE"]), flags("JOINT"), flags("CAMERA"), flags("ACTUATOR"),
    flags("ACTUATOR", "ACTIVATION"), flags("LIGHT"), flags(off=["TENDON"]), flags(off=["RANGEFINDER"]),
    flags("CONSTRAINT"), flags("INERTIA"), flags("INERTIA", "SCLINERTIA"), flags("PERTFORCE"),
    flags("CONTACTPOINT"), flags("CONTACTPOINT", "ISLAND"), flags("CONTACTFORCE"),
    flags("CONTACTFORCE", "CONTACTSPLIT"), flags("TRANSPARENT"), flags("AUTOCONNECT"), flags("COM"),
    flags(off=["STATIC"]), deep("BODYBVH", 1), deep("MESHBVH", 2),
    pull(1, 0), pull(2, 1), pull(3, 3, "INERTIA"), pull(1, 2, "SELECT"), flags(off=["PERTOBJ"]),
    frame("BODY"), frame("BODY", "INERTIA"), frame("GEOM"), frame("SITE"), frame("CAMERA", "CAMERA"),
    frame("LIGHT", "LIGHT"), frame("CONTACT"), frame("WORLD"),
    label("BODY"), label("BODY", "INERTIA"), label("JOINT", "JOINT"), label("GEOM"), label("SITE"),
    label("CAMERA", "CAMERA"), label("LIGHT", "LIGHT"), label("TENDON"), label("ACTUATOR", "ACTUATOR"),
    label("CONSTRAINT", "CONSTRAINT"), label("SELECTION"), label("SELPNT", "SELECT"),
    label("CONTACTPOINT", "CONTACTPOINT"), label("CONTACTFORCE", "CONTACTFORCE"), label("ISLAND"),
    groups(0), groups(1, 2), groups(3, 4, 5),
]
"""What a scene shows beside or instead of the default, in the order of `variant` in `src/scenes.rs`."""

MESH_TREES = 23
"""Row of VARIANTS with the volumes of meshes, of which MuJoCo takes those of another mesh for a height field."""


def states(model, count):
    """Rows of states of a rollout, with forces on every third body."""
    rows = {name: [] for name in INPUTS + ["time"]}
    rng = np.random.default_rng(1)

    def keep(step, data):
        if step % EVERY == EVERY - 1:
            data.xfrc_applied[1::3] = rng.uniform(-1, 1, data.xfrc_applied[1::3].shape)
            for name in rows:
                rows[name].append(np.array(getattr(data, name)))
            data.xfrc_applied[:] = 0

    rollout(model, controls(model, count * EVERY, 0), keep=keep)
    return {name: np.array(values) for name, values in rows.items()}


def selection(model):
    """A moving body and what it is pulled to; a body without geoms where there is one."""
    moving = [b for b in range(1, model.nbody) if model.body_weldid[b]]
    perturb = mujoco.MjvPerturb()
    perturb.select = moving[len(moving) // 2] if moving else 0
    perturb.localpos[:] = [0.01, -0.02, 0.03]
    perturb.refselpos[:] = [0.1, 0.2, 0.7]
    perturb.refquat[:] = np.array([1, 0.5, -0.25, 2]) / np.linalg.norm([1, 0.5, -0.25, 2])
    return perturb


def camera_of(model, perturb, camera):
    chosen = mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, chosen)
    if camera >= 0:
        chosen.type, chosen.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, camera
    elif camera == -2:
        chosen.type, chosen.trackbodyid = mujoco.mjtCamera.mjCAMERA_TRACKING, max(perturb.select, 0)
    return chosen


def view(scene):
    eye = mujoco.mjv_averageCamera(scene.camera[0], scene.camera[1])
    window = [eye.frustum_center, eye.frustum_width, eye.frustum_bottom, eye.frustum_top, eye.frustum_near,
              eye.frustum_far, eye.orthographic]
    return np.concatenate([eye.pos, eye.forward, eye.up, window]).astype(np.float32)


def record(model, brief):
    rows = states(model, 1 if brief else STATES)
    data, perturb = mujoco.MjData(model), selection(model)
    scene = mujoco.MjvScene(model, 100000)
    out = {name: [] for name in ("scene.state", "scene.camera", "scene.variant", "scene.view", "scene.items",
                                 "scene.lights", "item.code", "item.number", "item.label", "light.code",
                                 "light.number")}

    def shoot(state, camera, variant):
        option = mujoco.MjvOption()
        perturb.active = perturb.active2 = 0
        VARIANTS[variant](option, perturb)
        chosen = camera_of(model, perturb, camera)
        for _ in range(2):
            mujoco.mjv_updateScene(model, data, option, perturb, chosen, mujoco.mjtCatBit.mjCAT_ALL, scene)
        out["scene.state"].append(state)
        out["scene.camera"].append(camera)
        out["scene.variant"].append(variant)
        out["scene.view"].append(view(scene))
        out["scene.items"].append(scene.ngeom)
        out["scene.lights"].append(scene.nlight)
        for g in scene.geoms[:scene.ngeom]:
            out["item.code"].append([g.type, g.dataid, g.objtype, g.objid, g.category, g.segid, g.matid])
            numbers = [g.pos, g.mat.ravel(), g.size, g.rgba,
                       [g.emission, g.specular, g.shininess, g.reflectance, g.modelrbound]]
            out["item.number"].append(np.concatenate(numbers))
            out["item.label"].append(np.frombuffer(g.label.encode().ljust(100, b"\0")[:100], np.uint8))
        for light in scene.lights[:scene.nlight]:
            out["light.code"].append([light.type, light.headlight, light.castshadow])
            numbers = [light.pos, light.dir, light.attenuation, [light.exponent, light.cutoff], light.ambient,
                       light.diffuse, light.specular]
            out["light.number"].append(np.concatenate(numbers))

    for state in range(len(rows["time"])):
        mujoco.mj_resetData(model, data)
        for name in rows:
            setattr(data, name, rows[name][state]) if name == "time" else getattr(data, name).__setitem__(
                slice(None), rows[name][state])
        mujoco.mj_forward(model, data)
        for camera in [-1, -2, *range(model.ncam)][:2 + CAMERAS]:
            shoot(state, camera, 0)
    for variant in range(1, len(VARIANTS)):
        if variant != MESH_TREES or not model.nhfield:
            shoot(state, -1, variant)
    kinds = {"code": np.int32, "number": np.float32, "view": np.float32, "label": np.uint8}
    widths = {"item.code": 7, "item.number": 24, "item.label": 100, "light.code": 3, "light.number": 20}
    arrays = {name: np.array(values, kinds.get(name.split(".")[1], np.int32)) for name, values in out.items()}
    for name, width in widths.items():
        arrays[name] = arrays[name].reshape(-1, width)
    chosen = {"body": perturb.select, "point": perturb.localpos, "target": perturb.refselpos,
              "orientation": perturb.refquat}
    return arrays | {"state." + k: v for k, v in rows.items()} | {
        "selection." + k: np.array(v, np.float64) for k, v in chosen.items()}


def main():
    parser = arguments(__doc__)
    parser.add_argument("--brief", action="store_true", help="one state")
    args = parser.parse_args()
    failed = 0
    with jobs(args) as found:
        for name, path in found:
            try:
                np.savez_compressed(args.out / (name + ".npz"), **record(load(path), args.brief))
                print("recorded", name, flush=True)
            except Exception as error:
                failed += 1
                print("FAILED", name, error, flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
