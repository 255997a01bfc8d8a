#!/usr/bin/env python3
"""Samples a second collected and learnt: `robohive.training` beside PyTorch learners in CleanRL's manner.

    python python/benches/learning.py [--rounds N] [--only TEXT] [--write FILE]

This interpreter has this repository's wheel, gymnasium and torch. Both sides learn on the same environments, one thread on
one core, with networks of two hidden layers of 64, the same samples an iteration and as many passes over batches of the same
size, in turns. PyTorch's proximal policy optimisation is `python/examples/ppo.py`; its soft actor-critic stands below:
one environment, an update of both critics, the policy and the temperature for each step, as in CleanRL's
`sac_continuous_action.py` but for the delay of the policy's updates. Ours normalises layers of the critics besides.
"""

import argparse
import copy
import os
import pathlib
import statistics
import sys
import tempfile
import time

import gymnasium as gym
import numpy as np
import torch
from torch import nn

from robohive.training import Run

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "examples"))
import ppo

IDS = ["hive/myoElbowPose1D6MRandom-v0", "hive/FrankaReach-v0"]
HIDDEN = 64
SAC_BATCH = 128
BEGIN, END = "<!-- learning table begins -->", "<!-- learning table ends -->"
SAC_STEPS = 2000


class OurRun:
    """Ours: a run, an iteration at a time."""

    def __init__(self, id, algorithm, settings):
        self.folder = tempfile.TemporaryDirectory()
        self.run = Run.create(
            id, self.folder.name, algorithm=algorithm, settings=settings, iterations=10**6, keep_every=10**6, threads=1
        )
        self.samples = 0

    def turn(self):
        """Makes an iteration: how many samples it was of."""
        before, self.samples = self.samples, self.run.iterate()["num_samples"]
        return self.samples - before


class TorchPpo:
    """The example's learner."""

    def __init__(self, id, envs, steps, epochs, batch):
        self.learner = ppo.Learner(ppo.Settings(id=id, envs=envs, steps=steps, epochs=epochs, minibatch=batch))

    def turn(self):
        batch = self.learner.collect()
        self.learner.improve(batch)
        return len(batch.actions)


def network(inputs, outputs):
    return nn.Sequential(
        nn.Linear(inputs, HIDDEN), nn.ReLU(), nn.Linear(HIDDEN, HIDDEN), nn.ReLU(), nn.Linear(HIDDEN, outputs)
    )


class TorchSac:
    """Soft actor-critic (Haarnoja et al. 2018) on one environment."""

    DISCOUNT, SHARE, RATE, ROOM = 0.98, 0.01, 5e-4, 1 << 20

    def __init__(self, id):
        self.env = gym.make(id)
        seen, acts = self.env.observation_space.shape[0], self.env.action_space.shape[0]
        self.acts = acts
        self.policy, self.critics = network(seen, 2 * acts), [network(seen + acts, 1) for _ in range(2)]
        self.targets = copy.deepcopy(self.critics)
        self.log_temperature = torch.zeros(1, requires_grad=True)
        learnt = [self.policy.parameters(), [self.log_temperature], [p for c in self.critics for p in c.parameters()]]
        self.of_policy, self.of_temperature, self.of_critics = (torch.optim.Adam(each, lr=self.RATE) for each in learnt)
        self.replay = np.zeros((self.ROOM, 2 * seen + acts + 2), np.float32)
        self.widths = [seen, acts, 1, seen, 1]
        self.count = 0
        self.observation, _ = self.env.reset(seed=0)

    def draw(self, observations):
        """Actions, and the logarithms of their densities."""
        mean, log_deviation = self.policy(observations).chunk(2, -1)
        normal = torch.distributions.Normal(mean, log_deviation.clamp(-5, 2).exp())
        raw = normal.rsample()
        action = raw.tanh()
        return action, (normal.log_prob(raw) - (1 - action.square() + 1e-6).log()).sum(-1, keepdim=True)

    def step(self):
        with torch.no_grad():
            action, _ = self.draw(torch.as_tensor(self.observation, dtype=torch.float32))
        after, reward, terminated, truncated, _ = self.env.step(action.numpy())
        row = self.replay[self.count % self.ROOM]
        np.concatenate([self.observation, action.numpy(), [reward], after, [float(terminated)]], out=row, casting="same_kind")
        self.count += 1
        self.observation = self.env.reset()[0] if terminated or truncated else after

    def update(self):
        rows = np.random.randint(min(self.count, self.ROOM), size=SAC_BATCH)
        seen, actions, rewards, after, over = torch.from_numpy(self.replay[rows]).split(self.widths, -1)
        temperature = self.log_temperature.exp().detach()
        with torch.no_grad():
            next_actions, densities = self.draw(after)
            pair = torch.cat([after, next_actions], -1)
            least = torch.minimum(*(target(pair) for target in self.targets)) - temperature * densities
            wanted = rewards + (1 - over) * self.DISCOUNT * least
        pair = torch.cat([seen, actions], -1)
        miss = sum((critic(pair) - wanted).square().mean() for critic in self.critics)
        self.descend(self.of_critics, miss)
        drawn, densities = self.draw(seen)
        pair = torch.cat([seen, drawn], -1)
        self.descend(self.of_policy, (temperature * densities - torch.minimum(*(c(pair) for c in self.critics))).mean())
        self.descend(self.of_temperature, -(self.log_temperature.exp() * (densities.detach() - self.acts)).mean())
        with torch.no_grad():
            for critic, target in zip(self.critics, self.targets, strict=True):
                for new, old in zip(critic.parameters(), target.parameters(), strict=True):
                    old.lerp_(new, self.SHARE)

    @staticmethod
    def descend(optimiser, loss):
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()

    def turn(self):
        for _ in range(SAC_STEPS):
            self.step()
            if self.count >= SAC_BATCH:
                self.update()
        return SAC_STEPS


