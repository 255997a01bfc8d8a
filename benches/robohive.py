#!/usr/bin/env python3
"""Environment steps per second beside RoboHive's own Python and beside the bare physics of MuJoCo's C, on one thread.

    python benches/robohive.py --robohive PYTHON [--only TEXT] [--rounds N] [--batches] [--write FILE]

PYTHON is an interpreter that has robohive 0.7.0 and mujoco 3.1.3; ours is the command built with the profile `dist`, which
finds the same models by ROBOHIVE_STORE or ROBOHIVE_ASSETS. One id of each family of environments, but for
rpFrankaRobotiqData, which RoboHive makes with PyTorch alone.
All sides take STEPS steps under random actions, episodes reset as they end; the same actions are then repeated from the
states after those resets, and only these repetitions are timed, so resets are not in the rates. The sides take turns;
each has the least processor time of its rounds, since other work on the machine only adds.

RoboHive  `env.step` of RoboHive's Python.
C         the controls that RoboHive sent in these steps, from the same states and with the same model, `mj_step` with
          `nstep` of the frame skip: no environment around it, no observation, no forward pass for it.
ours      `env.step` of this repository, observation and reward included.
layer     the share of our step that is not physics: the same controls are sent through our physics again.
reset, make  milliseconds of a reset and of making the environment; ours from the cache of compiled
          models, all threads; RoboHive's the second time in a process, its modules and meshes then at hand.
two       a batch of 8 environments, two threads over one, wall time: wants two idle cores (`--batches`).

The bars: 2 times RoboHive (where C does not reach that, 1.2 times C), 3 times in the geometric mean, a layer of at most
10 % of its physics, 1.8 for two threads, 100 ms to make an environment, 50 ms for `list` and `info`.
"""

import argparse
import copy
import json
import pathlib
import resource
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

FAMILIES = [
    "FrankaReachRandom-v0", "FrankaPushRandom-v0", "FrankaPickPlaceRandom-v0", "FetchReachRandom-v0",
    "TrifingerReachRandom-v0", "rpFrankaDmanusPoseRandom-v0", "rpFrankaRobotiqPoseRandom-v0",
    "door-v1", "hammer-v1", "pen-v1", "relocate-v1", "baoding-v1",
    "FK1_LightOnRandom-v4", "franka_micro_random-v3", "franka_slide_random-v3",
    "DKittyWalkRandom-v0", "DKittyOrientRandom-v0", "DKittyStandRandom-v0",
    "motorFingerReachRandom-v0", "myoFingerPoseRandom-v0", "myoElbowPose1D6MRandom-v0", "myoElbowPose1D6MExoRandom-v0",
    "myoHandPoseRandom-v0", "myoHandReachRandom-v0", "myoHandKeyTurnRandom-v0", "myoHandObjHoldRandom-v0",
    "myoHandPenTwirlRandom-v0", "myoHandReorient100-v0", "myoHandBaodingRandom-v1",
    "myoLegStandRandom-v0", "myoLegWalk-v0", "myoLegRoughTerrainWalk-v0",
    "myoChallengeBaodingP2-v1", "myoChallengeDieReorientP2-v0", "myoChallengeRelocateP2-v0",
    "myoChallengeChaseTagP2-v0", "MyoHandAirplaneRandom-v0", "MyoHandAirplaneFly-v0",
]
# Samples/s of a process in the paper's table: a suite's total over its 32 processes; and which families it measured.
PAPER = {"arm": (234, ("Franka", "Fetch")), "hand": (275, ("door", "hammer", "pen", "relocate")),
         "kitchen": (138, ("FK1",)), "myo": (230, ("myo", "Myo", "motor"))}
STEPS = 200
RESETS = 5
THREADS = 2


# The peer: this file under the interpreter that has RoboHive.

