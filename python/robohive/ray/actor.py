"""The actor that runs units of episodes, and what it sends: all episodes of a unit in a few arrays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from robohive.collect import Array, Episode, EpisodeRunner, PolicyMaker


@dataclass(frozen=True)
class Packed:
    """Episodes end to end, so that a unit travels as a few large arrays."""

    indices: Array
    seeds: Array
    lengths: Array
    observations: Array
    actions: Array
    rewards: Array
    terminated: Array
    truncated: Array
    faults: tuple[str | None, ...]
    version: int

    @classmethod
    def of(cls, episodes: Sequence[Episode], version: int) -> Packed:
        """Packs the episodes of one unit."""
        return cls(
            indices=np.array([e.index for e in episodes], np.int64),
            seeds=np.array([e.seed for e in episodes], np.uint64),
            lengths=np.array([e.length for e in episodes], np.int64),
            observations=np.concatenate([e.observations for e in episodes]),
            actions=np.concatenate([e.actions for e in episodes]),
            rewards=np.concatenate([e.rewards for e in episodes]),
            terminated=np.array([e.terminated for e in episodes]),
            truncated=np.array([e.truncated for e in episodes]),
            faults=tuple(e.fault for e in episodes),
            version=version,
        )

    def episodes(self) -> Iterator[Episode]:
        """The episodes, each with arrays of its own."""
        end = 0
        for at, length in enumerate(self.lengths.tolist()):
            begin, end = end, end + length
            yield Episode(
                index=int(self.indices[at]),
                seed=int(self.seeds[at]),
                # Every episode has one observation more than steps.
                observations=self.observations[begin + at : end + at + 1].copy(),
                actions=self.actions[begin:end].copy(),
                rewards=self.rewards[begin:end].copy(),
                terminated=bool(self.terminated[at]),
                truncated=bool(self.truncated[at]),
                version=self.version,
                fault=self.faults[at],
            )


@dataclass(frozen=True)
class Job:
    """What every actor of a collection is made of."""

    id: str
    policy: PolicyMaker
    seed: int
    num_envs: int
    threads: int
    settings: Mapping[str, Any]


class EpisodeActor:
    """Runs units of episodes in a process of its own."""

    def __init__(self, job: Job) -> None:
        self._runner = EpisodeRunner(
            job.id,
            job.policy,
            seed=job.seed,
            num_envs=job.num_envs,
            threads=job.threads,
            settings=job.settings,
        )
        self._version = 0

    def is_ready(self) -> bool:
        """Answers as soon as the environments are made."""
        return True

    def run(self, episodes: tuple[int, ...], version: int, state: Any) -> Packed:
        """Runs the episodes of a unit with the policy's parameters of this version."""
        if version != self._version:
            self._runner.policy.load(state)
            self._version = version
        return Packed.of(list(self._runner.run(episodes, version)), version)
