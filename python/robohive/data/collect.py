"""Collecting episodes as an environment runs; needs Gymnasium."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import gymnasium
import numpy as np

from robohive.data.episode import Episode


class Sink(Protocol):
    """What takes episodes: :class:`~robohive.data.MinariWriter`, :class:`~robohive.data.Recorder`."""

    def add(self, episode: Episode) -> None:
        """Takes an episode."""


def _stack(values: list[Any]) -> Any:
    first = values[0]
    if isinstance(first, dict):
        return {key: _stack([value[key] for value in values]) for key in first}
    if isinstance(first, tuple):
        return tuple(_stack([value[i] for value in values]) for i in range(len(first)))
    return np.stack([np.asarray(value) for value in values])


def _numbers(infos: list[dict[str, Any]], prefix: str = "") -> dict[str, Any]:
    """Flat names and arrays of what every info has with one shape and dtype; other entries are no data of a dataset."""
    out: dict[str, Any] = {}
    for key, first in infos[0].items():
        values = [info.get(key) for info in infos]
        if isinstance(first, dict):
            if all(isinstance(value, dict) for value in values):
                out.update(_numbers([value or {} for value in values], f"{prefix}{key}/"))
            continue
        arrays = [np.asarray(value) for value in values]
        if arrays[0].dtype.kind in "biuf" and all(
            (array.shape, array.dtype) == (arrays[0].shape, arrays[0].dtype) for array in arrays
        ):
            out[prefix + key] = np.stack(arrays)
    return out


class Collector(gymnasium.Wrapper[Any, Any, Any, Any]):
    """An environment whose episodes go to a writer when they end.

    An episode that is reset or closed before its end is written too, as truncated. An autoreset environment resets itself: wrap the
    environment inside it.

    Example:
        >>> with MinariWriter("robohive/door/random-v0", env=env) as writer:  # doctest: +SKIP
        ...     env = Collector(env, writer)
        ...     env.reset(seed=1)
    """

    def __init__(self, env: gymnasium.Env[Any, Any], writer: Sink, *, infos: bool = False, on_episode: Callable[[int], object] | None = None):
        """Wraps an environment.

        Args:
            env: the environment.
            writer: takes the episodes.
            infos: whether entries of the infos are kept that are numbers of one shape in every step.
            on_episode: called with the number of episodes after each of them.
        """
        super().__init__(env)
        self._writer = writer
        self._keep_infos = infos
        self._on_episode = on_episode
        self._count = 0
        self._clear(None)

    def _clear(self, seed: int | None) -> None:
        self._seed = seed
        self._observations: list[Any] = []
        self._actions: list[Any] = []
        self._results: list[tuple[float, bool, bool]] = []
        self._infos: list[dict[str, Any]] = []

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Resets the environment; an episode that did not end is written as truncated."""
        self._finish()
        observation, info = self.env.reset(seed=seed, options=options)
        self._clear(seed)
        self._note(observation, info)
        return observation, info

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Steps the environment; at its end the episode is written."""
        observation, reward, terminated, truncated, info = self.env.step(action)
        if self._observations:
            self._actions.append(_copied(action))
            self._results.append((float(reward), bool(terminated), bool(truncated)))
            self._note(observation, info)
            if terminated or truncated:
                self._finish()
        return observation, reward, terminated, truncated, info

    def close(self) -> None:
        """Writes an episode that did not end, as truncated, and closes the environment. The writer stays open."""
        self._finish()
        super().close()

    def _note(self, observation: Any, info: dict[str, Any]) -> None:
        self._observations.append(_copied(observation))
        self._infos.append(_copied(info) if self._keep_infos else {})

    def _finish(self) -> None:
        if not self._results:
            self._clear(None)
            return
        rewards, terminations, truncations = (np.array(column) for column in zip(*self._results))
        truncations[-1] |= not terminations[-1]
        episode = Episode(
            observations=_stack(self._observations),
            actions=_stack(self._actions),
            rewards=rewards,
            terminations=terminations,
            truncations=truncations,
            infos=_numbers(self._infos),
            seed=self._seed,
        )
        self._clear(None)
        self._writer.add(episode)
        self._count += 1
        if self._on_episode is not None:
            self._on_episode(self._count)


def _copied(value: Any) -> Any:
    """A copy, of which an environment that reuses its arrays changes nothing."""
    if isinstance(value, dict):
        return {key: _copied(inner) for key, inner in value.items()}
    if isinstance(value, tuple):
        return tuple(_copied(inner) for inner in value)
    return np.array(value) if isinstance(value, np.ndarray) else value
