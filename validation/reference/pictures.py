#!/usr/bin/env python3
"""Records the pictures that MuJoCo's offscreen renderer draws of the scenes in `validation/pictures.toml`.

    apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri
    pip install mujoco==3.12.0 pyopengl scikit-image
    python pictures.py [--models FOLDER] --out DIR [--only TEXT] [--sizes 84,224,256] [--again]
    python pictures.py --measures FILE

FOLDER has RoboHive's `envs` and `simhive` and, of MuJoCo's sources, `model`; links will do. Without it own models alone are
recorded; those of `reference/pictures` at a size of 84, for the tests. The folder is copied, not changed:
what 3.12.0 refuses in RoboHive's files is repaired in the copy, as `record.py` does. No display is needed: Mesa's software
rasterisers draw. A recorded scene is skipped, so that an interrupted run goes on where it stopped (`--again` records it
once more). With mujoco==3.1.3, RoboHive's version, the same command records what RoboHive's users saw, of RoboHive's
scenes alone, from unchanged files; give it a folder of its own.

DIR/NAME.npz, drawn by llvmpipe:

    qpos act mocap_pos mocap_quat   the pose: keyframe 0 or qpos0, hinges and slides moved by seeded noise, at rest
    model/NAME                      arrays of the model that were changed after compilation, for scenes with a terrain
    SIDE/rgb                        u8 (SIDE, SIDE, 3), four samples a pixel; SIDE: each of the listed sizes
    SIDE/rgb_no_shadow              the same without shadows
    SIDE/rgb_1                      one sample a pixel
    SIDE/depth                      f32 (SIDE, SIDE), metres
    SIDE/ids                        i32 (SIDE, SIDE, 2), object id and object type of the segmentation, -1 -1 background
    item/NAME, light/NAME           what `mjv_updateScene` assembled: a row for each item or light
    camera/NAME                     its two cameras, one an eye
    meta                            JSON, as bytes: the scene's row, versions, the OpenGL renderer

DIR/floor/NAME.npz: rgb_1, depth and ids of the scenes with the bar `floor`, drawn by softpipe, Mesa's other rasteriser.
How far those are from llvmpipe's is what two correct renderers differ by.

Materials have a shininess of at least 1e-6: Mesa lights 0 wrongly under spot lights, as no specification asks for.

--measures writes what scikit-image and numpy find between two small synthetic pictures, the test of our measures.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SCENES = HERE.parent / "pictures.toml"

# Environment of a child that draws with this rasteriser; MuJoCo picks OpenGL's library when it is imported.
RASTERISERS = {
    "llvmpipe": {"MUJOCO_GL": "egl", "LP_NUM_THREADS": "0"},
    "softpipe": {"MUJOCO_GL": "egl", "GALLIUM_DRIVER": "softpipe"},
}
ROBOHIVE = ("envs/", "simhive/")
OWN = ("assets/", "validation/")
SAMPLES = 4
HINGE_NOISE, SLIDE_NOISE = 0.15, 0.02  # rad, m
LEAST_SHININESS = 1e-6
# The flag of each effect, and whether it is on.
EFFECTS = {"wireframe": ("mjRND_WIREFRAME", 1), "additive": ("mjRND_ADDITIVE", 1), "no_culling": ("mjRND_CULL_FACE", 0)}

ITEM = ["type", "dataid", "objtype", "objid", "category", "matid", "texcoord", "segid", "size", "pos", "mat", "rgba",
        "emission", "specular", "shininess", "reflectance", "modelrbound"]
LIGHT = ["pos", "dir", "type", "directional", "cutoff", "exponent", "attenuation", "ambient", "diffuse", "specular", "headlight",
         "castshadow"]
CAMERA = ["pos", "forward", "up", "frustum_center", "frustum_width", "frustum_bottom", "frustum_top", "frustum_near",
          "frustum_far", "orthographic"]


# Models

def copy_models(models, folder, repaired):
    """A copy whose XML may be edited, `repaired` for 3.12.0; other files are links to the originals."""
    def copy(source, target):
        if source.endswith(".xml"):
            shutil.copy(source, target)
        else:
            os.symlink(os.path.abspath(source), target)

    for part in ["envs", "simhive", "model"]:
        if (models / part).is_dir():
            shutil.copytree(models / part, folder / part, copy_function=copy)
    if repaired:
        from record import repair
        for part in ROBOHIVE:
            repair(folder / part)


def load(scene, folder):
    """The compiled model, and its arrays that were changed after compilation."""
    import mujoco
    import numpy as np
    path = (ROOT if scene["file"].startswith(OWN) else folder) / scene["file"]
    if scene.get("define"):
        text = path.read_text(errors="surrogateescape")
        for word, value in scene["define"].items():
            text = text.replace(word, value)
        path = path.with_name(f"{path.stem}.{scene['name']}.xml")
        path.write_text(text, errors="surrogateescape")
    model = mujoco.MjModel.from_xml_path(str(path))
    model.mat_shininess[:] = np.maximum(model.mat_shininess, LEAST_SHININESS)
    if "terrain" not in scene:
        return model, {}
    geom = model.geom(scene["terrain"]).id
    model.geom_pos[geom] = 0
    model.geom_rgba[geom, 3] = 1
    model.hfield_data[:] = np.random.RandomState(0).uniform(0, 0.3, model.nhfielddata)
    return model, {name: getattr(model, name) for name in ["geom_pos", "geom_rgba", "hfield_data"]}


def pose(model, seed=0):
    """Data at rest in a reproducible pose that is not symmetric."""
    import mujoco
    import numpy as np
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    data.qvel[:] = 0
    noise = {mujoco.mjtJoint.mjJNT_HINGE: HINGE_NOISE, mujoco.mjtJoint.mjJNT_SLIDE: SLIDE_NOISE}
    random = np.random.RandomState(seed)
    for joint in range(model.njnt):
        reach = noise.get(mujoco.mjtJoint(model.jnt_type[joint]))
        if reach is None:
            continue
        place = model.jnt_qposadr[joint]
        data.qpos[place] += random.uniform(-1, 1) * reach
        if model.jnt_limited[joint]:
            data.qpos[place] = np.clip(data.qpos[place], *model.jnt_range[joint])
    mujoco.mj_forward(model, data)
    return data


# Pictures

class Camera:
    """Pictures of one state from one camera, at one size and number of samples, with the effects of a scene."""

    def __init__(self, model, data, scene, side, samples):
        import mujoco
        model.vis.quality.offsamples = samples
        self.renderer = mujoco.Renderer(model, side, side)
        # Infinite planes are centred by the camera of the update before.
        for _ in range(2):
            self.renderer.update_scene(data, scene.get("camera", -1))
        for effect in scene.get("effects", []):
            flag, on = EFFECTS[effect]
            self.renderer.scene.flags[getattr(mujoco.mjtRndFlag, flag)] = on

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.renderer.close()

    def rgb(self, shadows=True):
        import mujoco
        self.renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        return self.renderer.render().copy()

    def depth_and_ids(self):
        self.renderer.enable_depth_rendering()
        depth = self.renderer.render().copy()
        self.renderer.disable_depth_rendering()
        self.renderer.enable_segmentation_rendering()
        ids = self.renderer.render().copy()
        self.renderer.disable_segmentation_rendering()
        return depth, ids


def assembled(scene):
    """The items, lights and cameras of an MjvScene, a row each."""
    import numpy as np
    out = {}
    tables = {"item": (scene.geoms, scene.ngeom, ITEM), "light": (scene.lights, scene.nlight, LIGHT),
              "camera": (scene.camera, 2, CAMERA)}
    for table, (rows, count, fields) in tables.items():
        for field in fields:
            if count == 0 or hasattr(rows[0], field):
                out[f"{table}/{field}"] = np.array([np.array(getattr(rows[k], field)) for k in range(count)])
    return out


def record(scene, sizes, folder):
    """Everything that llvmpipe draws of a scene."""
    model, edits = load(scene, folder)
    data = pose(model)
    out = {name: getattr(data, name) for name in ["qpos", "act", "mocap_pos", "mocap_quat"]}
    out |= {"model/" + name: value for name, value in edits.items()}
    for side in sizes:
        with Camera(model, data, scene, side, SAMPLES) as view:
            out |= assembled(view.renderer.scene)  # Drawing changes it.
            out[f"{side}/rgb"] = view.rgb()
            out[f"{side}/rgb_no_shadow"] = view.rgb(shadows=False)
            out[f"{side}/depth"], out[f"{side}/ids"] = view.depth_and_ids()
        with Camera(model, data, scene, side, 0) as view:
            out[f"{side}/rgb_1"] = view.rgb()
    return out


def record_floor(scene, sizes, folder):
    """What the other rasteriser draws, which has no more than one sample."""
    model, _ = load(scene, folder)
    data = pose(model)
    out = {}
    for side in sizes:
        with Camera(model, data, scene, side, 0) as view:
            out[f"{side}/rgb_1"] = view.rgb()
            out[f"{side}/depth"], out[f"{side}/ids"] = view.depth_and_ids()
    return out


def renderer_name():
    """OpenGL's name for what draws; needs a current context."""
    import mujoco
    from OpenGL import GL
    context = mujoco.GLContext(8, 8)
    context.make_current()
    name = GL.glGetString(GL.GL_RENDERER).decode()
    context.free()
    return name


