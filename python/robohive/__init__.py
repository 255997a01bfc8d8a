"""RoboHive's environments for robot learning, in Rust, on physics that follows MuJoCo.

>>> import robohive
>>> env = robohive.make("hive/FrankaReach-v0")
>>> observation, info = env.reset(seed=0)

`gymnasium.make` takes the same ids, with its wrappers around the environment, after `import robohive` or as
`gymnasium.make("robohive:hive/FrankaReach-v0")`. Gymnasium is needed, and imported, only when an environment is made.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from robohive import _core, on_import
from robohive.errors import HardwareError, PhysicsError, SettingError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from robohive.envs import RoboHiveEnv

__version__: str = _core.VERSION

__all__ = ["HardwareError", "PhysicsError", "SettingError", "ids", "make", "register_env_variant"]


def ids(suite: str | None = None) -> list[str]:
    """Ids of all environments, or of one suite, in the registry's order.

    Raises:
        ValueError: there is no such suite; the message lists those that there are.
    """
    rows = _core.ids()
    suites = list(dict.fromkeys(name for _, name, _ in rows))
    if suite is not None and suite not in suites:
        raise ValueError(f"no suite {suite!r}; there are {', '.join(suites)}")
    return [id for id, name, _ in rows if suite in (None, name)]


def make(id: str, **kwargs: Any) -> RoboHiveEnv:
    """The environment of an id, without the wrappers of `gymnasium.make`; its episodes end at the id's length.

    Args:
        id: An id of `ids()`, or one that `register_env_variant` registered.
        kwargs: Those of `RoboHiveEnv`: options, and settings of the environment by RoboHive's names.

    Raises:
        gymnasium.error.NameNotFound: there is no such id; the nearest is named.
        FileNotFoundError: the id's models are not on this machine; the message says how to get them.
        SettingError: a setting is unknown or wrong.
        HardwareError: with `is_hardware=True`, a device does not answer or refuses; `device` is its name.
    """
    from robohive import registration

    return registration.make(id, **kwargs)


def register_env_variant(
    env_id: str,
    variants: Mapping[str, Any],
    variant_id: str | None = None,
    silent: bool = False,
    override_keys: str | Iterable[str] | None = None,
) -> str:
    """Registers an environment with Gymnasium that differs from another in some settings, and returns its id.

    Args:
        env_id: Id of the environment to vary.
        variants: Settings that differ; dictionaries within them are merged, all else is replaced.
            `max_episode_steps` is the length of an episode.
        variant_id: Id of the variant; without one, it is made of the settings.
        silent: Whether not to print the id.
        override_keys: Settings of which the variant has nothing but what `variants` says.

    Raises:
        gymnasium.error.NameNotFound: there is no such environment.
    """
    from robohive import registration

    return registration.register_env_variant(env_id, variants, variant_id, silent, override_keys)


def _register_envs() -> None:
    from robohive import registration

    registration.register_envs()


on_import.after("gymnasium", _register_envs)
