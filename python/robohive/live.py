"""Robots that are hardware: what `is_hardware=True` and its companions ask for."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Ready = Callable[[NDArray[np.float64]], object]


def ask(qpos: NDArray[np.float64]) -> None:
    """Waits at the terminal for a person who prepares an episode."""
    input("the robot stands at the start of an episode; put everything in place and press Enter ")


def asked(
    is_hardware: bool,
    settings: dict[str, Any],
    robot_config: str | os.PathLike[str] | None,
    arm: bool,
    dry_run: bool,
    rehearse: bool,
    flight: str | os.PathLike[str] | None,
    ready: Ready | None,
) -> dict[str, Any] | None:
    """What the robot's devices are, for Rust; `None` in simulation. Takes `config_path` out of the settings where it names a
    file of this machine, as it does in RoboHive.

    Raises:
        ValueError: arguments that exclude each other, or are about devices where there are none.
    """
    given = {
        "robot_config": robot_config is not None,
        "arm": arm,
        "dry_run": dry_run,
        "rehearse": rehearse,
        "flight": flight is not None,
        "ready": ready is not None,
    }
    if not is_hardware:
        unused = [name for name, is_given in given.items() if is_given]
        if unused:
            raise ValueError(f"{unused[0]} is about devices: give is_hardware=True with it")
        return None
    if arm and dry_run:
        raise ValueError("arm=True lets the devices move, and dry_run=True sends them nothing: choose one")
    if rehearse and flight is not None:
        raise ValueError("flight keeps what real devices do; rehearse=True has none")
    config = robot_config
    path = settings.get("config_path")
    if config is None and path is not None and os.path.isfile(path):
        config = settings.pop("config_path")
    if ready is None and not rehearse:
        ready = ask
    return {
        "config": None if config is None else os.fspath(config),
        "arm": arm,
        "dry_run": dry_run,
        "rehearse": rehearse,
        "flight": None if flight is None else os.fspath(flight),
        "ready": ready,
    }
