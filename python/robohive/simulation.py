"""The model and the simulation of an environment, to read under MuJoCo's names."""

from __future__ import annotations

from typing import Any

import numpy as np

from robohive import _core
from robohive.whole_numbers import whole


class Simulation:
    """`env.sim` of RoboHive, to read: every array is a copy that cannot be written, so that no write is lost.

    States are written by `set_env_state`; models are changed by settings. Stepping, options and contacts of a simulation are
    in `robohive.mujoco`.
    """

    def __init__(self, core: _core.Env) -> None:
        self.model = Model(core)
        self.data = Arrays(core, "data")
        self.renderer = Renderer(core)


class Arrays:
    """Arrays by name."""

    def __init__(self, core: _core.Env, of: str) -> None:
        self._core = core
        self._of = of

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        value = self._core.array(self._of, name)
        if value is None:
            raise AttributeError(f"the {self._of} has no array {name}")
        if isinstance(value, np.ndarray):
            if value.shape == (1,) and (name == "time" or self._of == "option"):
                return value[0].item()
            value.flags.writeable = False
        return value

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in ("_core", "_of"):
            raise AttributeError(f"{name} is to read; set_env_state writes states")
        super().__setattr__(name, value)


class Model(Arrays):
    """Arrays and sizes of the model, and ids of its elements by their names."""

    def __init__(self, core: _core.Env) -> None:
        super().__init__(core, "model")

    @property
    def opt(self) -> Arrays:
        """Options of the simulation."""
        return Arrays(self._core, "option")

    def _id(self, kind: str, name: str) -> int:
        return self._core.element(kind, name)

    def body_name2id(self, name: str) -> int:
        """Id of a body."""
        return self._id("body", name)

    def joint_name2id(self, name: str) -> int:
        """Id of a joint."""
        return self._id("joint", name)

    def geom_name2id(self, name: str) -> int:
        """Id of a geom."""
        return self._id("geom", name)

    def site_name2id(self, name: str) -> int:
        """Id of a site."""
        return self._id("site", name)

    def camera_name2id(self, name: str) -> int:
        """Id of a camera."""
        return self._id("camera", name)

    def actuator_name2id(self, name: str) -> int:
        """Id of an actuator."""
        return self._id("actuator", name)

    def sensor_name2id(self, name: str) -> int:
        """Id of a sensor."""
        return self._id("sensor", name)


class Renderer:
    """Pictures of the present state."""

    def __init__(self, core: _core.Env) -> None:
        self._core = core

    def render_offscreen(
        self,
        width: int,
        height: int,
        camera_id: int | str | None = None,
        rgb: bool = True,
        depth: bool = False,
        segmentation: bool = False,
        device_id: int = -1,
    ) -> Any:
        """Colours (height x width x 3 bytes), depths [m] (height x width), or both as a pair.

        Args:
            width: Columns.
            height: Rows.
            camera_id: Name or number of a camera; -1, `free` or None is the free one.
            rgb: Whether colours are returned.
            depth: Whether depths are returned.
            segmentation: Not drawn for Python.
            device_id: Of no effect; pictures need no GPU.

        Raises:
            ValueError: the model has no such camera, or the size is impossible.
            NotImplementedError: `segmentation`.
        """
        if segmentation:
            raise NotImplementedError("segmentation is drawn by `robohive render --segmentation`, not for Python")
        camera = "free" if camera_id in (None, -1) else camera_id
        if not isinstance(camera, str):
            camera = self._core.camera_name(whole("camera_id", camera))
        size = whole("width", width, 1), whole("height", height, 1)
        colours, depths = self._core.draw(camera, *size, depth)
        return (colours, depths) if rgb and depth else depths if depth else colours

