"""What it costs to step one environment from Python beyond the step in Rust.

    python python/benches/crossing.py [ID…]

needs the package robohive. The cost is the difference between a call from Python and the same steps taken in Rust, which
`_core.Env.repeat` takes without returning in between; rows alternate, and the least of several rounds counts.
"""

import sys
import time

import numpy as np
import robohive

ROUNDS = 400
STEPS = 20


def microseconds(call):
    start = time.perf_counter()
    call()
    return (time.perf_counter() - start) / STEPS * 1e6


def measure(id):
    # One time step of physics a step: a smaller step shows the difference better.
    env = robohive.make(id, max_episode_steps=10**9, frame_skip=1)
    action = np.zeros(env.action_space.shape, np.float32)

    def from_python():
        for _ in range(STEPS):
            env.step(action)

    inside, outside = [], []
    for _ in range(ROUNDS):
        env.reset(seed=0)
        inside.append(microseconds(lambda: env._core.repeat(action, STEPS)))
        env.reset(seed=0)
        outside.append(microseconds(from_python))
    infos = [microseconds(lambda: [env.get_env_infos() for _ in range(STEPS)]) for _ in range(ROUNDS)]
    return min(inside), min(outside), min(infos)


if __name__ == "__main__":
    print(f"{'id':32} {'Rust':>9} {'Python':>9} {'crossing':>9} {'infos':>9}   [us per step]")
    for id in sys.argv[1:] or robohive.ids("hive"):
        inside, outside, infos = measure(id)
        print(f"{id:32} {inside:9.2f} {outside:9.2f} {outside - inside:9.2f} {infos:9.2f}")
