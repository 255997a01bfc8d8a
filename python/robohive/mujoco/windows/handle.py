"""What a program holds of a window that shows its simulation."""

import contextlib
import threading
import traceback
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from robohive import _core as _windows
from robohive.mujoco.enums.view import mjtPertBit
from robohive.mujoco.pictures.context import MjrRect
from robohive.mujoco.pictures.figure import MjvFigure
from robohive.mujoco.pictures.pulling import mjv_applyPerturbForce, mjv_applyPerturbPose
from robohive.mujoco.pictures.scene import MjvPerturb, MjvScene
from robohive.mujoco.pictures.view import MjvCamera, MjvOption, mjv_defaultFreeCamera
from robohive.mujoco.structs.data import MjData
from robohive.mujoco.structs.model import MjModel
from robohive.mujoco.windows import sights

#: Most geoms of a window's scene.
MAX_GEOM = 100_000
#: How long a thread waits for keys before it looks whether the window is there [s].
_PATIENCE = 60.0
_GRASP = ("localpos", "refselpos", "refpos", "refquat")

_Texts = tuple[int | None, int | None, str | None, str | None]


def take_settings(window: _windows.Window, model: MjModel, settings: list[tuple[str, str, list[float]]]) -> None:
    """Writes options of the physics and visual settings that a person has changed in a window."""
    for group, name, values in settings:
        if len(values) == 1:
            model._set_setting(group, name, values[0])
        else:
            model._array(f"{group}.{name}")[...] = values
    if settings:
        window.agrees(model)


