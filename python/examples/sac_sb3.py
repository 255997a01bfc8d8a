"""Soft actor-critic of Stable-Baselines3 on an environment of RoboHive.

python examples/sac_sb3.py [--id ID] [--steps N]
"""

import argparse
import time

import gymnasium as gym
import robohive  # noqa: F401
from stable_baselines3 import SAC
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.monitor import Monitor


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--id", default="hive/ElbowPose-v0")
    arguments.add_argument("--steps", type=int, default=20_000)
    chosen = arguments.parse_args()

    env = Monitor(gym.make(chosen.id))
    model = SAC("MlpPolicy", env, seed=0, learning_starts=min(1000, chosen.steps // 2))
    before, _ = evaluate_policy(model, env, n_eval_episodes=3)
    began = time.process_time()
    model.learn(total_timesteps=chosen.steps)
    rate = chosen.steps / (time.process_time() - began)
    after, _ = evaluate_policy(model, env, n_eval_episodes=3)
    print(f"mean return {before:.2f} before, {after:.2f} after {chosen.steps} steps, {rate:.0f} steps/s")
    env.close()


if __name__ == "__main__":
    main()
