"""One environment, random actions: what an episode yields.

python examples/random_rollout.py [ID] [--episodes N]
"""

import argparse

import gymnasium as gym
import robohive


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("id", nargs="?", default="hive/FrankaReach-v0", help="as `robohive.ids()` lists them")
    arguments.add_argument("--episodes", type=int, default=3)
    chosen = arguments.parse_args()

    env = gym.make(chosen.id)
    print(f"robohive {robohive.__version__}: {chosen.id}")
    print(f"observation {env.observation_space.shape}, action {env.action_space.shape}")
    env.action_space.seed(0)
    for episode in range(chosen.episodes):
        env.reset(seed=episode)
        total, steps, over = 0.0, 0, False
        while not over:
            _, reward, terminated, truncated, info = env.step(env.action_space.sample())
            total, steps, over = total + float(reward), steps + 1, terminated or truncated
        print(f"episode {episode}: {steps} steps, return {total:.3f}, solved {bool(info['solved'])}")
    env.close()


if __name__ == "__main__":
    main()
