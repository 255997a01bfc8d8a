"""Trainings: policies learnt by `robohive train`'s algorithms, from Python.

A run is a folder, which `robohive train --resume`, `robohive report` and `robohive evaluate` take too. Its seed decides
everything: the same run ends in the same bits on any number of threads, and one that was interrupted and resumed in those of
one that was not.

>>> import tempfile
>>> from robohive.training import Run
>>> run = Run.create(
...     "hive/myoElbowPose1D6MRandom-v0", tempfile.mkdtemp(), algorithm="ppo", iterations=2, settings={"episodes": 4}
... )
>>> for row in run:
...     print(int(row["iteration"]), int(row["num_samples"]))
1 800
2 1200
>>> policy = run.env.policy(run.policy)
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

from robohive import _core, make

__all__ = ["ALGORITHMS", "Run", "complete", "configuration", "settings", "variations"]

if TYPE_CHECKING:
    from robohive.envs import RoboHiveEnv

ALGORITHMS = tuple(_core.learning_algorithms())
"""Algorithms by name: natural policy gradient, proximal policy optimisation, soft actor-critic, behaviour cloning, dataset
aggregation, and the natural policy gradient with demonstrations."""


def settings(algorithm: str) -> dict[str, Any]:
    """Settings to begin with: the table `learning` of a run.toml.

    Raises:
        ValueError: there is no such algorithm.
    """
    return _core.learning_settings(algorithm)


def configuration(
    id: str,
    *,
    algorithm: str = "npg",
    seed: int = 1,
    iterations: int = 100,
    keep_every: int = 10,
    settings: Mapping[str, Any] | None = None,
    teacher: str | PathLike[str] | None = None,
    demonstrations: int = 50,
    demonstration_noise: float = 0.05,
    compat: str = "fixed",
    solver: str = "own",
    environment: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """What is trained, and how: what a run.toml says.

    Args:
        id: Id of the environment.
        algorithm: One of `ALGORITHMS`.
        seed: Seed of the run.
        iterations: Iterations in all.
        keep_every: Iterations from one checkpoint to the next.
        settings: Settings that differ from `settings(algorithm)`; dictionaries within them are merged.
        teacher: Who shows how it is done, for bc, dagger and dapg: a controller's name, or the file of a policy.
        demonstrations: Episodes in which the teacher succeeds.
        demonstration_noise: Deviation of what is added to the teacher's actions when they are taken.
        compat: Whose behaviour the environment has, as for `robohive.make`.
        solver: What moves it, as for `robohive.make`.
        environment: Settings of the environment that differ from the id's.

    Raises:
        ValueError: there is no such algorithm.
    """
    found = {
        "id": id,
        "seed": seed,
        "iterations": iterations,
        "keep_every": keep_every,
        "compat": compat,
        "solver": solver,
        "environment": dict(environment or {}),
        "learning": _merged(_core.learning_settings(algorithm), settings or {}),
    }
    if teacher is not None:
        lessons = {"episodes": demonstrations, "noise": float(demonstration_noise)}
        found["teacher"] = {"by": fspath(teacher), "lessons": lessons}
    return found


def complete(config: Mapping[str, Any]) -> dict[str, Any]:
    """A configuration as a run.toml has it: numbers rounded to the precision that they are used in.

    Raises:
        ValueError: a setting is unknown or of another type.
    """
    return _core.complete_config(dict(config))


def variations(
    id: str, *, seeds: Iterable[int], vary: Mapping[str, Iterable[Any]] | None = None, **options: Any
) -> dict[str, dict[str, Any]]:
    """A configuration for every combination of seeds and settings, by the name that its folder has in `robohive sweep`.

    >>> list(variations("hive/FrankaReach-v0", seeds=[1, 2], vary={"learning.fit.rate": [1e-3, 3e-4]}))
    ['fit.rate=0.001-seed1', 'fit.rate=0.001-seed2', 'fit.rate=0.0003-seed1', 'fit.rate=0.0003-seed2']

    Args:
        id: Id of the environment.
        seeds: Seeds of the runs.
        vary: Values of settings by their paths in a configuration: `{"learning.algorithm.npg.step": [0.05, 0.1]}`.
        options: Those of `configuration`.

    Raises:
        ValueError: there is no such algorithm or setting, or there are more than 1000 runs.
    """
    values = {key: list(each) for key, each in (vary or {}).items()}
    return _core.config_variations(configuration(id, **options), values, list(seeds))


class Run:
    """A training in a folder: an iterator over its iterations, each a dictionary with the columns of the log."""

    def __init__(self, env: RoboHiveEnv, folder: str, core: _core.Run) -> None:
        """`create` and `resume` make runs."""
        self.env = env
        """An environment like those that it learns in."""
        self.folder = folder
        """Where its files are."""
        self._core = core

    @classmethod
    def create(cls, id: str, folder: str | PathLike[str], *, threads: int = 0, **options: Any) -> Run:
        """Begins a run in a new or empty folder.

        Args:
            id: Id of the environment.
            folder: Where its files will be.
            threads: Threads, 0 for as many as there are processors; they make no difference to what is learnt.
            options: Those of `configuration`.

        Raises:
            ValueError: a setting is wrong, the folder is not empty, or the teacher fails.
        """
        return cls.of(configuration(id, **options), folder, threads=threads)

    @classmethod
    def of(cls, config: Mapping[str, Any], folder: str | PathLike[str], *, threads: int = 0) -> Run:
        """Begins a run of a whole `configuration`, as `create` does."""
        env, folder = _environment(config), fspath(folder)
        return cls(env, folder, _core.Run.create(env._core, folder, dict(config), threads))

    @classmethod
    def resume(cls, folder: str | PathLike[str], *, iterations: int | None = None, threads: int = 0) -> Run:
        """Goes on with the run in a folder, from its last checkpoint.

        Args:
            folder: The run's.
            iterations: Iterations in all, if they are to be more than was planned.
            threads: As for `create`.

        Raises:
            ValueError: there is no run, or it is damaged.
        """
        folder = fspath(folder)
        env = _environment(_core.run_config(folder))
        run = cls(env, folder, _core.Run.resume(env._core, folder, threads))
        if iterations is not None:
            run._core.extend(iterations)
        return run

    @staticmethod
    def config_of(folder: str | PathLike[str]) -> dict[str, Any]:
        """What the run in a folder is of: its `configuration`, whole.

        Raises:
            ValueError: there is no run.
        """
        return _core.run_config(folder)

    @property
    def config(self) -> dict[str, Any]:
        """What is trained, and how: its `configuration`, whole."""
        return self.config_of(self.folder)

    @property
    def rows(self) -> list[dict[str, float]]:
        """What each iteration was like, as in log.csv."""
        return _core.run_rows(self.folder)

    @property
    def policy(self) -> str:
        """The file of the policy of the last checkpoint, for `RoboHiveEnv.policy`."""
        return fspath(_core.run_policy(self.folder))

    @property
    def iterations(self) -> int:
        """Iterations made."""
        return self._core.iterations()[0]

    @property
    def is_finished(self) -> bool:
        """Whether all iterations are made."""
        made, planned = self._core.iterations()
        return made >= planned

    def iterate(self) -> dict[str, float]:
        """Makes an iteration and logs it; a checkpoint is kept when it is time for that, or all iterations are made.

        Raises:
            ValueError: a reward is not finite, or a file cannot be written.
        """
        return self._core.iterate()

    def keep(self) -> None:
        """Writes a checkpoint and the policy now."""
        self._core.keep()

    def __iter__(self) -> Iterator[dict[str, float]]:
        """Makes the iterations that are left."""
        while not self.is_finished:
            yield self.iterate()


def _environment(config: Mapping[str, Any]) -> RoboHiveEnv:
    """The environment of a configuration."""
    making = {key: config[key] for key in ("compat", "solver") if config.get(key) is not None}
    return make(config["id"], **making, **config.get("environment", {}))


def _merged(base: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Settings with some changed; dictionaries within them are merged."""
    merged = dict(base)
    for key, value in changes.items():
        below = merged.get(key)
        merged[key] = _merged(below, value) if isinstance(below, dict) and isinstance(value, Mapping) else value
    return merged
