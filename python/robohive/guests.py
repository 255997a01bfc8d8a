"""Environments on models of other packages, which their users have."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

MODELS = {
    "gymnasium/Ant-v5": "ant.xml",
    "gymnasium/Humanoid-v5": "humanoid.xml",
    "gymnasium/Walker2d-v5": "walker2d_v5.xml",
    "gymnasium/HalfCheetah-v5": "half_cheetah.xml",
    "gymnasium/Hopper-v5": "hopper.xml",
}


def with_model(env_id: str, settings: dict[str, Any]) -> dict[str, Any]:
    """Settings with `model_path`, where an id needs a model of the installed package gymnasium and none is named."""
    file = MODELS.get(env_id)
    if file is None or "model_path" in settings:
        return settings
    package = importlib.util.find_spec("gymnasium")
    for folder in (package and package.submodule_search_locations) or ():
        path = Path(folder, "envs", "mujoco", "assets", file).resolve()
        if path.is_file():
            return {**settings, "model_path": str(path)}
    return settings
