"""Datasets of Minari: written without Minari or h5py, loaded by ``minari.load_dataset``."""

from __future__ import annotations

import importlib
import importlib.util
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

from robohive import _core
from robohive.data._arrays import Array, pack
from robohive.data.episode import Episode, leaves, nested
from robohive.data.errors import DataError
from robohive.data.progress import Exported, Progress
from robohive.data.spaces import space_to_json
from robohive.data.trace import Recording, StrPath


def minari_root() -> Path:
    """The folder of datasets: ``$MINARI_DATASETS_PATH``, or ``~/.minari/datasets``."""
    chosen = os.environ.get("MINARI_DATASETS_PATH")
    return Path(chosen) if chosen else Path.home() / ".minari" / "datasets"


def env_spec(env_id: str) -> str:
    """The JSON of Gymnasium's ``EnvSpec`` of an id: the registered one, or one by which Gymnasium makes the environment of this
    package."""
    if importlib.util.find_spec("gymnasium") is not None:
        known = importlib.import_module("gymnasium").registry.get(env_id)
        if known is not None:
            return str(known.to_json())
    return _core.env_spec(env_id)


def _metadata(entries: Mapping[str, Any]) -> str:
    out = dict(entries)
    for key in ("author", "author_email"):
        if isinstance(out.get(key), str):
            out[key] = [out[key]]
        elif key in out:
            out[key] = sorted(out[key])
    return json.dumps(out)


class MinariWriter:
    """Writes a dataset, episode by episode; after every one of them it is complete, whatever ends the process.

    Example:
        >>> with MinariWriter("robohive/door/random-v0", env=env) as writer:  # doctest: +SKIP
        ...     writer.add(episode)
        >>> minari.load_dataset("robohive/door/random-v0")  # doctest: +SKIP
    """

    def __init__(
        self,
        dataset_id: str,
        *,
        env: Any = None,
        observation_space: Any = None,
        action_space: Any = None,
        root: StrPath | None = None,
        **metadata: Any,
    ):
        """Makes a dataset.

        Args:
            dataset_id: name with a version, such as ``robohive/door/random-v0``.
            env: a Gymnasium environment, which gives the spaces and the spec, or an id, which gives the spec.
            observation_space: space of the observations, if not that of ``env``.
            action_space: space of the actions, if not that of ``env``.
            root: the folder of datasets; :func:`minari_root` if nothing is said.
            metadata: further entries that Minari knows: ``author``, ``author_email``, ``algorithm_name``, ``description``,
                ``code_permalink``, ``requirements``, ``ref_min_score``, ``ref_max_score``.

        Raises:
            ValueError: the id is none, or there is no space.
            FileExistsError: the dataset exists.
        """
        described = None if isinstance(env, str) else env
        observations = observation_space or getattr(described, "observation_space", None)
        actions = action_space or getattr(described, "action_space", None)
        if observations is None or actions is None:
            raise ValueError("a space is missing: give env, or observation_space and action_space")
        spec = env_spec(env) if isinstance(env, str) else None
        if getattr(described, "spec", None) is not None:
            spec = described.spec.to_json()  # type: ignore[union-attr]
        root = minari_root() if root is None else Path(root)
        spaces = (space_to_json(observations), space_to_json(actions))
        self._file = _core.MinariWriter(root, dataset_id, spaces, spec, _metadata(metadata))
        self.folder = Path(self._file.folder())
        """The folder that holds the files."""

    def add(self, episode: Episode) -> None:
        """Adds an episode.

        Raises:
            DataError: parts are missing, have other shapes than those of the first episode, or wrong lengths.
        """
        parts = {
            "observations": episode.observations,
            "actions": episode.actions,
            "rewards": episode.rewards,
            "terminations": episode.terminations,
            "truncations": episode.truncations,
        }
        flat = [leaf for name, tree in parts.items() for leaf in leaves(name, tree)]
        flat += [(f"infos/{key}", array) for key, array in episode.infos.items()]
        self._file.add([(key, pack(array)) for key, array in flat], episode.seed)

    def close(self) -> None:
        """Completes the dataset, and waits until the disk has it."""
        self._file.close()

    def __enter__(self) -> MinariWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def export_minari(
    source: StrPath,
    dataset_id: str,
    *,
    env: Any = None,
    infos: bool = True,
    root: StrPath | None = None,
    progress: Progress | None = None,
    **metadata: Any,
) -> Exported:
    """Makes a dataset of all trials of a recording in RoboHive's layout.

    Args:
        source: the recording, as of ``robohive run --record``.
        dataset_id: name with a version, such as ``robohive/door/random-v0``.
        env: a Gymnasium environment, which gives the spaces and the spec; or its id, which gives the spec, and without which the
            recording's own is taken. Without an environment the spaces have no limits.
        infos: whether what is neither observation, action nor reward is kept.
        root: the folder of datasets; :func:`minari_root` if nothing is said.
        progress: called after every episode.
        metadata: as for :class:`MinariWriter`.

    Raises:
        FileNotFoundError: there is no ``source``.
        FileExistsError: the dataset exists.
        DataError: ``source`` is damaged, or a trial has no steps or lacks a name.
    """
    spaces: list[str | None] = [None, None]
    if env is None:
        name = Recording(source).attributes.get("env")
        spec = None if name is None else env_spec(name)
    elif isinstance(env, str):
        spec = env_spec(env)
    else:
        spec = None if env.spec is None else env.spec.to_json()
        spaces = [space_to_json(env.observation_space), space_to_json(env.action_space)]
    entries = (spaces[0], spaces[1], spec, _metadata(metadata))
    folder = minari_root() if root is None else Path(root)
    episodes, steps, at, dropped = _core.export_minari(Path(source), folder, dataset_id, infos, entries, progress)
    return Exported(episodes, steps, Path(at), dict(dropped))