def draw(rasteriser, listed, args):
    """In a child: records every chosen scene; true if none failed."""
    import mujoco
    import numpy as np
    name = renderer_name()
    if rasteriser not in name:
        sys.exit(f"{rasteriser} is wanted, OpenGL draws with {name}")
    floor = rasteriser == "softpipe"
    out = args.out / "floor" if floor else args.out
    out.mkdir(parents=True, exist_ok=True)
    failures = 0
    for scene in listed["scene"]:
        path = out / (scene["name"] + ".npz")
        if args.only not in scene["name"] or path.exists() and not args.again:
            continue
        if floor and scene["bars"] != "floor" or old(mujoco) and not scene["file"].startswith(ROBOHIVE):
            continue
        if not args.models and not scene["file"].startswith(OWN):
            continue
        try:
            arrays = (record_floor if floor else record)(scene, args.sizes or listed["sizes"], args.copy)
            meta = {"scene": scene, "mujoco": mujoco.__version__, "opengl": name}
            partial = path.with_suffix(".partial.npz")
            np.savez_compressed(partial, meta=np.frombuffer(json.dumps(meta).encode(), np.uint8), **arrays)
            partial.rename(path)
            print("recorded", rasteriser, scene["name"], flush=True)
        except Exception as error:
            failures += 1
            print("FAILED", rasteriser, scene["name"], error, flush=True)
    return failures == 0


