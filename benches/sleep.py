"""Sleeping beside MuJoCo 3.12.0: whether the same trees sleep at every step, and what a step costs while they do.

    python benches/sleep.py --models MUJOCO [--only TEXT] [--steps N] [--binary ROBOHIVE]

MUJOCO is a checkout of MuJoCo's repository. Its scenes with sleep in them run for N steps without controls on both sides
(`robohive trace` records ours); printed is in how many the set of sleeping trees is the same after every step. Then 200
boxes in fifty stacks come to rest, once with sleep enabled and once without: the time of a step in which all sleep beside
one in which none does, medians of wall time on one thread, both sides in one run, so the ratios matter and not the times.

Scenes whose initial state MuJoCo refuses are left out, and models of more than LARGEST degrees of freedom. Needs `mujoco`
and `numpy`, and the command built with `cargo build --profile dist`.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import mujoco
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ["test/engine/testdata/sleep", "model/sleep"]
LARGEST = 700
BOXES_PER_STACK, STACKS_ALONG_SIDE = 4, (10, 5)
# Steps until the boxes sleep, and those of which the times are kept.
SETTLING, TIMED = 1000, 1500


def release_binary():
    metadata = ["cargo", "metadata", "--no-deps", "--format-version", "1"]
    text = subprocess.run(metadata, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    return pathlib.Path(json.loads(text)["target_directory"]) / "dist" / "robohive"


def scenes(models, only):
    """Scenes that can sleep, that MuJoCo loads, and that are not too large."""
    for path in sorted(p for folder in FOLDERS for p in (models / folder).rglob("*.xml")):
        if only not in str(path):
            continue
        try:
            model = mujoco.MjModel.from_xml_path(str(path))
            mujoco.MjData(model)
        except (ValueError, mujoco.FatalError):
            continue
        if model.opt.enableflags & mujoco.mjtEnableBit.mjENBL_SLEEP and 0 < model.nv <= LARGEST:
            yield path, model


def asleep_in_mujoco(model, steps):
    """One row a step: which trees sleep."""
    data = mujoco.MjData(model)
    rows = np.empty((steps, model.ntree), dtype=bool)
    for row in rows:
        mujoco.mj_step(model, data)
        row[:] = data.tree_asleep >= 0
    return rows


def asleep_in_ours(binary, path, model, steps):
    """The same from `robohive trace`."""
    with tempfile.TemporaryDirectory() as folder:
        inputs, outputs = (pathlib.Path(folder) / name for name in ["in.npz", "out.npz"])
        np.savez(inputs, ctrl=np.zeros((steps, model.nu)))
        command = [binary, "trace", path, "--in", inputs, "--out", outputs, "--fields", "tree_asleep"]
        subprocess.run(command, check=True, capture_output=True, text=True)
        return np.load(outputs)["tree_asleep"].reshape(steps, model.ntree) >= 0


def compare(binary, path, model, steps):
    """Whether all rows are the same, and a line about them."""
    theirs = asleep_in_mujoco(model, steps)
    try:
        ours = asleep_in_ours(binary, path, model, steps)
    except subprocess.CalledProcessError as error:
        return False, error.stderr.strip()
    differing = np.flatnonzero((ours != theirs).any(axis=1))
    changes = int((theirs[1:] != theirs[:-1]).sum())
    if len(differing):
        return False, f"other trees sleep in {len(differing)} of {steps} steps, first in {differing[0]}"
    return True, f"{theirs[-1].sum()} of {model.ntree} trees sleep in the end, {changes} changes"


def stacks(sleep):
    """Boxes in stacks of their own, as MJCF; `sleep` is enable or disable."""
    along, across = STACKS_ALONG_SIDE
    bodies = "".join(
        f'<body pos="{0.3 * (k % along):g} {0.3 * (k // along):g} {0.1 + 0.2 * layer:g}"><freejoint/>'
        f'<geom type="box" size=".1 .1 .1" density="300"/></body>'
        for k in range(along * across) for layer in range(BOXES_PER_STACK))
    return (f'<mujoco><option timestep="0.004"><flag sleep="{sleep}"/></option><worldbody>'
            f'<geom type="plane" size="0 0 1"/>{bodies}</worldbody></mujoco>')


def step_of_mujoco(text):
    """Median seconds of a step at rest, and how many trees sleep then."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, SETTLING)
    times = np.empty(TIMED // 10)
    for k in range(len(times)):
        began = time.perf_counter()
        mujoco.mj_step(model, data, 10)
        times[k] = (time.perf_counter() - began) / 10
    return np.median(times), int((data.tree_asleep >= 0).sum())


def step_of_ours(binary, text):
    """Median seconds of a step: of more than twice those until the boxes rest, so that of a step at rest."""
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(text)
        file.flush()
        command = [binary, "bench", file.name, "--jitter", "--json", "--steps", str(2 * SETTLING + TIMED)]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["median"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", required=True, type=pathlib.Path, help="checkout of MuJoCo's repository")
    parser.add_argument("--only", default="", help="scenes whose path contains this")
    parser.add_argument("--steps", default=2000, type=int, help="steps of every scene")
    parser.add_argument("--binary", type=pathlib.Path, help="the robohive command, if not the one built with the profile `dist`")
    args = parser.parse_args()
    if mujoco.__version__ != "3.12.0":
        sys.exit(f"mujoco 3.12.0 is needed, this is {mujoco.__version__}")
    binary = args.binary or release_binary()
    equal = []
    for path, model in scenes(args.models, args.only):
        same, line = compare(binary, path, model, args.steps)
        equal.append(same)
        print(f"{'same' if same else 'DIFFERENT':10}{path.relative_to(args.models)}: {line}", flush=True)
    print(f"{sum(equal)} of {len(equal)} scenes have the same sleeping trees at each of {args.steps} steps\n")
    texts = {name: stacks(sleep) for name, sleep in [("asleep", "enable"), ("awake", "disable")]}
    theirs = {name: step_of_mujoco(text) for name, text in texts.items()}
    ours = {name: step_of_ours(binary, text) for name, text in texts.items()}
    boxes = BOXES_PER_STACK * np.prod(STACKS_ALONG_SIDE)
    if theirs["asleep"][1] != boxes or theirs["awake"][1] != 0:
        sys.exit(f"of {boxes} boxes {theirs['asleep'][1]} sleep, and {theirs['awake'][1]} with sleep disabled: no measure")
    print(f"| {boxes} boxes at rest | awake [us/step] | asleep [us/step] | awake / asleep |\n|---|---|---|---|")
    for side, awake, asleep in [("robohive", ours["awake"], ours["asleep"]),
                                ("MuJoCo's C", theirs["awake"][0], theirs["asleep"][0])]:
        print(f"| {side} | {awake * 1e6:.0f} | {asleep * 1e6:.1f} | {awake / asleep:.0f} |")
    if not all(equal):
        sys.exit(1)


if __name__ == "__main__":
    main()
