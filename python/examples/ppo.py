"""Proximal policy optimisation in one file (Schulman et al. 2017), torch on a vector that steps in Rust.

python examples/ppo.py [--id ID] [--updates N] [--table FILE]

Prints the mean return of the episodes that finished since the last report, and how many of them ended solved, after every
tenth update.
"""

import argparse
import time
from dataclasses import dataclass
from pathlib import Path

import gymnasium as gym
import numpy as np
import robohive  # noqa: F401
import torch
from torch import Tensor, nn


@dataclass
class Settings:
    id: str = "hive/FrankaReach-v0"
    envs: int = 64
    steps: int = 50
    updates: int = 200
    epochs: int = 8
    minibatch: int = 800
    rate: float = 1e-3
    discount: float = 0.95
    trace: float = 0.95
    clip: float = 0.2
    entropy: float = 0.0
    seed: int = 0


class Normaliser:
    """Observations by the mean and deviation of all so far (Chan et al. 1979, parallel variance)."""

    def __init__(self, width: int) -> None:
        self.count, self.mean, self.spread = 1e-4, np.zeros(width), np.ones(width)

    def update(self, rows: np.ndarray) -> None:
        count, mean, spread = len(rows), rows.mean(0), rows.var(0)
        total, delta = self.count + count, mean - self.mean
        moment = self.spread * self.count + spread * count + delta**2 * self.count * count / total
        self.mean, self.spread, self.count = self.mean + delta * count / total, moment / total, total

    def __call__(self, rows: np.ndarray) -> Tensor:
        scaled = (rows - self.mean) / np.sqrt(self.spread + 1e-8)
        return torch.as_tensor(scaled.clip(-10, 10), dtype=torch.float32)


class Agent(nn.Module):
    """A Gaussian policy and a value."""

    def __init__(self, observation: int, action: int) -> None:
        super().__init__()
        self.mean = self.network(observation, action, 0.01)
        self.value = self.network(observation, 1, 1.0)
        self.log_deviation = nn.Parameter(torch.full((action,), -0.5))

    @staticmethod
    def network(inputs: int, outputs: int, gain: float) -> nn.Sequential:
        layers = [nn.Linear(inputs, 64), nn.Linear(64, 64), nn.Linear(64, outputs)]
        for layer, scale in zip(layers, (2**0.5, 2**0.5, gain), strict=True):
            nn.init.orthogonal_(layer.weight, scale)
            nn.init.zeros_(layer.bias)
        return nn.Sequential(layers[0], nn.Tanh(), layers[1], nn.Tanh(), layers[2])

    def policy(self, observations: Tensor) -> torch.distributions.Independent:
        normal = torch.distributions.Normal(self.mean(observations), self.log_deviation.exp())
        return torch.distributions.Independent(normal, 1)


@dataclass
class Batch:
    """What one pass through the environments yielded, steps x environments."""

    observations: Tensor
    actions: Tensor
    log_probabilities: Tensor
    advantages: Tensor
    returns: Tensor


@dataclass
class Report:
    """What the episodes were like that finished since the report before."""

    update: int
    steps: int
    seconds: float
    mean_return: float
    solved: float

    def __str__(self) -> str:
        return f"update {self.update}: {self.steps} steps, mean return {self.mean_return:.2f}, solved {self.solved:.0%}"