def old(mujoco):
    """RoboHive's version is asked for; any third is an error."""
    if mujoco.__version__ not in ("3.12.0", "3.1.3"):
        sys.exit(f"mujoco 3.12.0 or 3.1.3 is needed, this is {mujoco.__version__}")
    return mujoco.__version__ == "3.1.3"


# Measures

def measures(a, b):
    """How far pictures b are from reference a: dictionaries with rgb, depth and ids."""
    import numpy as np
    from skimage.metrics import structural_similarity
    left, right = a["rgb"].astype(float), b["rgb"].astype(float)
    keys = [x["ids"][..., 0].astype(np.int64) * 64 + x["ids"][..., 1] for x in (a, b)]
    background = -1 * 64 - 1
    inside = np.zeros(keys[0].shape, bool)
    near = np.lib.stride_tricks.sliding_window_view(keys[0], (5, 5))
    inside[2:-2, 2:-2] = (near == near[..., 2:3, 2:3]).all((-2, -1))
    same = keys[0] == keys[1]
    solid = same & (keys[0] != background)
    depth = np.abs(a["depth"].astype(float) - b["depth"])[solid] / np.maximum(a["depth"][solid].astype(float), 1e-9)
    shown = [k for k in np.unique(keys[0]) if k != background and (keys[0] == k).sum() >= 50]
    overlap = [((keys[0] == k) & (keys[1] == k)).sum() / ((keys[0] == k) | (keys[1] == k)).sum() for k in shown]

    def psnr(mask):
        error = np.mean((left - right)[mask] ** 2)
        return 10 * np.log10(255 ** 2 / error)

    return {
        "psnr": psnr(np.ones(same.shape, bool)), "psnr_interior": psnr(inside),
        "ssim": structural_similarity(a["rgb"], b["rgb"], channel_axis=-1, data_range=255, gaussian_weights=True,
                                      sigma=1.5, use_sample_covariance=False),
        "ids": same.mean(), "ids_interior": same[inside].mean(), "iou": np.mean(overlap),
        "depth_median": np.median(depth), "depth_p99": np.quantile(depth, 0.99),
    }


