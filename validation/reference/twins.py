#!/usr/bin/env python3
"""How far MuJoCo 3.12.0 takes our scenes and those of RoboHive that they stand in for apart, under the same random commands.

    pip install mujoco==3.12.0
    robohive assets own MODELS
    python twins.py MODELS CORPUS [--only hands]

MODELS is where our models were written, CORPUS holds RoboHive's `envs` and `simhive`. A row a pair of `src/env/registry/twins.toml`: the
largest difference of a position (`qpos`) after 200 and 500 steps, and that of RoboHive's scene from a twin of its own that starts
1e-12 away. Pairs whose joints have other zeros or ranges are named instead.
"""

import argparse
import re
import shutil
import tempfile
from pathlib import Path

import numpy as np
from record import TWIN_OFFSET, controls, load, repair, rollout

TABLE = Path(__file__).parents[2] / "src/env/registry/twins.toml"
STEPS = (200, 500)


def pairs(only):
    rows = re.findall(r'^"(.+\.xml)" = "hive/(.+\.xml)"', TABLE.read_text(), re.MULTILINE)
    return [(theirs, ours) for theirs, ours in rows if only in theirs]


def apart(ours, theirs):
    """Differences at each of STEPS, and of a twin of theirs at the last."""
    commands = controls(theirs, STEPS[-1], 0)
    positions, twin = rollout(theirs, commands)[0], rollout(theirs, commands, TWIN_OFFSET)[0]
    difference = np.abs(rollout(ours, commands)[0] - positions).max(axis=1)
    return [difference[step - 1] for step in STEPS] + [np.abs(twin - positions).max(axis=1)[-1]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--only", default="", help="pairs whose path in RoboHive contains this")
    args = parser.parse_args()
    print("| scene | step 200 | step 500 | twin, step 500 |\n|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="corpus-") as copy:
        shutil.copytree(args.corpus, copy, dirs_exist_ok=True)
        repair(copy)
        for path, own in pairs(args.only):
            ours, theirs = load(args.models / own), load(Path(copy) / path)
            if ours.nq != theirs.nq or not np.allclose(ours.jnt_range, theirs.jnt_range, atol=0.01):
                print(f"| {own} | other zeros or ranges of joints | | |")
                continue
            print(f"| {own} | {' | '.join(f'{x:.0e}' for x in apart(ours, theirs))} |", flush=True)


if __name__ == "__main__":
    main()
