"""`Renderer`: pictures without a display or a GPU."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from robohive.mujoco import _engine as _core
from robohive.mujoco.enums.elements import mjtObj
from robohive.mujoco.enums.view import mjtCamera, mjtRndFlag
from robohive.mujoco.pictures.context import drawn
from robohive.mujoco.pictures.looking import checked, look_of
from robohive.mujoco.pictures.scene import MjvScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption, mjv_defaultFreeCamera
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.whole_numbers import whole


class Renderer:
    """Draws pictures of simulations of one model, by the engine's own renderer.

    `scene` takes geoms and flags of the program between `update_scene` and `render`: `max_geom` is how many geoms it has
    room for, those of the model included. `font_scale` is accepted and has no effect: letters of labels have one size.
    """

    def __init__(
        self, model: MjModel, height: int = 240, width: int = 320, max_geom: int = 10000, font_scale: Any = None
    ) -> None:
        """Pictures of `height` and `width` pixels.

        Raises:
            ValueError: they are no sizes, or exceed `offwidth` or `offheight` of the model.
        """
        height, width = whole("height", height, 1), whole("width", width, 1)
        max_geom = whole("max_geom", max_geom)
        sizes = model.vis.global_
        for name, asked, most in (("width", width, sizes.offwidth), ("height", height, sizes.offheight)):
            if asked > most:
                raise ValueError(
                    f'Image {name} {asked} > framebuffer {name} {most}. Give the model <visual><global off{name}="{asked}"/></visual>'
                )
        self._model, self._height, self._width = model, height, width
        self._scene: MjvScene | None = MjvScene(model, max_geom)
        self._scene._painter = _core.Painter(width, height)
        self._channel = "rgb"
        self._scene_option = MjvOption()

    @property
    def model(self) -> MjModel:
        """The model."""
        return self._model

    @property
    def height(self) -> int:
        """Rows of a picture."""
        return self._height

    @property
    def width(self) -> int:
        """Columns of a picture."""
        return self._width

    def enable_depth_rendering(self) -> None:
        """`render` returns distances from the camera's plane [m]."""
        self._channel = "depth"

    def disable_depth_rendering(self) -> None:
        """`render` returns colours."""
        self._channel = "rgb"

    def enable_segmentation_rendering(self) -> None:
        """`render` returns number and type of the object seen."""
        self._channel = "segmentation"

    def disable_segmentation_rendering(self) -> None:
        """`render` returns colours."""
        self._channel = "rgb"

    def update_scene(
        self, data: MjData, camera: int | str | MjvCamera = -1, scene_option: MjvOption | None = None
    ) -> None:
        """Takes in what is seen of a simulation, whose poses must have been computed.

        Args:
            data: the simulation.
            camera: a name or number of the model's cameras, -1 for the free one, or a camera of one's own.
            scene_option: what is visible.

        Raises:
            ValueError: there is no such camera.
        """
        look = look_of(self._model, self._camera(camera), scene_option or self._scene_option)
        self.scene._look(self._model, data, look)

    def _camera(self, camera: int | str | MjvCamera) -> MjvCamera:
        if isinstance(camera, MjvCamera):
            return camera
        chosen, number = MjvCamera(), camera
        if isinstance(camera, str):
            number = self._model._id(mjtObj.mjOBJ_CAMERA, camera)
            if number < 0:
                raise ValueError(f'The camera "{camera}" does not exist.')
        elif camera == -1:
            mjv_defaultFreeCamera(self._model, chosen)
            return chosen
        chosen.type, chosen.fixedcamid = mjtCamera.mjCAMERA_FIXED, checked(self._model, int(number))
        return chosen

    @property
    def scene(self) -> MjvScene:
        """What is drawn: geoms, to which a program may add, and flags.

        Raises:
            RuntimeError: the renderer is closed.
        """
        if self._scene is None:
            raise RuntimeError("this Renderer is closed")
        return self._scene

    def render(self, *, out: NDArray[Any] | None = None) -> NDArray[Any]:
        """The picture: colours `(height, width, 3)` uint8, distances `(height, width)` float32 [m], or objects
        `(height, width, 2)` int32, number and type, -1 for none.

        Raises:
            RuntimeError: nothing was looked at yet, or the renderer is closed.
            ValueError: `out` has another shape.
        """
        picture = self._picture(self.scene)
        if out is None:
            return picture
        if out.shape != picture.shape:
            raise ValueError(f"out has the shape {out.shape}, the picture {picture.shape}")
        np.copyto(out, picture, casting="unsafe")
        return out

    def _picture(self, scene: MjvScene) -> NDArray[Any]:
        flagged = self._channel == "rgb" and scene.flags[[mjtRndFlag.mjRND_SEGMENT, mjtRndFlag.mjRND_DEPTH]].any()
        if not flagged and not scene._guests():
            return scene._painter.draw(self._channel, scene._effects())
        return drawn(scene, (self._width, self._height))[("rgb", "depth", "segmentation").index(self._channel)]

    def close(self) -> None:
        """Frees the memory."""
        self._scene = None

    def __enter__(self) -> "Renderer":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()