def synthetic():
    """Two pictures of overlapping discs on a slope, the second with other noise, moved edges and a hole."""
    import numpy as np
    height, width = 47, 61
    y, x = np.mgrid[:height, :width].astype(float)
    pictures = []
    for seed, shift in ((1, 0.0), (2, 0.7)):
        random = np.random.RandomState(seed)
        depth = 4 + 0.02 * y + 0.01 * x
        ids = np.full((height, width, 2), -1, np.int32)
        colour = np.stack([2 * x, 3 * y, x + y], -1)
        for number, (cx, cy, radius) in enumerate([(20, 20, 13), (34, 26, 12), (50, 36, 8), (8, 40, 3)]):
            disc = np.hypot(x - cx - shift, y - cy) < radius
            depth[disc] = 3 - 0.4 * number + 0.01 * x[disc]
            ids[disc] = number, 5 + number % 2
            colour[disc] = 40 + 50 * number, 200 - 30 * number, 90
        if shift:
            ids[25:27, 33:36] = -1
        depth *= 1 + 1e-5 * random.randn(height, width)
        rgb = np.clip(np.rint(colour + 4 * random.randn(height, width, 3)), 0, 255)
        pictures.append({"rgb": rgb.astype(np.uint8), "depth": depth.astype(np.float32), "ids": ids})
    return pictures


def record_measures(path):
    import numpy as np
    a, b = synthetic()
    arrays = {f"{side}/{name}": value for side, picture in (("a", a), ("b", b)) for name, value in picture.items()}
    np.savez_compressed(path, **arrays, **{"measure/" + k: np.float64(v) for k, v in measures(a, b).items()})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--only", default="", help="scenes whose name contains this")
    parser.add_argument("--sizes", type=lambda text: [int(side) for side in text.split(",")])
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--measures", type=Path, metavar="FILE")
    parser.add_argument("--child", choices=RASTERISERS, help=argparse.SUPPRESS)
    parser.add_argument("--copy", type=Path, help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.measures:
        return record_measures(args.measures)
    if not args.out:
        parser.error("--out is needed")
    if args.child:
        sys.exit(0 if draw(args.child, tomllib.loads(SCENES.read_text()), args) else 1)
    os.environ["MUJOCO_GL"] = "disable"
    import mujoco
    with tempfile.TemporaryDirectory(prefix="models-") as copy:
        if args.models:
            copy_models(args.models, Path(copy), repaired=not old(mujoco))
        failures = 0
        for rasteriser in RASTERISERS:
            environment = os.environ | {"GALLIUM_DRIVER": rasteriser} | RASTERISERS[rasteriser]
            command = [sys.executable, __file__, *sys.argv[1:], "--child", rasteriser, "--copy", copy]
            failures += subprocess.run(command, env=environment).returncode
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
