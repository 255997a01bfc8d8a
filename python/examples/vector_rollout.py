"""Many environments stepped together in Rust, without the interpreter's lock.

python examples/vector_rollout.py [ID] [--envs N] [--steps N]
"""

import argparse
import time

import gymnasium as gym
import numpy as np
import robohive  # noqa: F401


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("id", nargs="?", default="hive/FrankaReach-v0")
    arguments.add_argument("--envs", type=int, default=64)
    arguments.add_argument("--steps", type=int, default=200)
    chosen = arguments.parse_args()

    envs = gym.make_vec(chosen.id, num_envs=chosen.envs, vectorization_mode="vector_entry_point")
    envs.action_space.seed(0)
    envs.reset(seed=0)
    rewards = np.zeros(chosen.envs)
    began = time.perf_counter()
    for _ in range(chosen.steps):
        _, reward, _, _, _ = envs.step(envs.action_space.sample())
        rewards += reward
    seconds = time.perf_counter() - began
    steps = chosen.envs * chosen.steps
    print(f"{steps} steps in {seconds:.2f} s: {steps / seconds:.0f} steps/s, mean reward {rewards.mean() / chosen.steps:.3f}")
    envs.close()


if __name__ == "__main__":
    main()
