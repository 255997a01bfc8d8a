"""Records episodes, and makes datasets of Minari and LeRobot of them.

    python write_datasets.py FOLDER

Needs numpy alone; what reads the datasets is named at the end.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from robohive import data

STEPS = 50
RATE = 25.0


def episode(rng: np.random.Generator) -> data.Episode:
    """A point that is pushed towards the origin: its place and velocity are observed."""
    state = np.concatenate([rng.uniform(-1, 1, 2), np.zeros(2)])
    states, actions = [state], []
    for _ in range(STEPS):
        action = np.clip(-2.0 * state[:2] - state[2:] + 0.1 * rng.standard_normal(2), -1, 1)
        velocity = state[2:] + action / RATE
        state = np.concatenate([state[:2] + velocity / RATE, velocity])
        states.append(state)
        actions.append(action)
    observations = np.stack(states)
    distances = np.linalg.norm(observations[:, :2], axis=1)
    truncations = np.arange(STEPS) == STEPS - 1
    return data.Episode(
        observations=observations,
        actions=np.stack(actions),
        rewards=-distances[1:],
        terminations=np.zeros(STEPS, dtype=bool),
        truncations=truncations,
        infos={"time": np.arange(STEPS + 1) / RATE, "solved": distances < 0.1},
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--episodes", type=int, default=20)
    arguments = parser.parse_args()
    folder: Path = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)

    recording = folder / "point.h5"
    rng = np.random.default_rng(0)
    with data.Recorder(recording) as recorder:
        for _ in range(arguments.episodes):
            recorder.add(episode(rng))
    trial = data.open(recording)["Trial0"]
    print(f"{recording}: {len(data.open(recording))} trials, observations {trial['observations'].shape}")

    made = data.export_minari(recording, "robohive/point/push-v0", root=folder / "minari")
    print(f'{made.folder}: MINARI_DATASETS_PATH={folder / "minari"}, minari.load_dataset("robohive/point/push-v0")')

    made = data.export_lerobot(recording, folder / "lerobot", task="push the point to the origin")
    print(f'{made.folder}: LeRobotDataset("robohive/point", root="{made.folder}")')

    frames = data.LeRobotFrames(made.folder)
    rewards = [one["next.reward"].sum() for one in frames]
    print(f"returns from {min(rewards):.1f} to {max(rewards):.1f}")


if __name__ == "__main__":
    main()
