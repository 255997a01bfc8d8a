"""Records what RoboHive's environments return in Python, for python/tests/test_env_original.py.

    PYTHON_OF_ROBOHIVE -P validation/reference/python_infos.py python/tests/recorded

needs RoboHive 0.7.0 (-P: the folder of this script has modules of its name) under MuJoCo 3.1.3 and gymnasium 0.29.1. Writes ID.npz for each id: the first observation, and of every
fifth of 100 steps the observation, the reward and all infos, flattened to `obs_dict/time` and so on, with types as text, and the
whole state (`world/qpos`), to which the state in the infos of some tasks does not suffice.
"""

import sys
from pathlib import Path

import gymnasium
import numpy as np
import robohive  # noqa: F401
from robohive.envs.env_base import MujocoEnv

IDS = ["door-v1", "FrankaReachRandom-v0"]
SEED = 7
STEPS = 100
EVERY = 5


def flat(infos, above=""):
    """Every value by its path."""
    for key, value in infos.items():
        if isinstance(value, dict):
            yield from flat(value, f"{above}{key}/")
        elif value is not None:
            yield above + key, value


def record(id):
    env = gymnasium.make(id).unwrapped
    env.seed(SEED)
    first = env.reset()
    # Some of RoboHive's tasks return the observation alone.
    first = first[0] if isinstance(first, tuple) else first
    rng = np.random.default_rng(SEED)
    columns = {"reset": [first]}
    kinds = {}
    for step in range(STEPS):
        action = rng.uniform(-1, 1, env.action_space.shape)
        observation, reward, terminated, _, infos = env.step(action)
        if step % EVERY != EVERY - 1:
            continue
        columns.setdefault("observation", []).append(observation)
        columns.setdefault("reward", []).append(reward)
        columns.setdefault("terminated", []).append(terminated)
        for path, value in flat(infos):
            columns.setdefault(path, []).append(np.copy(value))
            kinds[path] = f"{np.asarray(value).dtype} {np.asarray(value).shape}"
        world = {**MujocoEnv.get_env_state(env), "ctrl": env.sim.data.ctrl}
        for path, value in flat(world, "world/"):
            columns.setdefault(path, []).append(np.copy(value))
    text = "\n".join(f"{path}: {kind}" for path, kind in sorted(kinds.items()))
    arrays = {key: np.array(rows) for key, rows in columns.items()}
    return {"kinds": np.frombuffer(text.encode(), np.uint8), **arrays}


if __name__ == "__main__":
    for id in IDS:
        np.savez_compressed(Path(sys.argv[1]) / f"{id}.npz", **record(id))
