"""Steps per second beside MuJoCo 3.12.0's C `mj_step` on one thread, and where the time goes on both sides.

    python benches/step.py [--corpus FOLDER | --deformables MUJOCO | --tasks MODELS LIST] [--only TEXT] [--stages] [--jitter]
                           [--write FILE]

Both sides run the same trajectory: keyframe 0 or `qpos0`, 500 steps under the smooth seeded controls of
`validation/reference/record.py`, a new row of them every HOLD steps (MuJoCo gets them as `nstep`), then all over
again. They run in turns, several rounds; medians of processor time, so other work on the machine matters little.
Loading is not counted. Stages are wall time, the least of single passes, clocks that both sides read included.
Jitter takes a longer sequence, so that p99.9 leaves out more than the first step and the hardest.
`motion` is the largest difference of `qpos` after one pass: the proof of equal work.

Own models always; RoboHive's with `--corpus`, the folder that holds its `envs` and `simhive` (a copy is made). With
`--deformables` instead the scenes with flexes of a checkout of MuJoCo's repository, with `--tasks` those of our own tasks,
as `validation/reference/task_scenes.py` writes and lists them. Needs `mujoco` and `numpy`, Linux, and the command built with
`cargo build --profile dist`.
"""

import argparse
import ctypes
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import mujoco
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "validation" / "reference"))
import record  # noqa: E402

OWN = ["franka/franka_table", "elbow/elbow", "quadruped/quadruped", "humanoid/humanoid", "pile/pile"]
ROBOHIVE = [
    "envs/arms/franka/assets/franka_reach_v0.xml",
    "envs/multi_task/common/kitchen/franka_kitchen.xml",
    "envs/hands/assets/DAPG_hammer.xml",
    "envs/hands/assets/DAPG_relocate.xml",
    "envs/claws/trifinger/trifinger_reorient.xml",
    "envs/quadrupeds/dkitty/dkitty_walk_v0.xml",
    "envs/myo/assets/elbow/myoelbow_1dof6muscles.xml",
    "simhive/myo_sim/finger/myofinger_v0.xml",
    "envs/myo/assets/hand/myohand_pose.xml",
    "simhive/myo_sim/arm/myoarm.xml",
    "simhive/myo_sim/leg/myolegs.xml",
]
DEFORMABLES = ["trampoline", "flag", "plate", "basket", "floppy", "poncho", "drape", "softbox", "jelly", "pinch"]
PASS, HOLD = 500, 100
ROUNDS = 7
STAGE_ROUNDS = 15
SECONDS = 0.4
JITTER_PASS, JITTER_PASSES = 5000, 4
JITTER_HEADING = " p99.9 / median | of least times | MuJoCo's | contacts: median, p99.9 |"

# MuJoCo's timers use a clock that Python need not enter: a function of C without arguments that returns seconds.
CLOCK = ctypes.CFUNCTYPE(ctypes.c_double)(("omp_get_wtime", ctypes.CDLL("libgomp.so.1")))

# What MuJoCo's timers and our stages have in common; what is left of MuJoCo's step is the last row. Our solvers
# project constraints themselves.
STAGES = {
    "kinematics": ("POS_KINEMATICS", ["kinematics", "tendons", "transmission"]),
    "inertia": ("POS_INERTIA", ["inertia"]),
    "collision": ("POS_COLLISION", ["collision"]),
    "constraint rows": ("POS_MAKE", ["constraint", "islands"]),
    "projection": ("POS_PROJECT", []),
    "velocity": ("VELOCITY", ["velocity"]),
    "actuation": ("ACTUATION", ["actuation"]),
    "solver": ("CONSTRAINT", ["solver"]),
    "integration": ("ADVANCE", ["integration"]),
    "rest": (None, ["checks", "acceleration", "sensors"]),
}