class Peer:
    """RoboHive's environment, and the physics under it."""

    def __init__(self):
        import gymnasium
        import mujoco
        import numpy
        import robohive  # noqa: F401, registers the ids
        self.gymnasium, self.mujoco, self.numpy = gymnasium, mujoco, numpy

    def make(self, name):
        """Processor seconds of making it the second time: the first imports modules."""
        self.gymnasium.make(name)
        began = time.process_time()
        env = self.gymnasium.make(name)
        spent = time.process_time() - began
        self.env, self.horizon, self.episodes = env.unwrapped, env.spec.max_episode_steps, []
        self.random = self.numpy.random.default_rng(0)
        return spent

    def record(self, steps):
        """Episodes of random actions: the states after resets, models as resets left them, actions, controls."""
        env, sim = self.env, self.env.sim
        self.episodes, left = [], int(steps)
        while left:
            env.reset()
            start = copy.deepcopy(env.get_env_state())
            physics = copy.copy(sim.model.ptr), copy.copy(sim.data.ptr)
            actions, controls = [], []
            for _ in range(min(left, self.horizon)):
                actions.append(self.random.uniform(-1, 1, env.action_space.shape))
                *_, done, _, _ = env.step(actions[-1])
                controls.append(sim.data.ctrl.copy())
                if done:
                    break
            left -= len(actions)
            self.episodes.append((start, physics, actions, controls))

    def steps(self):
        """Processor seconds of the recorded steps, between resets to their first states."""
        spent = 0.0
        for start, _, actions, _ in self.episodes:
            self.env.reset()
            self.env.set_env_state(start)
            began = time.process_time()
            for action in actions:
                self.env.step(action)
            spent += time.process_time() - began
        return spent

    def physics(self):
        """Processor seconds of the same controls without an environment."""
        spent = 0.0
        for _, (model, start), _, controls in self.episodes:
            data = copy.copy(start)
            began = time.process_time()
            for control in controls:
                data.ctrl[:] = control
                self.mujoco.mj_step(model, data, self.env.frame_skip)
            spent += time.process_time() - began
        return spent

    def resets(self, count):
        began = time.process_time()
        for _ in range(int(count)):
            self.env.reset()
        return (time.process_time() - began) / int(count)


def serve():
    """Answers requests of standard input; what RoboHive prints goes elsewhere."""
    sys.path.remove(str(pathlib.Path(__file__).resolve().parent))  # `robohive` is the package, not this file.
    answers, sys.stdout = sys.stdout, sys.stderr
    peer = Peer()
    for line in sys.stdin:
        request, *words = line.split()
        found = getattr(peer, request)(*words)
        print(json.dumps(found), file=answers, flush=True)


# The measuring side.

class Process:
    """A process that answers lines, and the processor time that an answer takes."""

    def __init__(self, command, quiet=False):
        pipe = subprocess.PIPE
        silence = subprocess.DEVNULL if quiet else None
        self.process = subprocess.Popen(list(map(str, command)), stdin=pipe, stdout=pipe, stderr=silence, text=True, cwd="/tmp")
        # The processor clock of another process: clock_getcpuclockid(3), as Linux numbers them.
        self.clock = (~self.process.pid << 3) | 2

    def read(self):
        line = self.process.stdout.readline()
        if not line:
            sys.exit(f"{self.process.args}: ended")
        return json.loads(line)

    def ask(self, *request):
        self.process.stdin.write(" ".join(map(str, request)) + "\n")
        self.process.stdin.flush()
        return self.read()

    def seconds(self, *request):
        began = time.clock_gettime(self.clock)
        self.ask(*request)
        return time.clock_gettime(self.clock) - began

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def binary():
    metadata = ["cargo", "metadata", "--no-deps", "--format-version", "1"]
    text = subprocess.run(metadata, cwd=ROOT, capture_output=True, check=True, text=True).stdout
    return pathlib.Path(json.loads(text)["target_directory"]) / "dist" / "robohive"


def measure(name, peer, args):
    """One row: seconds of a step on every side, of a reset, of making it."""
    ours = Process([args.binary, "bench-env", name, "--requests", "--threads", THREADS, "--seconds", 1])
    peer_make = peer.ask("make", name)
    peer.ask("record", STEPS)
    steps = ours.ask("record", STEPS)["steps"]
    least = {}
    for _ in range(args.rounds):
        found = {
            "robohive": peer.ask("steps") / STEPS, "c": peer.ask("physics") / STEPS,
            "ours": ours.seconds("env") / steps, "physics": ours.seconds("physics") / steps,
            "peer_reset": peer.ask("resets", RESETS), "reset": ours.seconds("resets", RESETS) / RESETS,
            "make": ours.seconds("makes", 1),
        }
        least = {key: min(value, least.get(key, value)) for key, value in found.items()}
    least["peer_make"] = peer_make
    least["two"] = batches(ours, args.rounds) if args.batches else None
    ours.close()
    return least


def batches(ours, rounds):
    """Two threads over one, of the best rounds."""
    best = [max(ours.ask("batch", threads)["steps_per_second"] for _ in range(rounds)) for threads in (THREADS, 1)]
    return best[0] / best[1]


def answer_times(command, words):
    """Milliseconds of a command: processor time of all its threads, and wall time; the least of several."""
    times = []
    for _ in range(20):
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run([command, *words], stdout=subprocess.DEVNULL, check=True)
        wall, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append((after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall))
    return [1e3 * min(column) for column in zip(*times)]


def geometric_mean(values):
    product = 1.0
    for value in values:
        product *= value ** (1 / len(values))
    return product


