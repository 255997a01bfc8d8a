"""A session on an OpenXR runtime, which reads two controllers at a rate."""

from __future__ import annotations

import ctypes
import time
import warnings
from collections.abc import Callable, Iterator
from types import TracebackType
from typing import Any

from robohive.openxr import runtime
from robohive.openxr.bindings import ACTIONS, PROFILES, suggested
from robohive.openxr.message import Controller
from robohive.openxr.trouble import Trouble

HANDS = ("right", "left")
#: Time for which nothing is tracked after the space was centred again, so that no hand jumps [ns]: longer than the engine
#: believes an old pose.
SETTLING = 300_000_000
#: Time between two looks at a session that does not run [s].
IDLE = 0.05


class Session:
    """A session on the runtime of this machine.

    It has no pictures where the runtime can do that; otherwise a hidden OpenGL window and empty pictures.
    """

    def __init__(self, rate: float, say: Callable[[str], object]) -> None:
        """Opens a session.

        Args:
            rate: Samples a second of a session without pictures; otherwise the headset's frame rate decides.
            say: Is called with what a person should know: states of the session, controllers.

        Raises:
            Trouble: there is no runtime or no headset, or one of them refuses.
        """
        self._xr = xr = runtime.bindings()
        wanted = runtime.choose(runtime.extensions(xr))
        self._rate, self._say = rate, say
        self._draws = wanted != runtime.HEADLESS
        self._window: Any = None
        self._session: Any = None
        self._running = self._ended = False
        self._state: Any = None
        self._told: Any = None
        self._quiet_until = 0
        self._due = time.monotonic()
        self._instance = runtime.instance(xr, wanted)
        system = runtime.system(xr, self._instance)
        try:
            self._open(system)
        except xr.XrException as error:
            self.close()
            raise Trouble(f"the OpenXR runtime refuses a session: {type(error).__name__}: {error}") from error

    @property
    def pace(self) -> str:
        """How often it reads the controllers."""
        return "at the frame rate of the headset" if self._draws else f"{self._rate:g} times a second"

    def _open(self, system: Any) -> None:
        xr = self._xr
        graphics = self._graphics(system) if self._draws else None
        self._session = xr.create_session(self._instance, xr.SessionCreateInfo(system_id=system, next=graphics))
        local = xr.ReferenceSpaceCreateInfo(reference_space_type=xr.ReferenceSpaceType.LOCAL)
        self._base = xr.create_reference_space(self._session, local)
        self._paths = {hand: xr.string_to_path(self._instance, f"/user/hand/{hand}") for hand in HANDS}
        names = xr.ActionSetCreateInfo(action_set_name="robohive", localized_action_set_name="RoboHive", priority=0)
        self._set = xr.create_action_set(self._instance, names)
        self._actions = {name: self._action(name, kind) for name, kind in ACTIONS.items()}
        for profile in PROFILES:
            rows = [
                xr.ActionSuggestedBinding(action=self._actions[action], binding=xr.string_to_path(self._instance, path)) for action, path in suggested(profile)
            ]
            path = xr.string_to_path(self._instance, f"/interaction_profiles/{profile}")
            xr.suggest_interaction_profile_bindings(
                self._instance, xr.InteractionProfileSuggestedBinding(interaction_profile=path, suggested_bindings=rows)
            )
        xr.attach_session_action_sets(self._session, xr.SessionActionSetsAttachInfo(action_sets=[self._set]))
        self._grips = {
            hand: xr.create_action_space(self._session, xr.ActionSpaceCreateInfo(action=self._actions["grip"], subaction_path=path))
            for hand, path in self._paths.items()
        }

    def _action(self, name: str, kind: str) -> Any:
        xr = self._xr
        info = xr.ActionCreateInfo(
            action_name=name,
            action_type=getattr(xr.ActionType, kind),
            subaction_paths=list(self._paths.values()),
            localized_action_name=name.replace("_", " "),
        )
        return xr.create_action(self._set, info)

    def _graphics(self, system: Any) -> Any:
        """A pointer to the OpenGL context of a hidden window, for the runtime."""
        xr = self._xr
        # With layers left out, the mode with the largest number shows the room where the headset can do that.
        modes = xr.enumerate_environment_blend_modes(self._instance, system, xr.ViewConfigurationType.PRIMARY_STEREO)
        self._blend = max((xr.EnvironmentBlendMode(mode) for mode in modes), key=lambda mode: mode.value)
        try:
            import glfw
            from xr.utils.gl import OpenGLGraphics
            from xr.utils.gl.glfw_util import GLFWOffscreenContextProvider

            # Runtimes know OpenGL by GLX; on Wayland, XWayland has it.
            glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_X11)
            with warnings.catch_warnings():
                # Of what glfw warns about, what matters is in the error that follows.
                warnings.simplefilter("ignore")
                self._window = GLFWOffscreenContextProvider()
            self._graphics_of = OpenGLGraphics(self._instance, system, self._window)
        except (ImportError, RuntimeError, AttributeError) as error:
            raise Trouble(
                f"the OpenXR runtime asks for OpenGL, and there is no window for it ({error}): run this in a desktop session, or use a runtime with {runtime.HEADLESS[0]}"
            ) from error
        return self._graphics_of.graphics_binding.pointer

    def samples(self) -> Iterator[tuple[Controller, Controller]]:
        """The right and the left controller, at the rate, until the runtime ends the session.

        While the session has no focus, as when nobody wears the headset, these are controllers that are not there.

        Raises:
            Trouble: the runtime fails.
        """
        xr = self._xr
        try:
            while self._events():
                yield self._sample() if self._running else self._idle()
        except xr.XrException as error:
            raise Trouble(f"the OpenXR runtime fails: {type(error).__name__}: {error}") from error

    def _idle(self) -> tuple[Controller, Controller]:
        time.sleep(IDLE)
        return Controller(), Controller()

    def _sample(self) -> tuple[Controller, Controller]:
        xr = self._xr
        if not self._draws:
            self._due = max(self._due + 1 / self._rate, time.monotonic())
            time.sleep(max(self._due - time.monotonic(), 0.0))
            return self._read(self._now())
        frame = xr.wait_frame(self._session)
        xr.begin_frame(self._session)
        read = self._read(frame.predicted_display_time)
        end = xr.FrameEndInfo(display_time=frame.predicted_display_time, environment_blend_mode=self._blend, layers=[])
        xr.end_frame(self._session, end)
        return read

    def _now(self) -> int:
        """The runtime's time [ns]."""
        xr = self._xr
        seconds, nanoseconds = divmod(time.monotonic_ns(), 1_000_000_000)
        return int(xr.convert_timespec_time_to_time_khr(self._instance, xr.timespec(seconds, nanoseconds)).value)

    def _read(self, when: int) -> tuple[Controller, Controller]:
        """The controllers at a time of the runtime [ns]."""
        xr = self._xr
        try:
            active = [xr.ActiveActionSet(action_set=self._set, subaction_path=0)]
            xr.sync_actions(self._session, xr.ActionsSyncInfo(active_action_sets=active))
        except xr.SessionNotFocused:
            return Controller(), Controller()
        if when < self._quiet_until:
            return Controller(), Controller()
        return self._controller("right", when), self._controller("left", when)

    def _controller(self, hand: str, when: int) -> Controller:
        xr = self._xr

        def state(action: str, ask: Callable[[Any, Any], Any]) -> Any:
            """The state of an action; zero for one that nothing is bound to."""
            return ask(self._session, xr.ActionStateGetInfo(action=self._actions[action], subaction_path=self._paths[hand])).current_state

        located = xr.locate_space(self._grips[hand], self._base, when)
        flags = xr.SpaceLocationFlags
        needed = flags.POSITION_VALID_BIT | flags.ORIENTATION_VALID_BIT | flags.POSITION_TRACKED_BIT | flags.ORIENTATION_TRACKED_BIT
        stick = state("stick", xr.get_action_state_vector2f)
        p, q = located.pose.position, located.pose.orientation
        return Controller(
            position=(p.x, p.y, p.z),
            orientation=(q.x, q.y, q.z, q.w),
            tracked=located.location_flags & needed == needed,
            trigger=state("trigger", xr.get_action_state_float),
            squeeze=state("squeeze", xr.get_action_state_float),
            stick=(stick.x, stick.y),
            stick_click=bool(state("stick_click", xr.get_action_state_boolean)),
            first=bool(state("first", xr.get_action_state_boolean)),
            second=bool(state("second", xr.get_action_state_boolean)),
        )

    def _events(self) -> bool:
        """Takes what the runtime says; false after it has ended the session."""
        xr = self._xr
        kinds = xr.StructureType
        while not self._ended:
            try:
                event = xr.poll_event(self._instance)
            except xr.EventUnavailable:
                break
            if event.type == kinds.EVENT_DATA_SESSION_STATE_CHANGED:
                self._change(xr.SessionState(ctypes.cast(ctypes.byref(event), ctypes.POINTER(xr.EventDataSessionStateChanged)).contents.state))
            elif event.type == kinds.EVENT_DATA_INSTANCE_LOSS_PENDING:
                self._ended = True
            elif event.type == kinds.EVENT_DATA_INTERACTION_PROFILE_CHANGED:
                self._say(", ".join(f"{hand} hand: {self._profile(hand)}" for hand in HANDS))
            elif event.type == kinds.EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING:
                change = ctypes.cast(ctypes.byref(event), ctypes.POINTER(xr.EventDataReferenceSpaceChangePending)).contents
                if change.reference_space_type == xr.ReferenceSpaceType.LOCAL:
                    self._quiet_until = int(change.change_time) + SETTLING
        if self._state != self._told:
            self._told = self._state
            states = xr.SessionState
            if self._state == states.FOCUSED:
                self._say("the controllers are read")
            elif self._state in (states.IDLE, states.SYNCHRONIZED, states.VISIBLE):
                self._say(f"waiting for the headset ({self._state.name.lower()}): put it on, and close its menu")
        return not self._ended

    def _change(self, state: Any) -> None:
        xr = self._xr
        states = xr.SessionState
        self._state = state
        if state == states.READY:
            xr.begin_session(self._session, xr.SessionBeginInfo(xr.ViewConfigurationType.PRIMARY_STEREO))
            self._running = True
        elif state == states.STOPPING:
            self._running = False
            xr.end_session(self._session)
        elif state in (states.EXITING, states.LOSS_PENDING):
            self._ended = True

    def _profile(self, hand: str) -> str:
        """The controller that is held in a hand."""
        xr = self._xr
        path = xr.get_current_interaction_profile(self._session, self._paths[hand]).interaction_profile
        return str(xr.path_to_string(self._instance, path)).removeprefix("/interaction_profiles/") if path else "nothing"

    def close(self) -> None:
        """Closes the session. The connection ends with the process: SteamVR on Linux crashes when it is closed before."""
        if self._session is not None:
            self._xr.destroy_session(self._session)
            self._session = None
        if self._window is not None:
            self._window.destroy()
            self._window = None

    def __enter__(self) -> Session:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, traceback: TracebackType | None) -> None:
        self.close()
