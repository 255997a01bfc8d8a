"""Collects episodes on all nodes of a Ray cluster."""

from __future__ import annotations

import time
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import ray
from ray.exceptions import (
    NodeDiedError,
    ObjectLostError,
    RayActorError,
    RayTaskError,
    WorkerCrashedError,
)

from robohive.collect import Episode, PolicyMaker
from robohive.ray.actor import EpisodeActor, Job
from robohive.ray.plan import Plan, Unit

_LOST = (RayActorError, NodeDiedError, ObjectLostError, WorkerCrashedError)
"""What says that an actor or its result is gone, and nothing about the episodes."""

_LOOK = 1.0
"""Seconds between looks at the cluster's size."""


class Collector:
    """Runs numbered episodes on actors all over a cluster and yields each episode exactly once.

    The seed of an episode follows from `seed` and its number, so that the set of episodes does not depend on the number of
    nodes, on the order in which actors finish, or on actors and nodes that die: a lost unit of episodes is run again, on
    another actor, with the same seeds.

    An actor gets its next unit when its last one was fetched, so that a slow consumer holds at most one unit an actor.

    >>> collector = Collector("hive/FrankaReach-v0", 10_000, policy=RandomPolicy)  # doctest: +SKIP
    >>> for episode in collector:                                                 # doctest: +SKIP
    ...     learn(episode)
    """

    def __init__(
        self,
        id: str,
        episodes: int | Iterable[int],
        *,
        policy: PolicyMaker,
        seed: int = 0,
        actors: int | None = None,
        cpus_per_actor: float = 1,
        envs_per_actor: int = 16,
        unit: int | None = None,
        attempts: int = 20,
        settings: Mapping[str, Any] | None = None,
        actor_options: Mapping[str, Any] | None = None,
    ) -> None:
        """Nothing starts before the first episode is asked for; `ray.init` comes before that.

        Args:
            id: Id of the environment.
            episodes: How many, or their numbers: those that an interrupted collection still lacks, for instance.
            policy: Makes the policy of an actor; it travels to the nodes by pickling.
            seed: Base of all seeds.
            actors: How many actors; None: as many as the cluster's processors allow, also when nodes come and go.
            cpus_per_actor: Processors of an actor; its environments step on as many threads.
            envs_per_actor: Environments that an actor steps together.
            unit: Episodes that an actor runs in one call; None: four times its environments.
            attempts: How often a unit may be lost before `LostEpisodes` is raised.
            settings: Settings of the environment that differ from the id's.
            actor_options: Options of the actors for Ray, as `{"resources": {…}, "runtime_env": {…}}`.

        Raises:
            ValueError: A number of actors, processors, environments, episodes of a unit or attempts is not positive.
        """
        unit = 4 * envs_per_actor if unit is None else unit
        numbers = {"cpus_per_actor": cpus_per_actor, "envs_per_actor": envs_per_actor, "unit": unit, "attempts": attempts}
        if actors is not None:
            numbers["actors"] = actors
        for name, number in numbers.items():
            if not number > 0:
                raise ValueError(f"{name} is positive, not {number}")
        self._plan = Plan.of(range(episodes) if isinstance(episodes, int) else episodes, unit, attempts)
        threads = max(1, int(cpus_per_actor))
        self._job = Job(id, policy, seed, envs_per_actor, threads, dict(settings or {}))
        self._wanted = actors
        self._cpus = cpus_per_actor
        self._actor_class = ray.remote(EpisodeActor).options(
            num_cpus=cpus_per_actor,
            # Units that an actor loses are run by another; the collector decides which.
            max_restarts=0,
            max_task_retries=0,
            scheduling_strategy="SPREAD",
            **dict(actor_options or {}),
        )
        # Actors by the call that they are to answer: starting ones, and those with a unit.
        self._starting: dict[Any, Any] = {}
        self._busy: dict[Any, tuple[Any, Unit]] = {}
        self._idle: list[Any] = []
        self._looked = -float("inf")
        self._version = 0
        self._state: Any = None
        self.actors_lost = 0
        """Actors that died, with their nodes or alone."""

    def update(self, state: Any) -> int:
        """Sends parameters to the policy: units that start from now on use them. The version that their episodes carry."""
        self._version, self._state = self._version + 1, ray.put(state)
        return self._version

    @property
    def actors(self) -> int:
        """Actors that have started."""
        return len(self._idle) + len(self._busy)

    @property
    def units_lost(self) -> int:
        """How often a unit had to be run again."""
        return self._plan.lost

    def __iter__(self) -> Iterator[Episode]:
        try:
            while not self._plan.is_over:
                self._staff()
                self._assign()
                yield from self._answers()
        finally:
            self.close()

    def _staff(self) -> None:
        """Starts actors until there are as many as wanted, or as the cluster has processors for."""
        if time.monotonic() - self._looked < _LOOK:
            return
        self._looked = time.monotonic()
        wanted = self._wanted
        if wanted is None:
            wanted = max(1, int(ray.cluster_resources().get("CPU", 0) // self._cpus))
        lacking = wanted - self.actors - len(self._starting)
        for _ in range(lacking):
            actor = self._actor_class.remote(self._job)
            self._starting[actor.is_ready.remote()] = actor
        # Nodes that went took the room of actors that still wait for one.
        for call in list(self._starting)[: max(0, -lacking)]:
            ray.kill(self._starting.pop(call))

    def _assign(self) -> None:
        """Gives every idle actor a unit, while there are any."""
        while self._idle and (unit := self._plan.take()):
            actor = self._idle.pop()
            self._busy[actor.run.remote(unit.episodes, self._version, self._state)] = (actor, unit)

    def _answers(self) -> Iterator[Episode]:
        """Waits until an actor has started or finished a unit, at most until the next look, and yields the episodes."""
        calls = [*self._starting, *self._busy]
        for call in ray.wait(calls, timeout=_LOOK)[0] if calls else []:
            try:
                answer = ray.get(call)
            except _LOST as error:
                self._bury(call, error)
                continue
            except RayTaskError as error:
                raise error.as_instanceof_cause() from error
            if call in self._starting:
                self._idle.append(self._starting.pop(call))
                continue
            actor, unit = self._busy.pop(call)
            self._plan.finish(unit)
            self._idle.append(actor)
            # The actor works on its next unit while the consumer works on this one.
            self._assign()
            yield from answer.episodes()

    def _bury(self, call: Any, error: Exception) -> None:
        """An actor or its answer is gone: its unit, if it had one, waits again."""
        if isinstance(error, RayActorError) and error.actor_init_failed:
            raise error
        self.actors_lost += 1
        # Its place is filled without waiting for the next look.
        self._looked = -float("inf")
        if call in self._starting:
            ray.kill(self._starting.pop(call))
            return
        actor, unit = self._busy.pop(call)
        ray.kill(actor)
        self._plan.lose(unit)

    def close(self) -> None:
        """Ends all actors; what they were running is lost."""
        busy = [actor for actor, _ in self._busy.values()]
        for actor in [*self._idle, *self._starting.values(), *busy]:
            ray.kill(actor)
        self._starting, self._busy, self._idle = {}, {}, []