HEADER = """| id | RoboHive steps/s | C steps/s | ours | / RoboHive | / C | C / RoboHive | layer % | reset ms, RoboHive's | make ms, RoboHive's | two threads |
|---|---|---|---|---|---|---|---|---|---|---|"""


def line(name, row):
    layer = 100 * (row["ours"] / row["physics"] - 1)
    two = f"{row['two']:.2f}" if row["two"] else ""
    return (f"| {name} | {1 / row['robohive']:.0f} | {1 / row['c']:.0f} | {1 / row['ours']:.0f} | "
            f"{row['robohive'] / row['ours']:.2f} | {row['c'] / row['ours']:.2f} | {row['robohive'] / row['c']:.2f} | "
            f"{layer:.1f} | {1e3 * row['reset']:.2f}, {1e3 * row['peer_reset']:.1f} | "
            f"{1e3 * row['make']:.0f}, {1e3 * row['peer_make']:.0f} | {two} |")


def misses(rows):
    """Every bar that a family does not reach."""
    for name, row in rows.items():
        robohive, c = row["robohive"] / row["ours"], row["c"] / row["ours"]
        reachable = row["robohive"] / row["c"] >= 2
        if robohive < 2 and (reachable or c < 1.2):
            yield f"{name}: {robohive:.2f} x RoboHive, {c:.2f} x C"
        if row["ours"] > 1.1 * row["physics"]:
            yield f"{name}: layer {100 * (row['ours'] / row['physics'] - 1):.1f} %"
        if row["make"] > 0.1:
            yield f"{name}: made in {1e3 * row['make']:.0f} ms"
        if row["two"] and row["two"] < 1.8:
            yield f"{name}: two threads {row['two']:.2f}"
    mean = geometric_mean([row["robohive"] / row["ours"] for row in rows.values()])
    if mean < 3:
        yield f"geometric mean {mean:.2f} x RoboHive"
    for suite, (rate, beginnings) in PAPER.items():
        for name, row in rows.items():
            if name.startswith(beginnings) and 1 / row["ours"] < 5 * rate:
                yield f"{name}: {1 / row['ours'] / rate:.1f} x the paper's {suite}"


def report(rows, command):
    lines = [HEADER, *(line(name, row) for name, row in rows.items()), ""]
    ratios = [row["robohive"] / row["ours"] for row in rows.values()]
    over_c = [row["c"] / row["ours"] for row in rows.values()]
    bare = [row["robohive"] / row["c"] for row in rows.values()]
    lines.append(f"Geometric means: {geometric_mean(ratios):.2f} x RoboHive, {geometric_mean(over_c):.2f} x C, and C "
                 f"{geometric_mean(bare):.2f} x RoboHive; least {min(ratios):.2f}, {min(over_c):.2f} and {min(bare):.2f}.")
    for suite, (rate, beginnings) in PAPER.items():
        own = {name: 1 / row["ours"] for name, row in rows.items() if name.startswith(beginnings)}
        if own:
            least = min(own, key=own.get)
            lines.append(f"Over the paper's {rate} samples/s of a process ({suite}): least {own[least] / rate:.1f} ({least}).")
    for words in (["list"], ["info", "hive/FrankaReach-v0"], ["info", "myoLegWalk-v0"], ["info", "FK1_LightOnRandom-v4"]):
        processor, wall = answer_times(command, words)
        lines.append(f"`robohive {' '.join(words)}`: {processor:.1f} ms of processor time, {wall:.0f} ms wall.")
    lines += ["", "Bars missed: " + ("; ".join(misses(rows)) or "none") + "."]
    return "\n".join(lines)


def write(path, table):
    """Puts the table between the marks of a file."""
    before, rest = path.read_text().split("<!-- speed begin -->")
    after = rest.split("<!-- speed end -->")[1]
    path.write_text(f"{before}<!-- speed begin -->\n{table}\n<!-- speed end -->{after}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robohive", help="interpreter that has robohive and mujoco 3.1.3")
    parser.add_argument("--binary", type=pathlib.Path, help="our command, if not the one built with the profile `dist`")
    parser.add_argument("--only", default="", help="ids that contain this")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--batches", action="store_true", help="two threads over one as well")
    parser.add_argument("--write", type=pathlib.Path, help="file with the marks 'speed begin' and 'speed end'")
    parser.add_argument("--serve", action="store_true", help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.serve:
        return serve()
    args.binary = (args.binary or binary()).resolve()
    peer, rows = Process([args.robohive, pathlib.Path(__file__).resolve(), "--serve"], quiet=True), {}
    for name in (name for name in FAMILIES if args.only in name):
        rows[name] = measure(name, peer, args)
        print(line(name, rows[name]), file=sys.stderr, flush=True)
    peer.close()
    table = report(rows, args.binary)
    print(table)
    if args.write:
        write(args.write, table)


if __name__ == "__main__":
    main()
