"""Trains many runs on all nodes of a Ray cluster."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from typing import Any

import ray

from robohive.training import Run, complete


def train(
    configurations: Mapping[str, Mapping[str, Any]],
    folder: str | os.PathLike[str],
    *,
    cpus_per_run: int = 1,
    attempts: int = 20,
    options: Mapping[str, Any] | None = None,
) -> Iterator[tuple[str, dict[str, float]]]:
    """Trains each configuration on some node, and yields its name and the last row of its log when its files are here.

    A run ends in the bits that it has on one machine. One whose node dies begins again on another; runs that are in the folder
    already are not made again. `ray.init` comes before the first run is asked for.

    >>> from robohive.training import variations                                       # doctest: +SKIP
    >>> runs = variations("hive/FrankaReach-v0", seeds=range(3), iterations=100)        # doctest: +SKIP
    >>> for name, row in train(runs, "sweep"):                                         # doctest: +SKIP
    ...     print(name, row["success_percentage"])

    Args:
        configurations: Each a `robohive.training.configuration`, by the name of its folder. A teacher that is a file has to be
            there on every node.
        folder: Where the folders of the runs will be, for `robohive report`.
        cpus_per_run: Processors of a run, and its threads.
        attempts: How often a run may be lost with its node.
        options: Options of the tasks for Ray, as `{"resources": {…}, "runtime_env": {…}}`.

    Raises:
        ValueError: a folder holds a run of another configuration, or a run fails by a setting that is wrong.
    """
    root = os.fspath(folder)
    os.makedirs(root, exist_ok=True)
    left = {name: dict(config) for name, config in configurations.items() if not _is_there(os.path.join(root, name), config)}
    task = ray.remote(_learn).options(
        num_cpus=cpus_per_run, max_retries=attempts, scheduling_strategy="SPREAD", **dict(options or {})
    )
    waiting = {task.remote(config, cpus_per_run): name for name, config in left.items()}
    while waiting:
        (done,), _ = ray.wait(list(waiting), num_returns=1)
        name = waiting.pop(done)
        files, row = ray.get(done)
        _write(os.path.join(root, name), files)
        yield name, row


def _is_there(folder: str, config: Mapping[str, Any]) -> bool:
    """Whether the run is in its folder."""
    if not os.path.exists(folder):
        return False
    found = Run.config_of(folder)
    if found != complete(config):
        raise ValueError(f"{folder} holds a run of another configuration: name another folder, or remove it")
    return True


def _learn(config: Mapping[str, Any], threads: int) -> tuple[dict[str, bytes], dict[str, float]]:
    """Makes a run, and gives its files and the last row of its log."""
    with tempfile.TemporaryDirectory() as place:
        run = Run.of(config, os.path.join(place, "run"), threads=threads)
        row = {}
        for row in run:
            pass
        run.keep()
        files = {}
        for name in os.listdir(run.folder):
            with open(os.path.join(run.folder, name), "rb") as file:
                files[name] = file.read()
        return files, row


def _write(folder: str, files: Mapping[str, bytes]) -> None:
    """Writes the files of a run, all at once."""
    unfinished = f"{folder}.unfinished"
    shutil.rmtree(unfinished, ignore_errors=True)
    os.makedirs(unfinished)
    for name, content in files.items():
        with open(os.path.join(unfinished, name), "wb") as file:
            file.write(content)
    os.replace(unfinished, folder)