class Handle:
    """A window beside a program that simulates.

    The window shows what `sync` told it last. Cameras and options that a person changes there arrive in `cam` and `opt`, and in
    `user_scn.flags`, whenever these are looked at; what the program changes there goes to the window with `sync`, or at the end
    of `with handle.lock()`.
    """

    def __init__(self, window: _windows.Window, model: MjModel, data: MjData, key_callback: Callable[[int], Any] | None) -> None:
        self._window, self._m, self._d = window, model, data
        self._lock = threading.RLock()
        self._cam, self._opt, self._pert = MjvCamera(), MjvOption(), MjvPerturb()
        mjv_defaultFreeCamera(model, self._cam)
        if 0 <= model.vis.global_.cameraid < model.ncam:
            self._cam.type, self._cam.fixedcamid = 2, model.vis.global_.cameraid
        self._user_scn = MjvScene(model, MAX_GEOM)
        #: What both sides know of camera, options and geoms.
        self._agreed = self._sight()
        window.look(model, self._agreed)
        self._shown: list[dict[str, Any]] = []
        self._viewport: MjrRect | None = None
        if key_callback is not None:
            threading.Thread(target=_hear, args=(window, key_callback), daemon=True).start()

    def _sight(self) -> dict[str, Any]:
        return sights.sight(self._cam, self._opt, self._user_scn.flags)

    def _look(self) -> None:
        """Tells the window of cameras and options where the program has changed them, else takes over what a person chose."""
        mine = self._sight()
        if mine != self._agreed:
            self._window.look(self._m, mine)
            self._agreed = mine
            return
        seen = self._window.seen()
        if seen is not None:
            sights.take_sight(seen, self._cam, self._opt, self._user_scn.flags)
            self._agreed = self._sight()

    def _fresh(self) -> None:
        """Takes over what a person chose, unless the program has changed something itself."""
        with self._lock:
            if self._sight() == self._agreed:
                self._look()

    @property
    def cam(self) -> MjvCamera:
        """The camera."""
        self._fresh()
        return self._cam

    @property
    def opt(self) -> MjvOption:
        """What is shown."""
        self._fresh()
        return self._opt

    @property
    def perturb(self) -> MjvPerturb:
        """The body that a person has selected, and how it is pulled, as of the last `sync`."""
        return self._pert

    pert = perturb

    @property
    def user_scn(self) -> MjvScene:
        """Geoms of the program's own, and flags of the picture."""
        self._fresh()
        return self._user_scn

    @property
    def m(self) -> MjModel | None:
        """The model; None once the window is closed."""
        return self._m if self.is_running() else None

    @property
    def d(self) -> MjData | None:
        """The simulation; None once the window is closed."""
        return self._d if self.is_running() else None

    @property
    def viewport(self) -> MjrRect | None:
        """Where in the window the picture is [pixels]; None once the window is closed."""
        with self._lock:
            if not self.is_running():
                return None
            place = self._window.place()
            return MjrRect(*place) if place is not None else MjrRect(0, 0, 0, 0)

    def set_figures(self, viewports_figures: tuple[MjrRect, MjvFigure] | list[tuple[MjrRect, MjvFigure]]) -> None:
        """Lays figures over the picture, in place of the former: rectangles of the window [pixels] and what they show."""
        given = [viewports_figures] if isinstance(viewports_figures, tuple) else viewports_figures
        self._window.figures([sights.figure(*each) for each in given])

    def clear_figures(self) -> None:
        """Takes figures away."""
        self._window.figures([])

    def set_texts(self, texts: _Texts | list[_Texts]) -> None:
        """Writes texts over the picture, in place of the former: font, `mjtGridPos`, first and second column.

        Raises:
            ValueError: there is no such place.
        """
        given = [texts] if isinstance(texts, tuple) else texts
        self._window.texts([sights.text(*each) for each in given])

    def clear_texts(self) -> None:
        """Takes texts away."""
        self._window.texts([])

    def set_images(
        self, viewports_images: tuple[MjrRect, np.ndarray[Any, Any]] | list[tuple[MjrRect, np.ndarray[Any, Any]]]
    ) -> None:
        """Lays images over the picture, in place of the former: rectangles of the window [pixels] and colours (height, width, 3).

        Raises:
            ValueError: an image has not the size of its rectangle.
        """
        given = [viewports_images] if isinstance(viewports_images, tuple) else viewports_images
        self._window.images([sights.image(*each) for each in given])

    def clear_images(self) -> None:
        """Takes images away."""
        self._window.images([])

    @contextlib.contextmanager
    def lock(self) -> Iterator[None]:
        """Keeps other threads from this handle; at its end the window is told of cameras and options."""
        with self._lock:
            yield
            if self.is_running():
                self._look()

    def sync(self, state_only: bool = False) -> None:
        """Shows the present state; takes over what a person has done in the window: options of the physics, controls, equality
        constraints, and the pull of bodies, whose forces become `xfrc_applied`, which has no others after it.

        Args:
            state_only: Whether changes of the model are not looked for.
        """
        with self._lock:
            if not self.is_running():
                return
            self._take(self._window.take())
            self._look()
            self._window.sync(self._m, self._d, not state_only)
            geoms = sights.guests(self._user_scn)
            if geoms != self._shown:
                self._window.items(self._m, geoms)
                self._shown = geoms
            self._d.xfrc_applied[:] = 0.0
            mjv_applyPerturbPose(self._m, self._d, self._pert, 0)
            mjv_applyPerturbForce(self._m, self._d, self._pert)

    def _take(self, done: dict[str, Any]) -> None:
        take_settings(self._window, self._m, done["settings"])
        for number, value in done["controls"].items():
            self._d.ctrl[number] = value
        for number, on in done["equalities"].items():
            self._d.eq_active[number] = on
        grasp = done.get("grasp")
        if grasp is None:
            return
        pert = self._pert
        pert.select = grasp["select"]
        bits = ((mjtPertBit.mjPERT_TRANSLATE, "pulls"), (mjtPertBit.mjPERT_ROTATE, "turns"))
        pert.active = sum(int(bit) for bit, name in bits if grasp[name])
        for name in _GRASP:
            getattr(pert, name)[:] = grasp[name]
        if pert.active:
            pert.localmass, pert.scale = grasp["localmass"], grasp["scale"]

    def update_hfield(self, hfieldid: int) -> None:
        """Shows edits of a height field."""
        self._update(hfieldid, self._m.nhfield, "height field")

    def update_mesh(self, meshid: int) -> None:
        """Shows edits of a mesh."""
        self._update(meshid, self._m.nmesh, "mesh")

    def update_texture(self, texid: int) -> None:
        """Shows edits of a texture."""
        self._update(texid, self._m.ntex, "texture")

    def _update(self, number: int, count: int, kind: str) -> None:
        """Sends what has changed of the model."""
        if not 0 <= number < count:
            raise ValueError(f"there is no {kind} {number}; the model has {count}")
        with self._lock:
            if self.is_running():
                self._window.sync(self._m, self._d, True)

    def close(self) -> None:
        """Closes the window."""
        self._window.close()

    def is_running(self) -> bool:
        """Whether the window is open."""
        return self._window.is_open()

    def __enter__(self) -> "Handle":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _hear(window: _windows.Window, callback: Callable[[int], Any]) -> None:
    """Calls for every key that is pressed, until the window is closed. What a call raises is printed."""
    there = True
    while there:
        there = window.wait(_PATIENCE)
        for key in window.take_keys():
            try:
                callback(key)
            except Exception:  # the program goes on, as it does where a callback of a library fails
                traceback.print_exc()