def binary():
    metadata = ["cargo", "metadata", "--no-deps", "--format-version", "1"]
    text = subprocess.run(metadata, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    return pathlib.Path(json.loads(text)["target_directory"]) / "dist" / "robohive"


class RoboHive:
    """`robohive bench --requests`, and the processor time it takes."""

    def __init__(self, path, controls):
        np.savez(controls_file := pathlib.Path(tempfile.mkdtemp()) / "controls.npz", ctrl=controls)
        command = [binary(), "bench", path, "--requests", "--hold", str(HOLD), "--controls", controls_file]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        # The processor clock of another process: clock_getcpuclockid(3), as Linux numbers them.
        self.clock = (~self.process.pid << 3) | 2
        self.answer("rate", 1)
        shutil.rmtree(controls_file.parent)

    def answer(self, measure, steps):
        self.process.stdin.write(f"{measure} {steps}\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def seconds(self, passes):
        began = time.clock_gettime(self.clock)
        self.answer("rate", passes * PASS)
        return time.clock_gettime(self.clock) - began

    def end(self, passes=1):
        return np.array(self.answer("rate", passes * PASS)["qpos"])

    def stages(self):
        found = self.answer("stages", PASS)
        return [sum(found[stage] for stage in ours) for _, ours in STAGES.values()]

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class MuJoCo:
    """`mj_step` of the C library; Python sets controls every HOLD steps and nothing else."""

    def __init__(self, model, controls):
        self.model, self.controls, self.data = model, controls, mujoco.MjData(model)

    def reset(self):
        if self.model.nkey:
            mujoco.mj_resetDataKeyframe(self.model, self.data, 0)
        else:
            mujoco.mj_resetData(self.model, self.data)

    def each_step(self):
        """Seconds and contacts of every step of one pass; a call from Python is in the time."""
        self.reset()
        found = []
        for row in self.controls:
            self.data.ctrl[:] = row
            for _ in range(HOLD):
                began = time.perf_counter()
                mujoco.mj_step(self.model, self.data)
                found.append((time.perf_counter() - began, self.data.ncon))
        return found

    def one_pass(self):
        self.reset()
        for row in self.controls:
            self.data.ctrl[:] = row
            mujoco.mj_step(self.model, self.data, HOLD)

    def seconds(self, passes):
        began = time.process_time()
        for _ in range(passes):
            self.one_pass()
        return time.process_time() - began

    def end(self):
        self.one_pass()
        if any(warning.number for warning in self.data.warning):
            sys.exit(f"{self.model.names[:20]}: MuJoCo warns; such a pass is no measure")
        return self.data.qpos.copy()

    def stages(self):
        """Seconds of a step by MuJoCo's own timers."""
        mujoco.set_mjcb_time(CLOCK)
        self.one_pass()
        mujoco.set_mjcb_time(None)
        of = lambda name: self.data.timer[getattr(mujoco.mjtTimer, "mjTIMER_" + name)].duration / PASS
        rows = [of(timer) for timer, _ in STAGES.values() if timer]
        return rows + [of("STEP") - sum(rows)]


def compare(path, model, args):
    """One row of the table, and the stages of both sides."""
    controls = record.controls(model, PASS, 0)[::HOLD]
    ours, theirs = RoboHive(path, controls), MuJoCo(model, controls)
    motion = np.abs(ours.end() - theirs.end()).max(initial=0.0)
    passes = [max(1, round(SECONDS / side.seconds(1))) for side in (ours, theirs)]
    spent = np.array([[ours.seconds(passes[0]), theirs.seconds(passes[1])] for _ in range(ROUNDS)])
    rates = PASS * np.array(passes) / np.median(spent, axis=0)
    row = {"ours": rates[0], "theirs": rates[1], "ratio": rates[0] / rates[1], "motion": motion,
           "muscles": bool((model.actuator_gaintype == mujoco.mjtGain.mjGAIN_MUSCLE).any())}
    if args.stages:
        rounds = [[ours.stages(), theirs.stages()] for _ in range(STAGE_ROUNDS)]
        row["stages"] = np.min(rounds, axis=0) * 1e6
    ours.close()
    if args.jitter:
        row["jitter"] = jitter(path, model)
    return row


def jitter(path, model):
    """p99.9 of the time of a step over its median: of all our steps, then of the least time that each step took in the
    passes, ours and MuJoCo's; and the contacts of a median step and of p99.9."""
    controls = record.controls(model, JITTER_PASS, 0)[::HOLD]
    side = RoboHive(path, controls)
    found = side.answer("jitter", JITTER_PASSES * JITTER_PASS)
    side.close()
    theirs = MuJoCo(model, controls)
    passes = np.array([theirs.each_step() for _ in range(JITTER_PASSES)])
    least, contacts = passes[:, :, 0].min(axis=0), passes[0, :, 1]
    ratios = [found[kind + "p99.9"] / found[kind + "median"] for kind in ("", "least ")]
    return ratios + [np.quantile(least, 0.999) / np.median(least), np.median(contacts), np.quantile(contacts, 0.999)]


def geometric_mean(ratios):
    return np.exp(np.mean(np.log(ratios))) if ratios else np.nan


def report(rows, args):
    """The measured table, Markdown."""
    lines = ["| model | robohive steps/s | MuJoCo steps/s | ratio | motion |" + (JITTER_HEADING if args.jitter else ""),
             "|---|---|---|---|---|" + ("---|" * 4 if args.jitter else "")]
    for name, r in rows.items():
        jitter = " {:.2f} | {:.2f} | {:.2f} | {:.0f}, {:.0f} |".format(*r["jitter"]) if args.jitter else ""
        lines.append(f"| {name} | {r['ours']:.0f} | {r['theirs']:.0f} | {r['ratio']:.2f} | {r['motion']:.0e} |{jitter}")
    ratios = [r["ratio"] for r in rows.values()]
    muscles = [r["ratio"] for r in rows.values() if r["muscles"]]
    strong = f"of the {len(muscles)} models with muscles {geometric_mean(muscles):.2f}; " if muscles else ""
    lines += ["", f"Geometric mean {geometric_mean(ratios):.2f}; {strong}"
              f"least {min(ratios):.2f}; {sum(r < 1 for r in ratios)} of {len(ratios)} lost."]
    if args.stages:
        lines += ["", "Microseconds of a step, robohive / MuJoCo:", "", "| model | " + " | ".join(STAGES) + " |",
                  "|---" * (len(STAGES) + 1) + "|"]
        for name, r in rows.items():
            cells = (f"{a:.1f} / {b:.1f}" for a, b in r["stages"].T)
            lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def write(path, table):
    """Puts the table between the marks of a file."""
    before, rest = path.read_text().split("<!-- steps begin -->")
    after = rest.split("<!-- steps end -->")[1]
    path.write_text(f"{before}<!-- steps begin -->\n{table}\n<!-- steps end -->{after}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    models = parser.add_mutually_exclusive_group()
    models.add_argument("--corpus", type=pathlib.Path, help="folder with RoboHive's envs and simhive")
    models.add_argument("--deformables", metavar="MUJOCO", type=pathlib.Path,
                        help="checkout of MuJoCo's repository, whose scenes with flexes are measured instead")
    models.add_argument("--tasks", nargs=2, metavar=("MODELS", "LIST"), type=pathlib.Path,
                        help="scenes of our own tasks: their folder, and the list of their paths in it")
    parser.add_argument("--only", default="", help="models whose path contains this")
    parser.add_argument("--stages", action="store_true", help="time of each stage on both sides")
    parser.add_argument("--jitter", action="store_true", help="p99.9 of step time over the median on both sides; wants an idle core")
    parser.add_argument("--write", type=pathlib.Path, help="file with the marks 'steps begin' and 'steps end'")
    args = parser.parse_args()
    if mujoco.__version__ != "3.12.0":
        sys.exit(f"mujoco 3.12.0 is needed, this is {mujoco.__version__}")
    paths = [ROOT / "assets" / f"{name}.xml" for name in OWN]
    with tempfile.TemporaryDirectory(prefix="corpus-") as copy:
        if args.corpus:
            for folder in ["envs", "simhive"]:
                shutil.copytree(args.corpus / folder, pathlib.Path(copy) / folder)
            record.repair(copy)
            paths += [pathlib.Path(copy) / name for name in ROBOHIVE]
        if args.deformables:
            paths = [args.deformables / "model" / "flex" / f"{name}.xml" for name in DEFORMABLES]
        if args.tasks:
            paths = [args.tasks[0] / line for line in args.tasks[1].read_text().split()]
        rows = {}
        for path in (path for path in paths if args.only in str(path)):
            row = rows[path.stem] = compare(path, record.load(path), args)
            print(f"{path.stem:32} {row['ours']:10.0f} {row['theirs']:10.0f} {row['ratio']:6.2f} {row['motion']:8.0e}",
                  file=sys.stderr, flush=True)
    table = report(rows, args)
    print(table)
    if args.write:
        write(args.write, table)


if __name__ == "__main__":
    main()
