"""Many environments of one id, stepped together in Rust with the interpreter's lock released."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, DTypeLike, NDArray

from robohive import _core
from robohive.guests import with_model
from robohive.whole_numbers import whole

Array = NDArray[Any]
Stepped = tuple[Array, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]

_MOST_THREADS = 1024

_READ = {
    "get_obs": "observation",
    "get_obs_dict": "obs_dict",
    "get_reward_dict": "rwd_dict",
    "get_env_infos": "infos",
    "get_env_state": "world",
    "get_exteroception": "visual_dict",
    "proprio_dict": "proprio_dict",
    "obs_dict": "obs_dict",
    "rwd_dict": "rwd_dict",
    "env_state": "world",
    "render": "render",
}


class RoboHiveVectorEnv(VectorEnv[Array, Array, Array]):
    """Environments of one id, by the contract of Gymnasium's vector environments, and EnvPool's `send` and `recv`.

    What one environment does depends on its seed and its actions alone: not on threads, nor on the others. Results of
    environment `k` after `reset(seed=s)` are those of a single environment after `reset(seed=s + k)`.

    Observations are numpy arrays (`num_envs` x length), which `torch.from_dlpack` and `jax.dlpack.from_dlpack` take without
    a copy. `infos` chooses what the infos hold:

    * `"none"`: what ends episodes, `final_obs` (`AutoresetMode.SAME_STEP`) and `fault`, why physics refused a step;
    * `"sparse"`, the default: also `time`, `rwd_dense`, `rwd_sparse`, `solved` and `done`, and these at the end of an
      episode as `final_info`;
    * `"full"`: all that RoboHive's infos hold, also `obs_dict`, `rwd_dict`, `proprio_dict` and `state`.

    Every key has an array of all environments, and `_key` is the mask of those that have it. In `final_info`, `state` and
    images are left out.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "depth_array"]}

    def __init__(
        self,
        env_id: str,
        num_envs: int = 1,
        *,
        num_threads: int = 0,
        batch_size: int | None = None,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        dtype: DTypeLike = np.float64,
        copy: bool = True,
        infos: str = "sparse",
        exteroception: bool = False,
        seed: int | None = None,
        compat: str = "fixed",
        render_mode: str | None = None,
        camera_name: str | None = None,
        width: int | None = None,
        height: int | None = None,
        renderer: str = "cpu",
        instability: str = "truncate",
        solver: str = "own",
        time_limit: bool = True,
        override_keys: Iterable[str] = (),
        **settings: Any,
    ) -> None:
        """Makes the environments.

        Args:
            env_id: An id of `robohive.ids()`, or one of `robohive.guests.MODELS`.
            num_envs: How many.
            num_threads: Threads that step them; 0: as many as this process may use cores.
            batch_size: How many environments `recv` waits for; all without it.
            autoreset_mode: What happens after an episode has ended.
            dtype: Precision of observations, `float64` or `float32`.
            copy: Whether every call returns observations in a new array. Without it, they are in the same array every time,
                which the next call overwrites.
            infos: `none`, `sparse` or `full`.
            exteroception: Draws the images of the visual keys at every call, for `visual_dict` of the infos.
            seed: Seed of environment 0 until `reset` seeds; without one, from the operating system.
            compat: `fixed`, or `robohive-0.7` to reproduce what RoboHive computes otherwise than it means to.
            render_mode: `rgb_array` or `depth_array`.
            camera_name: Camera of pictures, by its name in the model, or `free`.
            width: Columns of pictures.
            height: Rows of pictures.
            renderer: `cpu`; or, in wheels built with the feature `gpu`, `gpu`, or `gpu:NAME` for the one whose name contains
                NAME. Where there is no such GPU, the CPU draws, and a line on the standard error stream says so.
            instability: What a state does that physics refuses: `truncate` ends the episode, with the reason in the infos as
                `fault`; `reset` returns to the reference configuration in the middle of the episode, as MuJoCo does.
            solver: The engine of the simulation: `own`, or, in wheels built with the feature `rapier`, `rapier`.
            time_limit: Whether episodes end at their length.
            override_keys: Settings of the id that `settings` replaces rather than merges.
            settings: Settings that differ from the id's, by RoboHive's names.
        """
        self.closed = True  # Until there is something to close.
        self._kwargs = {key: value for key, value in locals().items() if key not in ("self", "settings", "__class__")}
        self._kwargs.update(settings)
        self.num_envs = whole("num_envs", num_envs, 1)
        self.num_threads = whole("num_threads", num_threads, most=_MOST_THREADS)
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.batch_size = self.num_envs if batch_size is None else whole("batch_size", batch_size, 1)
        if not 1 <= self.batch_size <= self.num_envs:
            raise ValueError(f"batch_size is 1 to num_envs ({self.num_envs}), not {batch_size}")
        if infos not in ("none", "sparse", "full"):
            raise ValueError(f"infos is none, sparse or full, not {infos!r}")
        dtype = np.dtype(dtype)
        if dtype not in (np.float64, np.float32):
            raise ValueError(f"dtype is float64 or float32, not {dtype}")
        making = {
            "seed": 0,
            "compat": compat,
            "render_mode": render_mode,
            "camera": camera_name,
            "width": None if width is None else whole("width", width, 1),
            "height": None if height is None else whole("height", height, 1),
            "renderer": renderer,
            "instability": instability,
            "solver": solver,
            "time_limit": time_limit,
            "override_keys": list(override_keys),
            "hardware": None,
        }
        if settings.pop("is_hardware", False):
            raise ValueError(
                "is_hardware=True: a robot is there only once, and a vector has many; make one environment with robohive.make"
            )
        first = _seed(_entropy() if seed is None else seed)
        self._single = _core.Env(env_id, with_model(env_id, settings), making)
        self._core = _core.VecEnv(
            self._single, self.num_envs, first, self.autoreset_mode.value, self.num_threads
        )
        self.closed = False
        self._begun = False  # Whether there are states to step from.
        self._about = self._single.description()
        self._seeds: list[int | None] = [first + index for index in range(self.num_envs)]
        self._form = {"narrow": dtype == np.float32, "infos": infos, "exteroception": exteroception, "out": None}
        self.render_mode = render_mode
        self.metadata = {
            **type(self).metadata,
            "autoreset_mode": self.autoreset_mode,
            "render_fps": round(1 / self._about["dt"]),
        }
        self._make_spaces(dtype)
        if not copy:
            self._form["out"] = np.zeros((self.num_envs, self._about["obs_size"]), dtype)
        self.copy = copy

    def _make_spaces(self, dtype: np.dtype[Any]) -> None:
        about = self._about
        low, high = about["action_low"], about["action_high"]
        declared = about["compat"] == "robohive-0.7" or about["obs_range_given"]
        least, most = about["obs_range"] if declared else (-np.inf, np.inf)
        self.single_action_space = spaces.Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32)
        self.single_observation_space = spaces.Box(least, most, (about["obs_size"],), dtype=dtype.type)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)

    # Gymnasium's contract.

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
        out: Array | None = None,
    ) -> tuple[Array, dict[str, Any]]:
        """Starts episodes.

        Args:
            seed: Seed of environment 0, the following ones for the others; or one for each.
            options: `reset_mask`, an array of a flag for each environment, resets some.
            out: Array to write the observations into.

        Returns:
            Observations of all (`num_envs` x length), and infos of those that were reset.
        """
        seeds = self._spread(seed, self.num_envs)
        mask = _mask(options, self.num_envs)
        result = self._core.reset(seeds, mask, self._handing(out))
        self._note(range(self.num_envs), seeds)
        self._begun = True
        return result

    def step(self, actions: ArrayLike, out: Array | None = None) -> Stepped:
        """One control period of every environment.

        Args:
            actions: `num_envs` x length; values beyond the space are clipped, as RoboHive clips them.
            out: Array to write the observations into.

        Raises:
            ValueError: a wrong shape, or values that are not finite; then no environment has stepped.
            TypeError: no numbers.
            gymnasium.error.ResetNeeded: before the first reset; an episode is over and nothing resets
                (`AutoresetMode.DISABLED`).
            gymnasium.error.ClosedEnvironmentError: after `close`.
        """
        self._check_begun("step")
        return self._core.step(actions, self._form if out is None else self._handing(out))

    def render(self) -> tuple[Any, ...]:
        """A picture of each environment."""
        return self.call("render")

    def close_extras(self, **kwargs: Any) -> None:
        """Ends the threads and frees the environments."""
        self._core.close()
        self._single.close()

    @property
    def np_random_seed(self) -> tuple[int | None, ...]:  # type: ignore[override]
        """The seed of each environment."""
        return tuple(self._seeds)

    # EnvPool's.

    def async_reset(
        self, seed: int | Sequence[int | None] | None = None, env_id: Sequence[int] | None = None
    ) -> None:
        """Lets environments reset, and returns at once; `recv` returns those that finish first.

        Args:
            seed: As that of `reset`.
            env_id: Which environments; all without it.
        """
        ids = list(range(self.num_envs)) if env_id is None else _ids(env_id)
        seeds = self._spread(seed, len(ids))
        self._core.send_resets(ids, seeds)
        self._note(ids, seeds)
        self._begun = True

    def send(self, actions: ArrayLike, env_id: Sequence[int] | None = None) -> None:
        """Lets environments step, and returns at once.

        Args:
            actions: One row for each of them.
            env_id: Which environments; all without it. Those that `recv` returned have their indices in its infos.
        """
        self._check_begun("send")
        self._core.send(list(range(self.num_envs)) if env_id is None else _ids(env_id), actions)

    def recv(self, batch_size: int | None = None, out: Array | None = None) -> Stepped:
        """Waits for the environments that finish first.

        Args:
            batch_size: How many; that of the constructor without it.
            out: Array to write the observations into (`batch_size` x length).

        Returns:
            What `step` returns, with rows in the order in which environments finished, and `env_id` in the infos: their
            indices. Observations are in a new array unless `out` is given. A reset has reward 0.
        """
        count = self.batch_size if batch_size is None else whole("batch_size", batch_size, 1)
        return self._core.recv(count, {**self._form, "exteroception": False, "out": out})

    @property
    def under_way(self) -> int:
        """How many environments were sent and not received."""
        return int(self._core.under_way())

    # Single environments.

    def get_exteroception(self) -> dict[str, Any]:
        """The images of the visual keys of all environments, drawn on the threads, with their masks."""
        return self._core.visual_dict()

    def call(self, name: str, *args: Any, **kwargs: Any) -> tuple[Any, ...]:
        """What a method or attribute of every environment gives: `get_obs`, `get_obs_dict`, `get_reward_dict`,
        `get_env_infos`, `get_env_state`, `get_exteroception`, `render`; `set_env_state` and `seed`, which take one
        argument for all; and attributes of `get_attr`.

        Raises:
            AttributeError: environments have no such method.
        """
        if name in ("set_env_state", "seed"):
            (value,) = [*args, *kwargs.values()]
            self.set_attr(name, [value] * self.num_envs)
            return (None,) * self.num_envs
        if args or kwargs:
            raise TypeError(f"{name} takes no arguments here")
        return self.get_attr(name)

    def get_attr(self, name: str) -> tuple[Any, ...]:
        """An attribute of every environment: `dt`, `horizon`, `frame_skip`, `obs_keys`, `weights` and others that do not
        change, `np_random_seed`, `observation_space`, `action_space`, `spec`, `render_mode`, `metadata`, and the present
        `obs_dict`, `rwd_dict`, `proprio_dict` and `env_state`.

        Raises:
            AttributeError: there is none of that name.
        """
        if name == "np_random_seed":
            return self.np_random_seed
        if name in ("observation_space", "action_space"):
            return (getattr(self, f"single_{name}"),) * self.num_envs
        if name in ("spec", "render_mode", "metadata"):
            return (getattr(self, name),) * self.num_envs
        if name in self._about:
            return tuple(copy.copy(self._about[name]) for _ in range(self.num_envs))
        if name in _READ:
            single = (self._core.copy(index, self._single) for index in range(self.num_envs))
            return tuple(getattr(env, _READ[name])() for env in single)
        known = sorted({*self._about, *_READ, "np_random_seed", "observation_space", "action_space", "spec"})
        raise AttributeError(f"environments have no attribute {name}; there are {', '.join(known)}")

    def set_attr(self, name: str, values: Any) -> None:
        """Sets `env_state` of every environment, to one state or to a list of one for each; or `seed`.

        Raises:
            AttributeError: another name. Settings are given when environments are made.
        """
        setters = {"env_state": "set_world", "set_env_state": "set_world", "seed": "seed"}
        if name not in setters:
            raise AttributeError(
                f"{name} cannot be set; env_state and seed can, and settings are keyword arguments when environments are made"
            )
        if not isinstance(values, (list, tuple)):
            values = [values] * self.num_envs
        if len(values) != self.num_envs:
            raise ValueError(f"{name} takes {self.num_envs} values, one for each environment, not {len(values)}")
        for index, value in enumerate(values):
            getattr(self._core, setters[name])(index, value)
        self._begun = self._begun or name != "seed"

    # Copies.

    def __deepcopy__(self, memo: dict[int, Any]) -> RoboHiveVectorEnv:
        """Environments in the same states, which go on by themselves: their steps and draws are those of these."""
        other = type(self).__new__(type(self))
        memo[id(self)] = other
        for key, value in self.__dict__.items():
            if key == "_core":
                value = self._core.fork(self._single, self.num_threads)
            elif key == "_single":
                value = self._single.fork()
            else:
                value = copy.deepcopy(value, memo)
            other.__dict__[key] = value
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickles how the environments were made; unpickling makes new ones, which need a reset."""
        return _remake, (type(self), self._kwargs, self.spec)

    # How arrays are handed over.

    def _check_begun(self, call: str) -> None:
        if not (self._begun or self.closed):
            raise gymnasium.error.ResetNeeded(f"Cannot call env.{call}() before calling env.reset()")

    def _handing(self, out: Array | None) -> dict[str, Any]:
        return self._form if out is None else {**self._form, "out": out}

    def _spread(self, seed: int | Sequence[int | None] | None, count: int) -> list[int | None]:
        if seed is None:
            return [None] * count
        if isinstance(seed, (int, np.integer)):
            first = _seed(int(seed))
            return [_seed(first + index) for index in range(count)]
        seeds = [None if one is None else _seed(one) for one in seed]
        if len(seeds) != count:
            raise ValueError(f"seeds are one for each of {count} environments, not {len(seeds)}")
        return seeds

    def _note(self, ids: Iterable[int], seeds: Sequence[int | None]) -> None:
        for index, seed in zip(ids, seeds, strict=True):
            if seed is not None:
                self._seeds[index] = seed


def make_vec(env_id: str, num_envs: int = 1, **kwargs: Any) -> RoboHiveVectorEnv:
    """Environments of one id; the entry point of `gymnasium.make_vec`. Keyword arguments are those of `RoboHiveVectorEnv`."""
    return RoboHiveVectorEnv(env_id, num_envs, **kwargs)


def _remake(kind: type[RoboHiveVectorEnv], kwargs: dict[str, Any], spec: Any) -> RoboHiveVectorEnv:
    env = kind(**kwargs)
    env.spec = spec
    return env


def _entropy() -> int:
    return int(np.random.SeedSequence().generate_state(1, np.uint64)[0]) >> 1


def _seed(seed: Any) -> int:
    """A seed as Rust takes it."""
    if isinstance(seed, (bool, float)) or not 0 <= int(seed) < 2**64:
        raise gymnasium.error.Error(f"a seed is an integer of 0 to 2**64 - 1, not {seed!r}")
    return int(seed)


def _ids(env_id: Any) -> list[int]:
    ids = np.asarray(env_id)
    if ids.ndim != 1 or ids.size and ids.dtype.kind not in "iu":
        raise TypeError(f"env_id is a list of integers, not {env_id!r}")
    if ids.size and ids.min() < 0:
        raise IndexError(f"environments are numbered from 0 on; there is no {ids.min()}")
    return [int(index) for index in ids]


def _mask(options: dict[str, Any] | None, count: int) -> NDArray[np.bool_] | None:
    """`reset_mask` of the options, checked as Gymnasium checks it."""
    if not options or "reset_mask" not in options:
        return None
    mask = options["reset_mask"]
    if not isinstance(mask, np.ndarray):
        raise TypeError(f"options['reset_mask'] is a numpy array, not {type(mask)}")
    if mask.dtype != np.bool_:
        raise TypeError(f"options['reset_mask'] holds booleans, not {mask.dtype}")
    if mask.shape != (count,):
        raise ValueError(f"options['reset_mask'] has shape ({count},), not {mask.shape}")
    if not mask.any():
        raise ValueError("options['reset_mask'] chooses no environment")
    return mask
