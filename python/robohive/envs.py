"""One environment, by the contract of Gymnasium and with RoboHive's methods."""

from __future__ import annotations

import copy
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import ArrayLike, NDArray

from robohive import _core
from robohive.control import Controller, controllers
from robohive.errors import SettingError
from robohive.examine import Policy, examine_policy
from robohive.guests import with_model
from robohive.live import Ready, asked
from robohive.paths import success, truncate
from robohive.policy import TrainedPolicy
from robohive.screen import Screen
from robohive.simulation import Simulation
from robohive.whole_numbers import whole

Floats = NDArray[np.float64]


def _made(arguments: tuple[Any, ...], settings: dict[str, Any]) -> _core.Env:
    """The environment; an unknown setting is named in Python's own words too, by which libraries tell what they may leave out."""
    try:
        return _core.Env(*arguments)
    except SettingError as error:
        for name in settings:
            if any(words in str(error) for words in (f"there is no {name};", f"unknown field `{name}`")):
                raise SettingError(f"{error} (unexpected keyword argument {name!r})") from None
        raise


class RoboHiveEnv(gymnasium.Env[Floats, NDArray[np.float32]]):
    """An environment of RoboHive.

    Observations are vectors of 64-bit numbers, one copy for each call. They are not bounded, and the space says so; with
    `compat="robohive-0.7"` it says what RoboHive's does (-10 to 10, 32 bits), which its observations do not keep. Actions are
    in -1 to 1 unless `normalize_act=False`; larger ones are clipped, as in RoboHive.

    All draws are made in Rust, by numpy's default generator: `reset(seed=s)` starts the episode that RoboHive starts after
    `env.seed(s)`. `np_random` is a generator of its own, seeded with the same number, which no reset draws from.

    Calls from two threads at once raise `RuntimeError`; each is made with the interpreter's lock released.
    """

    metadata: dict[str, Any] = {"render_modes": ["human", "rgb_array", "depth_array"], "render_fps": 30}

    def __init__(
        self,
        env_id: str,
        *,
        seed: int | None = None,
        compat: str = "fixed",
        render_mode: str | None = None,
        camera_name: str | None = None,
        width: int | None = None,
        height: int | None = None,
        renderer: str = "cpu",
        instability: str = "truncate",
        solver: str = "own",
        time_limit: bool = False,
        override_keys: Iterable[str] = (),
        is_hardware: bool = False,
        robot_config: str | os.PathLike[str] | None = None,
        arm: bool = False,
        dry_run: bool = False,
        rehearse: bool = False,
        flight: str | os.PathLike[str] | None = None,
        ready: Ready | None = None,
        **settings: Any,
    ) -> None:
        """Makes the environment of an id.

        Args:
            env_id: An id of `robohive.ids()`.
            seed: Seed of all draws; without one, from the operating system.
            compat: `fixed`, or `robohive-0.7` to reproduce what RoboHive computes otherwise than it means to.
            render_mode: `rgb_array` or `depth_array`; or `human`, a window that follows every reset and step, at real time.
            camera_name: Camera of pictures, by its name in the model, or `free`.
            width: Columns of pictures; 640 without it.
            height: Rows of pictures; 480 without it.
            renderer: `cpu`; or, in wheels built with the feature `gpu`, `gpu`, or `gpu:NAME` for the one whose name contains
                NAME. Where there is no such GPU, the CPU draws, and a line on the standard error stream says so.
            instability: What a state does that physics refuses: `truncate` ends the episode, with the reason in the infos as
                `fault`; `reset` returns to the reference configuration in the middle of the episode, as MuJoCo does.
            solver: The engine of the simulation: `own`, or, in wheels built with the feature `rapier`, `rapier`.
            time_limit: Whether episodes end at their length; `gymnasium.make` has a wrapper for that.
            override_keys: Settings of the id that `settings` replaces rather than merges.
            is_hardware: Whether the devices of the robot's config are driven, and the simulation mirrors what they read.
            robot_config: The robot's config, a file; RoboHive's `config_path` is taken for it too. Without it, the id's.
            arm: Lets the devices move. Without it, a reset raises `HardwareError`, and nothing moves.
            dry_run: Reads the devices, and prints what they would be sent instead of sending it.
            rehearse: Drives simulated devices in simulated time instead of real ones.
            flight: Folder that keeps the last minutes of commands, readings and faults of each device.
            ready: Called in every reset with the joint positions (nq) that the episode begins with, once the robot stands
                there: it asks a person to put everything in place, or does so itself. Without it, the terminal asks.
            settings: Settings that differ from the id's, by RoboHive's names (`reward_mode`, `obs_keys`, `frame_skip` …).

        Raises:
            HardwareError: a device does not answer or refuses; `device` is its name.
        """
        if seed is None:
            seed = int(np.random.SeedSequence().generate_state(1, np.uint64)[0])
        making = {
            "seed": _seed(seed),
            "compat": compat,
            "render_mode": None if render_mode == "human" else render_mode,
            "camera": camera_name,
            "width": None if width is None else whole("width", width, 1),
            "height": None if height is None else whole("height", height, 1),
            "renderer": renderer,
            "instability": instability,
            "solver": solver,
            "time_limit": time_limit,
            "override_keys": list(override_keys),
            "hardware": asked(is_hardware, settings, robot_config, arm, dry_run, rehearse, flight, ready),
        }
        self._arguments = (env_id, with_model(env_id, settings), making)
        self._start(_made(self._arguments, settings), render_mode)

    def _start(self, core: _core.Env, render_mode: str | None) -> None:
        about = core.description()
        self._core = core
        self._about = about
        self._screen: Screen | None = None
        self._input_seed: int | None = None
        # Whether there is a state to step from: after a reset, or a state that was set.
        self._begun = False
        self.render_mode: str | None = render_mode
        self.metadata = {**type(self).metadata, "render_fps": round(1 / about["dt"])}
        low, high = about["action_low"], about["action_high"]
        self.action_space = spaces.Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32)
        size = about["obs_size"]
        least, most = about["obs_range"]
        if about["compat"] == "robohive-0.7":
            self.observation_space = spaces.Box(least, most, (size,), dtype=np.float32)  # type: ignore[assignment]
        elif about["obs_range_given"]:
            self.observation_space = spaces.Box(least, most, (size,), dtype=np.float64)
        else:
            self.observation_space = spaces.Box(-np.inf, np.inf, (size,), dtype=np.float64)

    # Gymnasium's contract.

    def reset(
        self,
        *,
        seed: int | None = None,
        options: dict[str, Any] | None = None,
        reset_qpos: ArrayLike | None = None,
        reset_qvel: ArrayLike | None = None,
    ) -> tuple[Floats, dict[str, Any]]:
        """Starts an episode.

        Args:
            seed: Restarts all draws first.
            options: `reset_qpos` and `reset_qvel`, for those who call through wrappers.
            reset_qpos: Joint positions (nq) that replace the drawn ones.
            reset_qvel: Joint velocities (nv) that replace the drawn ones.

        Returns:
            The first observation, and the infos of `get_env_infos`.
        """
        super().reset(seed=seed)
        if seed is not None:
            self._input_seed = _seed(seed)
        result = self._core.reset(self._input_seed if seed is not None else None)
        self._begun = True
        given = {"reset_qpos": reset_qpos, "reset_qvel": reset_qvel}
        for key, value in (options or {}).items():
            if key not in given:
                raise ValueError(f"no reset has an option {key}; there are {', '.join(given)}")
            given[key] = value
        state = {key.removeprefix("reset_"): value for key, value in given.items() if value is not None}
        if state:
            self._core.set_world(state)
            result = self._core.observation(), self._core.infos()
        if self.render_mode == "human":
            self._show(waits=False)
        return result

    def step(
        self, action: ArrayLike, *, update_proprioception: bool = True, update_exteroception: bool = False
    ) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Applies an action for one control period.

        Args:
            action: One number for each actuator.
            update_proprioception: Of no effect: the proprioception is part of the infos.
            update_exteroception: Draws the images of the visual keys, which the infos then have.

        Returns:
            Observation, reward, terminated, truncated, infos. A step that physics refuses is truncated, has the reward 0 and
            the reason as `fault` in its infos, and must be followed by a reset.

        Raises:
            gymnasium.error.ResetNeeded: before the first reset.
        """
        if not (self._begun or self._core.closed()):
            raise gymnasium.error.ResetNeeded("Cannot call env.step() before calling env.reset()")
        result = self._core.step(action, update_exteroception)
        if self.render_mode == "human":
            self._show(waits=True)
        return result

    def render(self) -> NDArray[Any] | None:
        """A picture of the present state: H x W x 3 bytes of colour, or H x W depths [m] of 32 bits. With the mode `human` none:
        resets and steps have shown the state in the window, and this shows what was set since."""
        if self.render_mode is None:
            gymnasium.logger.warn("render was called without a render_mode; make the environment with one")
        if self.render_mode == "human" and not self._core.closed():
            self._show(waits=False)
            return None
        return self._core.render()

    def _show(self, waits: bool) -> None:
        """Shows the present state in a window, which the first call opens; then waits until its time has come."""
        if self._screen is None:
            self._screen = Screen(self.id, self._core, self.dt)
        self._screen.show(self._core, waits)

    def close(self) -> None:
        """Frees the simulation and closes its window. Calls after it raise `gymnasium.error.ClosedEnvironmentError`, but for
        another `close`."""
        screen, self._screen = self._screen, None
        if screen is not None:
            screen.close()
        self._core.close()

    # Copies.

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles how the environment was made and all that decides its next steps and episodes: it goes on to the last bit,
        in another process too. The models are read there."""
        rest = {key: value for key, value in self.__dict__.items() if key != "_core"} | {"_screen": None}
        if self._arguments[2]["hardware"] is not None:
            raise TypeError("an environment whose robot is hardware cannot be pickled: the robot is there only once")
        memory = None if self._core.closed() else self._core.memory()
        return _restored, (type(self), rest, memory)

    def __deepcopy__(self, memo: dict[int, Any]) -> RoboHiveEnv:
        """An environment in the same state, which goes on by itself: its steps and draws are those of this one."""
        if self._arguments[2]["hardware"] is not None:
            raise TypeError("an environment whose robot is hardware cannot be copied: the robot is there only once")
        other = type(self).__new__(type(self))
        memo[id(self)] = other
        for key, value in self.__dict__.items():
            shared = {"_core": value, "_screen": None}
            other.__dict__[key] = shared[key] if key in shared else copy.deepcopy(value, memo)
        if not self._core.closed():
            other._core = self._core.fork()
        return other

    # RoboHive's methods and properties.

    @property
    def id(self) -> str:
        """The id."""
        return self.spec.id if self.spec is not None else str(self._about["id"])

    @property
    def horizon(self) -> int:
        """Steps of an episode."""
        return int(self._about["horizon"])

    @property
    def dt(self) -> float:
        """Control period [s]."""
        return float(self._about["dt"])

    @property
    def time(self) -> float:
        """Simulation time [s]."""
        return float(self._core.time())

    @property
    def frame_skip(self) -> int:
        """Time steps of the physics in one step of the environment."""
        return int(self._about["frame_skip"])

    @property
    def normalize_act(self) -> bool:
        """Whether actions are in -1 to 1."""
        return bool(self._about["normalize_act"])

    @property
    def obs_keys(self) -> list[str]:
        """Rows of the observation vector, in order."""
        return list(self._about["obs_keys"])

    @property
    def proprio_keys(self) -> list[str] | None:
        """Rows of the proprioception."""
        keys = self._about["proprio_keys"]
        return None if keys is None else list(keys)

    @property
    def visual_keys(self) -> list[str] | None:
        """Images of the exteroception."""
        return list(self._about["visual_keys"]) or None

    @property
    def rwd_keys_wt(self) -> dict[str, float]:
        """Terms of the dense reward with their weights."""
        return dict(self._about["weights"])

    @property
    def rwd_mode(self) -> str:
        """Which reward a step returns: `dense` or `sparse`."""
        return "sparse" if self._about["sparse"] else "dense"

    @property
    def obs_dict(self) -> dict[str, Floats]:
        """The observation dictionary of the present state, as infos have it."""
        return self._core.obs_dict()

    @property
    def rwd_dict(self) -> dict[str, NDArray[Any]]:
        """The terms of the reward of the present state, as infos have them."""
        return self._core.rwd_dict()

    @property
    def proprio_dict(self) -> dict[str, Floats] | None:
        """The proprioception of the present state, as infos have it."""
        return self._core.proprio_dict()

    @property
    def visual_dict(self) -> dict[str, NDArray[Any]]:
        """The images of the present state, as infos have them: empty unless they were drawn."""
        return dict(self._core.infos()["visual_dict"])

    @property
    def sim(self) -> Simulation:
        """Arrays of the model and the simulation, to read."""
        return Simulation(self._core)

    sim_obsd = sim

    def seed(self, seed: int | None = None) -> list[int]:
        """Restarts all draws, as RoboHive's `seed` does."""
        if seed is None:
            seed = int(np.random.SeedSequence().generate_state(1, np.uint64)[0])
        self._input_seed = _seed(seed)
        self._core.seed(self._input_seed)
        return [self._input_seed]

    def get_input_seed(self) -> int | None:
        """The seed that was given last."""
        return self._input_seed

    def forward(self, **kwargs: Any) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """What a step returns, of the present state; takes the keyword arguments of `get_obs`."""
        observation = self.get_obs(**kwargs)
        infos = self.get_env_infos()
        return observation, infos["rwd_" + self.rwd_mode], infos["done"], False, infos

    def get_obs(self, update_proprioception: bool = True, update_exteroception: bool = False) -> Floats:
        """The observation vector of the present state."""
        if update_exteroception:
            self._core.visual_dict()
        return self._core.observation()

    def get_obs_dict(self, sim: Simulation | None = None) -> dict[str, Floats]:
        """The observation dictionary of the present state, every row with one axis."""
        return {key: np.atleast_1d(row) for key, row in self._core.obs_dict().items()}

    def get_reward_dict(self, obs_dict: Mapping[str, ArrayLike] | None = None) -> dict[str, NDArray[Any]]:
        """The terms of the reward of the present state.

        Raises:
            ValueError: `obs_dict` is of another state; `compute_path_rewards` rewards recorded observations.
        """
        if obs_dict is not None:
            present = self._core.obs_dict()
            same = obs_dict.keys() == present.keys() and all(
                np.array_equal(np.ravel(np.asarray(obs_dict[key])), np.ravel(present[key])) for key in present
            )
            if not same:
                raise ValueError(
                    "obs_dict is not that of the present state; compute_path_rewards rewards recorded observations"
                )
        return self._core.rwd_dict()

    def get_proprioception(
        self, obs_dict: Mapping[str, Floats] | None = None
    ) -> tuple[Floats, Floats, dict[str, Floats]] | tuple[None, None, None]:
        """Time, the rows of the proprioception one after the other, and a dictionary of them; three times `None` where the
        task has none."""
        keys = self.proprio_keys
        if keys is None:
            return None, None, None
        rows = self._core.obs_dict() if obs_dict is None else obs_dict
        vector = np.concatenate([np.zeros(0), *(np.ravel(rows[key]) for key in keys)])
        return rows["time"], vector, {"time": rows["time"], **{key: rows[key] for key in keys}}

    def get_exteroception(self, **kwargs: Any) -> dict[str, NDArray[Any]] | None:
        """The images of the visual keys; takes the arguments of `get_visuals`."""
        return self.get_visuals(**kwargs)

    def get_visuals(
        self,
        sim: Simulation | None = None,
        visual_keys: Sequence[str] | None = None,
        device_id: int | None = None,
    ) -> dict[str, NDArray[Any]] | None:
        """The images of the visual keys by their names, and `time`; `None` for an environment without any.

        Args:
            sim: Of no effect; there is one simulation.
            visual_keys: Those to return, of the environment's; all of them without it.
            device_id: Of no effect; pictures need no GPU.

        Raises:
            KeyError: a key is none of the environment's.
        """
        if self.visual_keys is None:
            return None
        images = self._core.visual_dict()
        if visual_keys is None:
            return images
        return {key: images[key] for key in ["time", *visual_keys]}

    def get_env_infos(self) -> dict[str, Any]:
        """`time`, `rwd_dense`, `rwd_sparse`, `solved`, `done`, and the dictionaries `obs_dict`, `visual_dict`, `proprio_dict`,
        `rwd_dict` and `state` of the present state; all of them copies."""
        return self._core.infos()

    def get_env_state(self) -> dict[str, Any]:
        """Time, positions, velocities, activations, mocap bodies, and where sites and bodies stand."""
        return self._core.world()

    def set_env_state(self, state_dict: Mapping[str, Any]) -> None:
        """Takes over a state of `get_env_state`, and observes and rewards it; keys that are missing keep their values.

        Raises:
            KeyError: a key that no state has.
            ValueError: values of another shape.
        """
        self._core.set_world(dict(state_dict))
        self._begun = True

    def compute_path_rewards(self, paths: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        """Writes `rewards` and `done` of a path from its `observations`: T x size, or N x T x size for several.

        The reward of a step belongs to the observation after it; the last is repeated.
        """
        observations = np.asarray(paths["observations"], dtype=np.float64)
        batch = observations if observations.ndim == 3 else observations[None]
        rewards = [self._core.path_rewards(path) for path in batch]
        kept = slice(None) if len(rewards) > 1 else 0
        paths["rewards"] = np.stack([reward[self.rwd_mode] for reward in rewards])[kept]
        paths["done"] = np.stack([reward["done"] for reward in rewards])[kept]
        return paths

    def truncate_paths(self, paths: list[dict[str, Any]]) -> list[dict[str, Any]]:
        """Cuts every path behind the step that ended it, and writes `terminated`."""
        return truncate(paths)

    def evaluate_success(
        self, paths: Sequence[Mapping[str, Any]], logger: Any = None, successful_steps: int = 5
    ) -> float:
        """Share of paths that were solved in more than `successful_steps` steps [%]; tasks that RoboHive evaluates by the share
        of their horizon solved give the mean of that.

        Args:
            paths: As `examine_policy` returns them.
            logger: Anything with `log_kv(key, value)`, which gets `rwd_sparse`, `rwd_dense` and `success_percentage`.
            successful_steps: Solved steps that are not yet a success.
        """
        return success(paths, self.horizon, bool(self._about["share"]), logger, successful_steps)

    def examine_policy(
        self,
        policy: Policy,
        horizon: int = 1000,
        num_episodes: int = 1,
        mode: str = "exploration",
        render: str | None = None,
        camera_name: str | None = None,
        frame_size: tuple[int, int] = (640, 480),
        output_dir: str | None = None,
        filename: str = "newvid",
        device_id: int = 0,
    ) -> list[dict[str, Any]]:
        """Plays episodes of a policy and returns their paths.

        Args:
            policy: Its `get_action(observation)` returns an action and a dictionary with `evaluation`, the action
                without exploration.
            horizon: Most steps of an episode.
            num_episodes: How many.
            mode: `exploration` or `evaluation`.
            render: `onscreen` shows a window; `offscreen` writes a video of every episode, `filename` + number + `.mp4`; None
                does neither.
            camera_name: Camera of the videos; the free one without it.
            frame_size: Width and height of the videos.
            output_dir: Folder that they go to; None: the system's for temporary files.
            filename: How their names begin.
            device_id: Of no effect; pictures need no GPU.
        """
        return examine_policy(
            self,
            policy,
            horizon=horizon,
            num_episodes=num_episodes,
            mode=mode,
            render=render,
            camera=camera_name or "free",
            frame_size=frame_size,
            video=os.path.join(output_dir or tempfile.gettempdir(), filename),
        )

    def controller(self, name: str | None = None) -> Controller:
        """What solves this task without learning.

        Args:
            name: One of `robohive.control.controllers(env.id)`, the best of them without it; or `"planner"`, which plays any task by
                its reward.

        Raises:
            ValueError: there is no such controller, it serves other tasks, or none is made for this id.
        """
        id = str(self._about["id"])
        if name is None:
            serving = controllers(id)
            if not serving:
                raise ValueError(
                    f'no controller is made for {id}; controller("planner") plans by its reward, and '
                    "robohive.control.controllers() lists all"
                )
            name, _ = serving[0]
        return Controller(self, name)

    def policy(self, file: str | os.PathLike[str] | None = None) -> TrainedPolicy:
        """What was trained for this task.

        Args:
            file: A policy that `robohive train` wrote, or a pickle of mjrl; the policy that is shipped for this id
                (`robohive.policy.policies()`) without it.

        Raises:
            ValueError: none is shipped for this id, or the file holds no policy.
            OSError: the file cannot be read.
        """
        return TrainedPolicy(self, file)

    def mj_render(self) -> None:
        """Shows the present state in a window, which the first call opens, as RoboHive does.

        Raises:
            robohive.errors.WindowError: there is no display.
        """
        self._show(waits=False)


def _restored(
    cls: type[RoboHiveEnv], rest: dict[str, Any], memory: tuple[dict[str, Floats], NDArray[np.uint64]] | None
) -> RoboHiveEnv:
    """An environment of its pickle."""
    env = cls.__new__(cls)
    env.__dict__.update(rest)
    env._core = _core.Env(*rest["_arguments"])
    if memory is None:
        env._core.close()
    else:
        edits, words = memory
        env._core.set_memory(list(edits.items()), words)
    return env


def _seed(seed: int) -> int:
    """A seed as Rust takes it."""
    if isinstance(seed, (bool, float)) or not 0 <= int(seed) < 2**64:
        raise gymnasium.error.Error(f"a seed is an integer of 0 to 2**64 - 1, not {seed!r}")
    return int(seed)
