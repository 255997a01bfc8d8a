"""Draws a recorded rollout of MuJoCo's beside ours: the motion, and how far the two are apart.

    pip install mujoco==3.12.0 matplotlib
    cargo build --release
    python validation/reference/plot.py assets/humanoid/humanoid.xml \
        validation/reference/own/humanoid.npz --out validation/results/rollout.svg

Our rollout comes from `robohive trace` under the recorded controls, MuJoCo's is the one in the archive.
"""

import argparse
import subprocess
import tempfile
from pathlib import Path

import matplotlib
import mujoco
import numpy as np

matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "rollout", "svg.fonttype": "none", "font.size": 9})
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)


def ours(binary, model, ctrl):
    """Positions after every step of `robohive trace`."""
    with tempfile.TemporaryDirectory() as folder:
        inputs, motion = Path(folder, "in.npz"), Path(folder, "out.npz")
        np.savez(inputs, ctrl=ctrl)
        subprocess.run([binary, "trace", model, "--in", inputs, "--out", motion, "--fields", "qpos"], check=True)
        return np.load(motion)["qpos"]


def skeleton(m, d, qpos):
    """Segments from each body to its parent, the world left out, as pairs of points [m]."""
    d.qpos[:] = qpos
    mujoco.mj_kinematics(m, d)
    children = [b for b in range(1, m.nbody) if m.body_parentid[b] != 0]
    return [(d.xpos[m.body_parentid[b]].copy(), d.xpos[b].copy()) for b in children]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model")
    parser.add_argument("reference")
    parser.add_argument("--binary", default="target/release/robohive")
    parser.add_argument("--out", required=True)
    parser.add_argument("--poses", type=int, default=6, help="poses drawn, evenly spaced in time")
    args = parser.parse_args()

    recorded = np.load(args.reference)
    theirs, twin = recorded["rollout.qpos"], recorded["twin.qpos"]
    mine = ours(args.binary, args.model, recorded["rollout.ctrl"])
    m = mujoco.MjModel.from_xml_path(args.model)
    d = mujoco.MjData(m)
    time = m.opt.timestep * (1 + np.arange(len(theirs)))

    figure, (motion, apart) = plt.subplots(1, 2, figsize=(9, 3), width_ratios=[1.7, 1], layout="constrained")
    rows = np.linspace(0, len(theirs) - 1, args.poses).astype(int)
    gap = 1.1
    for k, row in enumerate(rows):
        for start, end in skeleton(m, d, mine[row]):
            motion.plot([k * gap + start[0], k * gap + end[0]], [start[2], end[2]], "-", color="#d95f02", lw=2)
        for _, end in skeleton(m, d, theirs[row]):
            motion.plot(k * gap + end[0], end[2], ".", color="#1b4f9c", ms=4)
        motion.text(k * gap, -0.25, f"{time[row]:.2f} s", ha="center")
    motion.axhline(0, color="0.6", lw=1)
    motion.plot([], [], "-", color="#d95f02", label="robohive")
    motion.plot([], [], ".", color="#1b4f9c", label="MuJoCo 3.12.0")
    motion.legend(loc="upper right", frameon=False)
    motion.set_aspect("equal")
    motion.set_axis_off()

    floor = 1e-18
    for values, label, color in ((twin, "MuJoCo, started 1e-12 away", "#1b4f9c"), (mine, "robohive", "#d95f02")):
        apart.semilogy(time, np.maximum(np.abs(values - theirs).max(axis=1), floor), color=color, label=label, lw=1)
    apart.set_xlabel("time [s]")
    apart.set_ylabel("largest difference of a position")
    apart.legend(frameon=False, fontsize=8)
    apart.spines[["top", "right"]].set_visible(False)
    figure.savefig(args.out, metadata={"Date": None, "Creator": None})


if __name__ == "__main__":
    main()
