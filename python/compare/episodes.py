"""Plays seeded episodes of other people's environments on MuJoCo or on the stand-in, and keeps observations and rewards.

    python episodes.py mujoco out.npz --ids Ant-v5 FetchReach-v4 [--steps 1000] [--nudge 1e-12] [--signs 3]
"""

import argparse
import enum
import sys
import time
import zlib
from typing import Any

import numpy as np

from environment_sets import make


def flat(observation: Any) -> np.ndarray:
    """All numbers of an observation, those of a dictionary in the order of its keys."""
    if isinstance(observation, dict):
        return np.concatenate([flat(observation[key]) for key in sorted(observation)])
    return np.asarray(observation, np.float64).ravel()


def inner_of(env: Any) -> Any:
    """The environment that holds the simulation."""
    inner = env.unwrapped
    while not hasattr(inner, "data"):
        inner = (getattr(inner, "point_env", None) or inner.ant_env).unwrapped
    return inner


def nudge(env: Any, moves: np.ndarray) -> None:
    """Moves the positions of the present state."""
    import mujoco

    inner = inner_of(env)
    inner.data.qpos[:] += moves
    mujoco.mj_forward(inner.model, inner.data)


def play(name: str, steps: int, size: float, signs: int) -> dict[str, np.ndarray]:
    """Observations and rewards of `steps` steps; a new episode begins where one ends."""
    env = make(name)
    draws = np.random.default_rng(zlib.crc32(name.encode()))
    low, high = env.action_space.low, env.action_space.high
    observations, rewards, episodes = [], [], []
    episode, running, seconds = -1, False, 0.0
    # Resets of robots that settle start from there.
    settles = hasattr(inner_of(env), "initial_qpos")
    moves = size * np.random.default_rng(signs).choice([-1.0, 1.0], inner_of(env).model.nq)
    if size and settles:
        inner_of(env).initial_qpos += moves
    for _ in range(steps):
        if not running:
            episode += 1
            observation, _ = env.reset(seed=episode)
            if size and not settles:
                nudge(env, moves)
            running = True
        action = draws.uniform(low, high).astype(env.action_space.dtype)
        start = time.perf_counter()
        observation, reward, terminated, truncated, _ = env.step(action)
        seconds += time.perf_counter() - start
        observations.append(flat(observation))
        rewards.append(float(reward))
        episodes.append(episode)
        running = not (terminated or truncated)
    env.close()
    return {
        "observations": np.array(observations),
        "rewards": np.array(rewards),
        "episodes": np.array(episodes),
        "seconds": np.array(seconds),
    }


def make_comparable() -> None:
    """Replaces MuJoCo's enumerations by integers of the same values.

    Those of MuJoCo 3.12, and the stand-in's, are not equal to numpy's integers, which Gymnasium-Robotics 1.4 compares them with:
    its Fetch and hand environments do not start.
    """
    import mujoco

    for name in dir(mujoco):
        members = getattr(getattr(mujoco, name), "__members__", None)
        if members and name.startswith("mjt"):
            setattr(mujoco, name, enum.IntEnum(name, {key: int(value.value) for key, value in members.items()}))


def main() -> None:
    """Plays what the command line names."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("engine", choices=("mujoco", "standin"))
    parser.add_argument("out")
    parser.add_argument("--ids", nargs="+", required=True)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--nudge", type=float, default=0.0, help="how far positions at the start are moved")
    parser.add_argument("--signs", type=int, default=0, help="seed of the directions of these moves")
    options = parser.parse_args()
    if options.engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
    make_comparable()
    kept = {}
    for name in options.ids:
        try:
            for key, values in play(name, options.steps, options.nudge, options.signs).items():
                kept[f"{name}/{key}"] = values
        except Exception as error:
            kept[f"{name}/error"] = np.array(f"{type(error).__name__}: {error}")
            print(f"{name}: {type(error).__name__}: {error}", file=sys.stderr)
    np.savez(options.out, **kept)


if __name__ == "__main__":
    main()
