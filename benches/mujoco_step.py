"""Steps per second of `robohive bench` beside MuJoCo's C `mj_step` on one thread, and their geometric mean.

    python benches/mujoco_step.py [MODEL...]

Both sides are charged processor time, not wall time, so other work on the machine matters little; loading a model
is not counted. Both start from keyframe 0, or `qpos0` without one, with zero controls. Needs `mujoco` and `numpy`,
and a release build of this repository.
"""

import json
import pathlib
import resource
import subprocess
import sys
import time

import mujoco
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
OWN = ["franka/franka_table", "elbow/elbow", "quadruped/quadruped", "pile/pile"]
SECONDS = 0.3
REPEATS = 3


def binary():
    metadata = ["cargo", "metadata", "--no-deps", "--format-version", "1"]
    text = subprocess.run(metadata, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    return pathlib.Path(json.loads(text)["target_directory"]) / "release" / "robohive"


def mujoco_time(model, steps):
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    data.ctrl[:] = 0
    began = time.process_time()
    mujoco.mj_step(model, data, steps)
    return time.process_time() - began


def child_time(program, path, steps):
    def spent():
        usage = resource.getrusage(resource.RUSAGE_CHILDREN)
        return usage.ru_utime + usage.ru_stime

    began = spent()
    subprocess.run([program, "bench", path, "--steps", str(steps)], check=True, capture_output=True)
    return spent() - began


def compare(program, path):
    """Steps per second of RoboHive and of MuJoCo: medians."""
    model = mujoco.MjModel.from_xml_path(path)
    steps = int(np.clip(SECONDS * 100 / mujoco_time(model, 100), 500, 50000))
    ours = [child_time(program, path, steps + 1) - child_time(program, path, 1) for _ in range(REPEATS)]
    theirs = [mujoco_time(model, steps) for _ in range(REPEATS)]
    return steps / np.median(ours), steps / np.median(theirs)


def main(paths):
    program, ratios = binary(), []
    print(f"{'model':32} {'robohive/s':>12} {'mujoco/s':>12} {'ratio':>6}")
    for path in paths or [str(ROOT / "assets" / f"{name}.xml") for name in OWN]:
        ours, theirs = compare(program, path)
        ratios.append(ours / theirs)
        print(f"{pathlib.Path(path).stem:32} {ours:12.0f} {theirs:12.0f} {ratios[-1]:6.2f}", flush=True)
    print(f"geometric mean of ratios {np.exp(np.mean(np.log(ratios))):.2f}")


if __name__ == "__main__":
    main(sys.argv[1:])