def sides(id):
    """What is compared: a name, ours, and PyTorch's."""
    horizon = gym.make(id).unwrapped.horizon
    nets = {"hidden": [[HIDDEN, HIDDEN], [HIDDEN, HIDDEN]]}
    for batch in (64, 800):
        epochs = 10
        fit = {"epochs": epochs, "batch": batch}
        settings = {**nets, "episodes": 32, "algorithm": {"ppo": {**fit, "divergence": 1e9}}, "fit": fit}
        yield (
            f"PPO, {epochs} passes, batches of {batch}",
            lambda settings=settings: OurRun(id, "ppo", settings),
            lambda batch=batch: TorchPpo(id, 32, horizon, epochs, batch),
        )
    settings = {**nets, "episodes": max(1, SAC_STEPS // horizon), "fit": {"epochs": SAC_BATCH, "batch": SAC_BATCH}}
    settings["algorithm"] = {"sac": {"begin": SAC_BATCH}}
    yield f"SAC, batches of {SAC_BATCH}", lambda: OurRun(id, "sac", settings), lambda: TorchSac(id)


def rates(made, rounds):
    """Samples a second of processor time of each side, in turns after one that warms up."""
    for side in made:
        side.turn()
    found = [[] for _ in made]
    for _ in range(rounds):
        for side, own in zip(made, found, strict=True):
            began = time.process_time()
            samples = side.turn()
            own.append(samples / (time.process_time() - began))
    return [statistics.median(own) for own in found]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--only", default="", help="part of an id or of an algorithm's row")
    arguments.add_argument("--write", type=pathlib.Path, help="a page whose table is replaced")
    given = arguments.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    torch.set_num_threads(1)
    lines = ["| environment | learner | ours | PyTorch | ratio |", "|---|---|---|---|---|"]
    for id in IDS:
        for name, ours, theirs in sides(id):
            if given.only in f"{id} {name}":
                own, other = rates([ours(), theirs()], given.rounds)
                lines.append(f"| {id} | {name} | {own:.0f} | {other:.0f} | {own / other:.1f} |")
                print(lines[-1], flush=True)
    if given.write:
        before, found, rest = given.write.read_text().partition(BEGIN)
        _, ended, after = rest.partition(END)
        if not (found and ended):
            raise SystemExit(f"{given.write} has no lines {BEGIN} and {END}, between which the table is written")
        given.write.write_text("\n".join([before + BEGIN, *lines, END + after]))


if __name__ == "__main__":
    main()
