"""Pictures of trajectories."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco._functions import mj_forward
from robohive.mujoco.enums.physics import mjtState
from robohive.mujoco.enums.view import mjtCatBit
from robohive.mujoco.functions.algebra import mj_setState
from robohive.mujoco.pictures.scene import MjvScene, mjv_updateScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption, mjv_defaultFreeCamera
from robohive.mujoco.renderer import Renderer
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel

Vector = NDArray[np.float64]

#: The group of geoms that is shown beside the usual ones.
_SHOWN_TOO = 3
_COPIED = ("type", "dataid", "objtype", "objid", "size", "pos", "mat", "rgba")


def render_rollout(
    model: MjModel | Sequence[MjModel],
    data: MjData,
    state: Vector,
    framerate: int,
    camera: str | int = -1,
    width: int = 640,
    height: int = 480,
    light_pos: Sequence[float] | None = None,
) -> list[NDArray[np.uint8]]:
    """Pictures of one trajectory, or of several in one picture.

    Args:
        model: one for all, or one for each; sizes and meshes are those of the first.
        data: room for the states.
        state: of signature `mjSTATE_FULLPHYSICS`, `(nbatch, nstep, nstate)`, at the steps of the first model.
        framerate: pictures in a second.
        camera: a name or number of the first model's cameras, -1 for the free one.
        width: columns of a picture.
        height: rows of a picture.
        light_pos: not there.

    Returns:
        Pictures, each `(height, width, 3)`.

    Raises:
        NotImplementedError: a light is given.
        ValueError: there are neither one model nor as many as trajectories, or no such camera.
    """
    if light_pos is not None:
        raise NotImplementedError(
            "a scene has the lights of its model: add a light to the description instead of light_pos"
        )
    models = [model] if isinstance(model, MjModel) else list(model)
    if len(models) not in (1, len(state)):
        raise ValueError(f"{len(state)} trajectories need one model or {len(state)}, not {len(models)}")
    models = models * len(state) if len(models) == 1 else models
    option = MjvOption()
    option.geomgroup[_SHOWN_TOO] = 1
    dt = float(models[0].opt.timestep)
    pictures: list[NDArray[np.uint8]] = []
    with Renderer(models[0], height, width) as renderer:
        for step in range(state.shape[1]):
            if len(pictures) >= step * dt * framerate:
                continue
            for number, (shown, row) in enumerate(zip(models, state[:, step], strict=True)):
                mj_setState(shown, data, row, mjtState.mjSTATE_FULLPHYSICS)
                mj_forward(shown, data)
                if number == 0:
                    renderer.update_scene(data, camera, option)
                else:
                    _add(renderer.scene, shown, data, option)
            pictures.append(renderer.render())
    return pictures


def _add(scene: MjvScene, model: MjModel, data: MjData, option: MjvOption) -> None:
    """Puts what moves in another model into a scene, as far as there is room."""
    free = MjvCamera()
    mjv_defaultFreeCamera(model, free)
    other = MjvScene(model, scene.maxgeom)
    mjv_updateScene(model, data, option, None, free, int(mjtCatBit.mjCAT_DYNAMIC), other)
    for geom in other.geoms[: min(other.ngeom, scene.maxgeom - scene.ngeom)]:
        place = scene.geoms[scene.ngeom]
        for name in _COPIED:
            setattr(place, name, getattr(geom, name))
        scene.ngeom += 1