class MinariDataset(Sequence[Episode]):
    """A dataset on disk: its episodes, each read when it is asked for.

    Datasets that this package wrote are read without Minari. Those that Minari wrote need it: their groups are kept in a form
    that is not read here.
    """

    def __init__(self, dataset: str, root: StrPath | None = None):
        """Opens a dataset.

        Args:
            dataset: its id, or its folder.
            root: the folder of datasets; :func:`minari_root` if nothing is said.

        Raises:
            FileNotFoundError: there is no such dataset.
            DataError: its metadata are damaged.
        """
        folder = (minari_root() if root is None else Path(root)) / dataset
        self.folder = folder / "data" if (folder / "data").is_dir() else folder
        path = self.folder / "metadata.json"
        if not path.exists():
            raise FileNotFoundError(f"{path}: no such file: {dataset} is no dataset of {folder.parent}")
        try:
            self.metadata: dict[str, Any] = json.loads(path.read_text())
            self._count = int(self.metadata["total_episodes"])
        except (ValueError, KeyError, TypeError) as error:
            raise DataError(f"{path}: damaged: {error!r}") from error
        self._own: Recording | None = None
        self._foreign: Any = None
        try:
            self._own = Recording(self.folder / "main_data.hdf5")
        except DataError as error:
            self._foreign = self._with_minari(error)

    def _with_minari(self, error: DataError) -> Any:
        try:
            minari = importlib.import_module("minari")
        except ImportError:
            raise DataError(f"{error}; `pip install minari[hdf5]` reads what Minari wrote") from error
        return minari.MinariDataset(self.folder)

    def __len__(self) -> int:
        return self._count

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"no episode {index}: the dataset has {len(self)}")
        index = index % len(self)
        return self._read(index) if self._own is not None else self._read_foreign(index)

    def __iter__(self) -> Iterator[Episode]:
        return (self[i] for i in range(len(self)))

    def _read(self, index: int) -> Episode:
        assert self._own is not None
        trial = self._own[f"episode_{index}"]
        flat = {key: dataset.read() for key, dataset in trial.items()}

        def part(name: str) -> Any:
            if name in flat:
                return flat[name]
            inner = {key[len(name) + 1 :]: array for key, array in flat.items() if key.startswith(f"{name}/")}
            if not inner:
                raise DataError(f"{self.folder / 'main_data.hdf5'}, \"episode_{index}/{name}\": missing")
            return nested(inner)

        infos = {key[6:]: array for key, array in flat.items() if key.startswith("infos/")}
        return Episode(
            observations=part("observations"),
            actions=part("actions"),
            rewards=part("rewards"),
            terminations=part("terminations"),
            truncations=part("truncations"),
            infos=infos,
            seed=trial.integers.get("seed"),
        )

    def _read_foreign(self, index: int) -> Episode:
        data = self._foreign[index]
        about = next(iter(self._foreign.storage.get_episode_metadata([index])))
        infos: dict[str, Array] = {}
        for key, value in (data.infos or {}).items():
            infos.update(leaves(key, value))
        return Episode(
            observations=data.observations,
            actions=data.actions,
            rewards=data.rewards,
            terminations=data.terminations,
            truncations=data.truncations,
            infos=infos,
            seed=about.get("seed"),
        )
