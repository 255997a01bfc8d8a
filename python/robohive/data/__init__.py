"""Recordings of episodes, and datasets made of them.

| what | written | read |
|---|---|---|
| RoboHive's and RoboSet's HDF5 | :class:`Recorder` | :func:`open` |
| Minari | :class:`MinariWriter`, :func:`export_minari` | :class:`MinariDataset` |
| LeRobot v3 | :class:`LeRobotWriter`, :func:`export_lerobot` | :class:`LeRobotFrames` |

All of it is done by the extension module; numpy alone is needed. :class:`robohive.data.collect.Collector` records a Gymnasium
environment as it runs.
"""

from robohive.data.episode import Episode
from robohive.data.errors import DataError
from robohive.data.lerobot import LeRobotFrames, LeRobotWriter, export_lerobot
from robohive.data.minari import MinariDataset, MinariWriter, export_minari, minari_root
from robohive.data.progress import Exported, Progress
from robohive.data.trace import (
    Converted,
    Dataset,
    Recorder,
    Recording,
    Repaired,
    Trial,
    TrialWriter,
    convert,
    open,
    repair,
)

__all__ = [
    "Converted",
    "DataError",
    "Dataset",
    "Episode",
    "Exported",
    "LeRobotFrames",
    "LeRobotWriter",
    "MinariDataset",
    "MinariWriter",
    "Progress",
    "Recorder",
    "Recording",
    "Repaired",
    "Trial",
    "TrialWriter",
    "convert",
    "export_lerobot",
    "export_minari",
    "minari_root",
    "open",
    "repair",
]