class Learner:
    """Collects with the present policy, then improves it."""

    def __init__(self, settings: Settings) -> None:
        torch.manual_seed(settings.seed)
        self.settings = settings
        self.envs = gym.make_vec(settings.id, num_envs=settings.envs, vectorization_mode="vector_entry_point")
        width = self.envs.single_observation_space.shape[0]
        self.normalise = Normaliser(width)
        self.agent = Agent(width, self.envs.single_action_space.shape[0])
        self.optimiser = torch.optim.Adam(self.agent.parameters(), lr=settings.rate, eps=1e-5)
        self.observation, _ = self.envs.reset(seed=settings.seed)
        self.ended = np.zeros(settings.envs, bool)
        self.totals = np.zeros(settings.envs)
        self.finished: list[float] = []
        self.solved: list[bool] = []

    @torch.no_grad()
    def collect(self) -> Batch:
        """One pass: every environment takes `steps` steps. A step that only resets (autoreset) teaches nothing."""
        s, agent = self.settings, self.agent
        rows: list[tuple[Tensor, Tensor, Tensor, Tensor]] = []
        rewards = np.zeros((s.steps, s.envs))
        resets, ends, over = (np.zeros((s.steps, s.envs), bool) for _ in range(3))
        for t in range(s.steps):
            self.normalise.update(self.observation)
            seen = self.normalise(self.observation)
            policy = agent.policy(seen)
            action = policy.sample()
            rows.append((seen, action, policy.log_prob(action), agent.value(seen).squeeze(-1)))
            resets[t] = self.ended
            self.observation, rewards[t], terminated, truncated, infos = self.envs.step(action.clamp(-1, 1).numpy())
            self.ended = terminated | truncated
            ends[t], over[t] = terminated, self.ended
            self.totals += rewards[t]
            self.finished += self.totals[self.ended].tolist()
            self.solved += infos["solved"][self.ended].tolist()
            self.totals[self.ended] = 0.0
        last = agent.value(self.normalise(self.observation)).squeeze(-1)
        seen, actions, log_probabilities, values = (torch.stack(parts) for parts in zip(*rows, strict=True))
        advantages = self.advantages(values, last, rewards, ends, over)
        useful = torch.as_tensor(~resets)
        returns = advantages + values
        return Batch(*(x[useful] for x in (seen, actions, log_probabilities, advantages, returns)))

    def advantages(
        self, values: Tensor, last: Tensor, rewards: np.ndarray, ends: np.ndarray, over: np.ndarray
    ) -> Tensor:
        """Generalised advantage estimates (Schulman et al. 2016, eq. 16)."""
        s = self.settings
        found, running = torch.zeros_like(values), torch.zeros(s.envs)
        for t in reversed(range(s.steps)):
            after = last if t + 1 == s.steps else values[t + 1]
            alive = torch.as_tensor(~ends[t], dtype=torch.float32)
            error = torch.as_tensor(rewards[t], dtype=torch.float32) + s.discount * alive * after - values[t]
            goes_on = torch.as_tensor(~over[t], dtype=torch.float32)
            running = error + s.discount * s.trace * goes_on * running
            found[t] = running
        return found

    def improve(self, batch: Batch) -> None:
        """Several epochs of clipped policy gradients."""
        s = self.settings
        for _ in range(s.epochs):
            for rows in torch.randperm(len(batch.actions)).split(s.minibatch):
                policy = self.agent.policy(batch.observations[rows])
                ratio = (policy.log_prob(batch.actions[rows]) - batch.log_probabilities[rows]).exp()
                advantage = batch.advantages[rows]
                advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
                clipped = ratio.clamp(1 - s.clip, 1 + s.clip)
                gain = torch.minimum(ratio * advantage, clipped * advantage).mean()
                value = self.agent.value(batch.observations[rows]).squeeze(-1)
                miss = 0.5 * (value - batch.returns[rows]).square().mean()
                loss = miss - gain - s.entropy * policy.entropy().mean()
                self.optimiser.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(self.agent.parameters(), 0.5)
                self.optimiser.step()

    def learn(self) -> list[Report]:
        """All updates; what is known of the episodes that finished between reports."""
        began, reports = time.process_time(), []
        for update in range(1, self.settings.updates + 1):
            self.improve(self.collect())
            if (update % 10 == 0 or update == self.settings.updates) and self.finished:
                steps = update * self.settings.envs * self.settings.steps
                seconds, share = time.process_time() - began, float(np.mean(self.solved))
                reports.append(Report(update, steps, seconds, float(np.mean(self.finished)), share))
                print(f"{reports[-1]}, {steps / seconds:.0f} steps/s", flush=True)
                self.finished, self.solved = [], []
        self.envs.close()
        return reports


def table(settings: Settings, reports: list[Report]) -> str:
    """The learning curve as a page."""
    lines = [
        "# A policy learned with PPO",
        "",
        f"`python python/examples/ppo.py --id {settings.id} --updates {settings.updates} --envs {settings.envs} "
        f"--seed {settings.seed} --table FILE`, torch {torch.__version__} with {torch.get_num_threads()} thread(s). Episodes "
        "that finished since the row before: their mean return, and the share of them whose last step was solved.",
        "",
        "| update | steps | processor time [s] | mean return | solved |",
        "|---|---|---|---|---|",
        *(f"| {r.update} | {r.steps} | {r.seconds:.0f} | {r.mean_return:.2f} | {r.solved:.1%} |" for r in reports),
        "",
    ]
    return "\n".join(lines)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--id", default=Settings.id)
    arguments.add_argument("--updates", type=int, default=Settings.updates)
    arguments.add_argument("--envs", type=int, default=Settings.envs)
    arguments.add_argument("--seed", type=int, default=Settings.seed)
    arguments.add_argument("--table", type=Path, help="where to write the learning curve")
    given = vars(arguments.parse_args())
    path = given.pop("table")
    settings = Settings(**given)
    reports = Learner(settings).learn()
    if path:
        path.write_text(table(settings, reports))


if __name__ == "__main__":
    main()
