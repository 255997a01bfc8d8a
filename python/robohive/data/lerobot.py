"""Datasets of LeRobot, version 3.0: written without LeRobot or pyarrow, loaded by ``LeRobotDataset``."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from robohive import _core
from robohive.data._arrays import Array, pack, unpack
from robohive.data.episode import Episode
from robohive.data.errors import DataError
from robohive.data.progress import Exported, Progress
from robohive.data.trace import StrPath

Pictures = Literal["video", "png"]


class LeRobotWriter:
    """Writes a dataset, episode by episode, in a hidden folder that gets its name when the context ends without an exception.

    Example:
        >>> with LeRobotWriter("door", fps=25) as writer:  # doctest: +SKIP
        ...     writer.add({"observation.state": states, "action": actions}, task="open the door")
        >>> LeRobotDataset("robohive/door", root="door")  # doctest: +SKIP
    """

    def __init__(self, root: StrPath, *, fps: float, robot: str | None = None, pictures: Pictures = "video"):
        """Begins a dataset.

        Args:
            root: its folder, which must not exist.
            fps: frames a second.
            robot: the robot, in a word.
            pictures: ``"video"`` keeps them in H.264 MP4 files, which lose little; ``"png"`` in the tables, without loss.

        Raises:
            FileExistsError: the folder exists.
        """
        self.root = Path(root)
        self._file = _core.LeRobotWriter(self.root, float(fps), robot, pictures)

    def add(self, features: Mapping[str, npt.ArrayLike], task: str) -> None:
        """Adds an episode.

        Args:
            features: of each feature, such as ``observation.state`` and ``action``, an array whose first axis counts frames. Arrays
                of uint8 of shape ``[n, height, width, 3]`` are pictures. LeRobot's policies take float32.
            task: what the episode is an attempt at, in words.

        Raises:
            DataError: features are not those of the first episode, or have different numbers of frames.
        """
        self._file.add([(key, pack(values)) for key, values in features.items()], task)

    def add_episode(self, episode: Episode, task: str | None = None) -> None:
        """Adds the steps of an episode with one array of observations: ``observation.state``, ``action``, ``next.reward`` and
        ``next.done``, numbers as float32.

        Raises:
            DataError: observations or actions are not one array.
        """
        steps = len(episode)
        if isinstance(episode.observations, Mapping) or isinstance(episode.actions, Mapping):
            raise DataError("observations and actions must be arrays: name features of a mapping with add()")
        features = {
            "observation.state": np.asarray(episode.observations)[:steps].astype(np.float32),
            "action": np.asarray(episode.actions).astype(np.float32),
            "next.reward": np.asarray(episode.rewards).astype(np.float32),
            "next.done": np.asarray(episode.terminations, dtype=bool),
        }
        self.add(features, task or episode.task or "unknown")

    def finish(self) -> None:
        """Completes the dataset and gives it its name."""
        self._file.finish()

    def discard(self) -> None:
        """Removes what was written."""
        self._file.discard()

    def __enter__(self) -> LeRobotWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.finish()
        else:
            self.discard()


def export_lerobot(
    source: StrPath,
    root: StrPath,
    *,
    task: str | None = None,
    robot: str | None = None,
    fps: float | None = None,
    pictures: Pictures = "video",
    progress: Progress | None = None,
) -> Exported:
    """Makes a dataset of all trials of a recording in RoboHive's layout.

    A frame is a step: ``observation.state``, ``observation.images.CAMERA`` of every camera, ``action``, ``next.reward``,
    ``next.done``, and ``next.success`` where the recording says what is solved. Numbers become float32. The state after the last
    step has no frame.

    Args:
        source: the recording, as of ``robohive run --record``.
        root: folder of the dataset, which must not exist.
        task: what the episodes are attempts at, in words; the environment's id if nothing is said.
        robot: the robot, in a word.
        fps: frames a second; as recorded if nothing is said.
        pictures: as for :class:`LeRobotWriter`.
        progress: called after every episode.

    Raises:
        FileNotFoundError: there is no ``source``.
        FileExistsError: the folder exists.
        DataError: ``source`` is damaged, or a trial has no steps or lacks a name.
    """
    about = (task, robot, None if fps is None else float(fps))
    episodes, steps, at, dropped = _core.export_lerobot(Path(source), Path(root), about, pictures, progress)
    return Exported(episodes, steps, Path(at), dict(dropped))


class LeRobotFrames(Sequence[dict[str, Any]]):
    """A dataset on disk: of each episode its features, without videos. Only its tables of episodes are read before.

    ``frames[i]`` maps names of features to arrays whose first axis counts frames; pictures of the tables are lists of the bytes of
    PNG files.
    """

    def __init__(self, root: StrPath):
        """Opens the dataset in a folder.

        Raises:
            FileNotFoundError: there is no such folder.
            DataError: a file is missing or damaged, or the dataset is not of version 3.
        """
        self._file = _core.LeRobotFrames(Path(root))
        self.info: dict[str, Any] = json.loads(self._file.info())
        """What ``meta/info.json`` says."""

    def __len__(self) -> int:
        return self._file.episodes()

    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"no episode {index}: the dataset has {len(self)}")
        read = self._file.read(index % len(self))
        return {key: unpack(value) if isinstance(value, tuple) else value for key, value in read.items()}

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (self[i] for i in range(len(self)))

    def episode(self, index: int) -> Episode:
        """An episode with its ``observation.state``, ``action`` and rewards; observations have no row after the last step.

        Raises:
            DataError: the frames have no ``observation.state`` or no ``action``.
        """
        frames = self[index]
        for name in ("observation.state", "action"):
            if name not in frames:
                raise DataError(f"the frames have no {name}, but {', '.join(frames)}")
        steps = len(frames["action"])

        def one(names: Sequence[str], default: Array) -> Array:
            return next((frames[name] for name in names if name in frames), default)

        done = one(("next.done", "done"), np.zeros(steps, dtype=bool)).astype(bool)
        truncations = np.zeros(steps, dtype=bool)
        truncations[-1] = not done[-1]
        return Episode(
            observations=frames["observation.state"],
            actions=frames["action"],
            rewards=one(("next.reward", "reward"), np.zeros(steps, dtype=np.float32)),
            terminations=done,
            truncations=truncations,
            task=self._file.task(int(frames["task_index"][0])),
        )

    def episode_task(self, index: int) -> str | None:
        """What an episode is an attempt at, in words."""
        return self._file.task(int(self[index]["task_index"][0]))
