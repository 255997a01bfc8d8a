"""Ids that tests go over: those on models of this project, and those whose models have to be imported."""

from __future__ import annotations

from pathlib import Path

import pytest
import robohive

#: One in five of the ids on models of this project; `robohive check-env` goes over all of them.
OWN = [id for id in robohive.ids() if id.startswith("hive/")][::5]
#: One id of each class of RoboHive's, by its recorded reference.
RECORDED = Path(__file__).parents[2] / "validation" / "reference" / "robohive"
CLASSES = sorted(path.stem for path in RECORDED.glob("*.npz"))


def make_or_skip(id: str, **kwargs: object) -> robohive.envs.RoboHiveEnv:
    """The environment, or a skip that says what is not checked where RoboHive's models are not on this machine."""
    try:
        return robohive.make(id, **kwargs)
    except FileNotFoundError as error:
        if id.startswith("hive/"):
            raise
        pytest.skip(f"not checked: {id} (RoboHive's models are not imported: {error})")
