"""Episodes by number: each one's seed follows from its number alone, so that who runs it, beside what, and how often, changes
nothing in it.

>>> from robohive.collect import RandomPolicy, collect
>>> episodes = list(collect("hive/FrankaReach-v0", 4, seed=7, policy=RandomPolicy))
>>> [episode.index for episode in sorted(episodes, key=lambda e: e.index)]
[0, 1, 2, 3]
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from robohive.whole_numbers import whole

Array = NDArray[Any]


class Policy(Protocol):
    """Chooses actions for all environments of a vector.

    What it draws must come from the seeds that it is started with, slot by slot; then an episode does not depend on its
    neighbours.
    """

    def start(self, slot: int, seed: int) -> None:
        """An episode begins in environment `slot`; `seed` is its own."""

    def act(self, observations: Array) -> Array:
        """Actions (environments x action length) for observations (environments x observation length)."""
        ...

    def load(self, state: Any) -> None:
        """Takes parameters that a learner sent."""


PolicyMaker = Callable[[Any, Any, int], Policy]
"""Makes a policy from the observation space and the action space of one environment, and the number of environments."""


class RandomPolicy:
    """Uniform draws from the action space, every episode from a generator of its own."""

    def __init__(self, observation_space: Any, action_space: Any, num_envs: int) -> None:
        self._low, self._high = action_space.low, action_space.high
        self._dtype = action_space.dtype
        self._generators = [np.random.default_rng(0) for _ in range(num_envs)]

    def start(self, slot: int, seed: int) -> None:
        self._generators[slot] = np.random.default_rng(seed)

    def act(self, observations: Array) -> Array:
        rows = [generator.uniform(self._low, self._high) for generator in self._generators]
        return np.asarray(rows, dtype=self._dtype)

    def load(self, state: Any) -> None:
        if state is not None:
            raise TypeError("a random policy has no parameters to load")


@dataclass(frozen=True)
class Episode:
    """One finished episode of `length` steps."""

    index: int
    """Its number, from 0."""
    seed: int
    """The seed that its environment was reset with."""
    observations: Array
    """(length + 1) x observation length, the first from the reset."""
    actions: Array
    """length x action length."""
    rewards: Array
    """length."""
    terminated: bool
    """The task ended it."""
    truncated: bool
    """Its length, or a step that physics refused, ended it."""
    version: int = 0
    """Which of the policy's parameters were used: the number of updates before them."""
    fault: str | None = None
    """Why physics refused the last step; None in all other episodes."""

    @property
    def length(self) -> int:
        """Steps."""
        return len(self.rewards)

    @property
    def total(self) -> float:
        """Sum of its rewards."""
        return float(self.rewards.sum())


def seeds(seed: int, index: int) -> tuple[int, int]:
    """Seeds of episode `index`: of its environment and of its policy, 64 bits each (numpy's `SeedSequence`)."""
    environment, policy = np.random.SeedSequence([seed, index]).generate_state(2, np.uint64)
    return int(environment), int(policy)


class EpisodeRunner:
    """A vector of environments and a policy that run episodes by their numbers."""

    def __init__(
        self,
        id: str,
        policy: PolicyMaker,
        *,
        seed: int = 0,
        num_envs: int = 16,
        threads: int = 1,
        settings: Mapping[str, Any] | None = None,
    ) -> None:
        from gymnasium.vector import AutoresetMode

        from robohive.vector import make_vec

        num_envs, threads = whole("num_envs", num_envs, 1), whole("threads", threads)
        self._envs = make_vec(
            id,
            num_envs,
            num_threads=threads,
            autoreset_mode=AutoresetMode.DISABLED,
            infos="none",
            **dict(settings or {}),
        )
        self._seed = seed
        self._policy = policy(self._envs.single_observation_space, self._envs.single_action_space, num_envs)

    @property
    def policy(self) -> Policy:
        """The policy, to load parameters into."""
        return self._policy

    def run(self, indices: Sequence[int], version: int = 0) -> Iterator[Episode]:
        """Runs the episodes with these numbers; each is yielded when it ends."""
        waiting = deque(indices)
        if not waiting:
            return
        slots: list[_Slot | None] = [None] * self._envs.num_envs
        observations = self._begin(slots, waiting, np.ones(len(slots), bool))
        while any(slots):
            actions = self._policy.act(observations)
            observations, rewards, terminated, truncated, infos = self._envs.step(actions)
            over = terminated | truncated
            faults = infos.get("fault", [None] * len(slots))
            for at, slot in enumerate(slots):
                if slot is None:
                    continue
                slot.observations.append(observations[at].copy())
                slot.actions.append(np.array(actions[at]))
                slot.rewards.append(float(rewards[at]))
                if over[at]:
                    yield slot.finish(bool(terminated[at]), bool(truncated[at]), version, faults[at])
                    slots[at] = None
            if over.any():
                observations = self._begin(slots, waiting, over)

    def _begin(self, slots: list[_Slot | None], waiting: deque[int], over: NDArray[np.bool_]) -> Array:
        """Resets the environments whose episodes are over: for those that wait, or else to idle on; observations of all."""
        environment_seeds: list[int | None] = [None] * len(slots)
        for at in np.flatnonzero(over):
            if waiting:
                index = waiting.popleft()
                environment_seed, policy_seed = seeds(self._seed, index)
                environment_seeds[at] = environment_seed
                self._policy.start(int(at), policy_seed)
                slots[at] = _Slot(index, environment_seed)
        observations, _ = self._envs.reset(seed=environment_seeds, options={"reset_mask": over})
        for at in np.flatnonzero(over):
            if started := slots[at]:
                started.observations.append(observations[at].copy())
        return np.asarray(observations)

    def close(self) -> None:
        """Ends the environments."""
        self._envs.close()


class _Slot:
    """The episode under way in one environment."""

    def __init__(self, index: int, seed: int) -> None:
        self.index, self.seed = index, seed
        self.observations: list[Array] = []
        self.actions: list[Array] = []
        self.rewards: list[float] = []

    def finish(self, terminated: bool, truncated: bool, version: int, fault: str | None) -> Episode:
        return Episode(
            index=self.index,
            seed=self.seed,
            observations=np.stack(self.observations),
            actions=np.stack(self.actions),
            rewards=np.asarray(self.rewards),
            terminated=terminated,
            truncated=truncated,
            version=version,
            fault=fault,
        )


def collect(
    id: str,
    episodes: int | Iterable[int],
    *,
    policy: PolicyMaker,
    seed: int = 0,
    num_envs: int = 16,
    threads: int = 0,
    settings: Mapping[str, Any] | None = None,
) -> Iterator[Episode]:
    """Runs episodes in this process, `num_envs` at a time on `threads` threads (0: one a core), and yields each as it ends.

    Args:
        id: Id of the environment.
        episodes: How many, or their numbers.
        policy: Makes the policy; `RandomPolicy` is one.
        seed: Base of all seeds.
        settings: Settings of the environment that differ from the id's.
    """
    numbers = range(whole("episodes", episodes)) if isinstance(episodes, int) else list(episodes)
    runner = EpisodeRunner(id, policy, seed=seed, num_envs=num_envs, threads=threads, settings=settings)
    try:
        yield from runner.run(numbers)
    finally:
        runner.close()
