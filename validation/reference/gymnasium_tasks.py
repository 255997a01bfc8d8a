#!/usr/bin/env python3
"""Gymnasium's locomotion tasks beside Gymnasium on MuJoCo, from equal seeds under equal actions.

    python validation/reference/gymnasium_tasks.py [--steps N] [--write FILE]

Needs gymnasium, mujoco==3.12.0 and this repository's package robohive in one environment. Episodes start from seeds 0, 1 …,
which decide the first state on both sides; actions are uniform in their space, seeded too, and
handed over in 64 bits, in which Gymnasium then computes their cost. An episode that Gymnasium ends is
followed by the next seed. A twin of Gymnasium's environment starts from positions that differ by 1e-12.

At every step, the largest difference of an observation (over max(1, its size)), and that of the reward, must be at most 1e-9,
or ten times the largest that the twin has shown in this episode up to then. Episodes must end at the same step.
"""

import argparse
import sys

# Beside this file stands another robohive.
sys.path.pop(0)

import gymnasium  # noqa: E402
import numpy as np  # noqa: E402
import robohive.vector  # noqa: E402

TASKS = ["Ant-v5", "Humanoid-v5", "Walker2d-v5", "HalfCheetah-v5", "Hopper-v5"]


def difference(ours, theirs):
    return float(np.max(np.abs(ours - theirs) / np.maximum(1, np.abs(theirs))))


class Reference:
    """Gymnasium's environment, and its twin."""

    def __init__(self, task):
        self.env = gymnasium.make(task).unwrapped
        self.twin = gymnasium.make(task).unwrapped

    def reset(self, seed):
        observation, _ = self.env.reset(seed=seed)
        self.twin.reset(seed=seed)
        self.twin.set_state(self.twin.data.qpos + 1e-12, self.twin.data.qvel)
        self.spread = 0.0
        return observation

    def step(self, action):
        observation, reward, ended, _, _ = self.env.step(action)
        twin = self.twin.step(action)
        self.spread = max(self.spread, difference(twin[0], observation), abs(twin[1] - reward))
        return observation, reward, ended


def compare(task, steps):
    """What a row of the table says of one task."""
    theirs = Reference(task)
    ours = robohive.vector.RoboHiveVectorEnv(f"gymnasium/{task}", 1, autoreset_mode="Disabled", infos="none")
    space = ours.single_action_space
    assert space == theirs.env.action_space, f"{task}: action spaces differ"
    draws = np.random.default_rng(0)
    row = {"episodes": 0, "reset": 0.0, "observation": 0.0, "reward": 0.0, "first": 0.0, "beyond": 0}
    over = True
    for step in range(steps):
        if over:
            observation, _ = ours.reset(seed=row["episodes"])
            expected = theirs.reset(row["episodes"])
            assert observation[0].shape == expected.shape, f"{task}: observations have other shapes"
            row["reset"] = max(row["reset"], difference(observation[0], expected))
            row["episodes"] += 1
        action = draws.uniform(space.low, space.high).astype(np.float32).astype(np.float64)
        observation, reward, terminated, truncated, infos = ours.step(action[None])
        expected, expected_reward, ended = theirs.step(action)
        assert not infos, f"{task}: {infos}"
        seen = difference(observation[0], expected), abs(reward[0] - expected_reward)
        row["observation"], row["reward"] = max(row["observation"], seen[0]), max(row["reward"], seen[1])
        row["first"] = max(row["first"], max(seen)) if row["episodes"] == 1 and step < 10 else row["first"]
        allowed = max(1e-9, 10 * theirs.spread)
        row["beyond"] += max(seen) > allowed or bool(terminated[0]) != bool(ended)
        over = bool(terminated[0] or truncated[0] or ended)
    return row


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--steps", type=int, default=1000)
    arguments.add_argument("--write")
    arguments = arguments.parse_args()
    lines = [
        "| task | episodes | first observations | ten steps | observations | rewards | steps beyond the bound |",
        "|---|---|---|---|---|---|---|",
    ]
    beyond = 0
    for task in TASKS:
        row = compare(task, arguments.steps)
        beyond += row["beyond"]
        lines.append(
            f"| {task} | {row['episodes']} | {row['reset']:.1e} | {row['first']:.1e} | {row['observation']:.1e} "
            f"| {row['reward']:.1e} | {row['beyond']} |"
        )
        print(lines[-1], flush=True)
    if arguments.write:
        with open(arguments.write, encoding="utf-8") as file:
            text = file.read()
        begin, end = "<!-- tasks begin -->\n", "<!-- tasks end -->"
        head, tail = text[: text.index(begin) + len(begin)], text[text.index(end) :]
        with open(arguments.write, "w", encoding="utf-8") as file:
            file.write(head + "\n".join(lines) + "\n" + tail)
    sys.exit(beyond > 0)


if __name__ == "__main__":
    main()
