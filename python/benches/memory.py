"""Whether environments in Python leak: resident memory over many steps, then over many environments made and closed.

    python python/benches/memory.py [STEPS] [MAKES]

needs the package robohive. Fails where memory grows by more than 5 % after the first tenth, which fills caches.
"""

import gc
import pickle
import sys
from pathlib import Path

import numpy as np
import robohive

ID = "hive/ElbowPose-v0"
GROWTH = 0.05


def resident():
    """Resident memory [MiB]."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 2**20


def steps(count):
    env = robohive.make(ID)
    env.reset(seed=0)
    action = np.zeros(env.action_space.shape, np.float32)
    for _ in range(count):
        if any(env.step(action)[2:4]):
            env.reset()


def makes(count):
    for index in range(count):
        env = robohive.make(ID)
        env.reset(seed=index)
        env.step(np.zeros(env.action_space.shape))
        if index % 10 == 0:
            pickle.loads(pickle.dumps(env)).close()
        env.close()


def grows(name, work, count):
    work(count // 10)
    before = resident()
    work(count - count // 10)
    after = resident()
    print(f"{name:16} {count:9} {before:8.1f} MiB {after:8.1f} MiB {after / before - 1:+7.1%}", flush=True)
    return after > before * (1 + GROWTH)


if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:]]
    step_count, make_count = numbers or (1_000_000, 10_000)
    leaks = [grows("steps", steps, step_count), grows("made and closed", makes, make_count)]
    sys.exit("resident memory grows by more than 5 %" if any(leaks) else 0)
