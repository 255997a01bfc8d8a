"""Ids in Gymnasium's registry."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from robohive import _core
from robohive.guests import MODELS

if TYPE_CHECKING:
    from robohive.envs import RoboHiveEnv

ENTRY_POINT = "robohive.envs:RoboHiveEnv"
VECTOR_ENTRY_POINT = "robohive.vector:make_vec"


def register_envs() -> None:
    """Registers every id with Gymnasium; nothing is constructed.

    An id that another package registered before stays that package's: `make` of this package still makes ours. RoboHive's
    ids have no namespace; those on models of this project are in the namespace `hive`, and Gymnasium's own tasks, on its
    models, in `gymnasium`: `gymnasium.make("robohive:gymnasium/Ant-v5")`.
    """
    # Not before it is called: Gymnasium's own import calls it.
    from gymnasium.envs.registration import register, registry

    guests = [(id, None, _core.horizon(id)) for id in MODELS]
    for id, _, horizon in [*_core.ids(), *guests]:
        if id not in registry:
            register(
                id=id,
                entry_point=ENTRY_POINT,
                vector_entry_point=VECTOR_ENTRY_POINT,
                max_episode_steps=horizon,
                kwargs={"env_id": id},
            )


def make(id: str, **kwargs: Any) -> RoboHiveEnv:
    """As `robohive.make`."""
    from gymnasium.envs.registration import EnvSpec, registry

    from robohive.envs import RoboHiveEnv

    base = registry.get(id)
    if base is None or base.entry_point != ENTRY_POINT:
        # Of this package's own registry, or an error that names the nearest.
        horizon = _core.horizon(id)
        base = EnvSpec(id=id, entry_point=ENTRY_POINT, max_episode_steps=horizon, kwargs={"env_id": id})
    settings = {**copy.deepcopy(base.kwargs), **kwargs}
    settings.setdefault("max_episode_steps", base.max_episode_steps)
    env = RoboHiveEnv(time_limit=True, **settings)
    env.spec = EnvSpec(
        id=base.id,
        entry_point=ENTRY_POINT,
        vector_entry_point=VECTOR_ENTRY_POINT,
        max_episode_steps=settings["max_episode_steps"],
        order_enforce=False,
        disable_env_checker=True,
        kwargs={"time_limit": True, **settings},
    )
    return env


def register_env_variant(
    env_id: str,
    variants: Mapping[str, Any],
    variant_id: str | None = None,
    silent: bool = False,
    override_keys: str | Iterable[str] | None = None,
) -> str:
    """As `robohive.register_env_variant`."""
    from gymnasium.envs.registration import register, spec

    base = spec(env_id)
    changes = {key: copy.deepcopy(value) for key, value in variants.items() if key != "max_episode_steps"}
    horizon = variants.get("max_episode_steps", base.max_episode_steps)
    overridden = [override_keys] if isinstance(override_keys, str) else list(override_keys or ())
    kwargs = {key: value for key, value in copy.deepcopy(base.kwargs).items() if key not in overridden}
    if overridden:
        kwargs["override_keys"] = [*kwargs.get("override_keys", ()), *overridden]
    id = variant_id or _variant_id(env_id, changes, variants.get("max_episode_steps"))
    register(
        id=id,
        entry_point=base.entry_point,
        vector_entry_point=base.vector_entry_point,
        max_episode_steps=horizon,
        kwargs=_merged(kwargs, changes),
    )
    if not silent:
        print("Registered a new env-variant:", id)
    return id


def _variant_id(env_id: str, changes: Mapping[str, Any], horizon: int | None) -> str:
    """RoboHive's: `base-hor_50-key_value-v0`."""
    name, dash, version = env_id.rpartition("-v")
    differences = [f"-{key}_{value}" for key, value in _flat(changes)]
    length = [] if horizon is None else [f"-hor_{horizon}"]
    return "".join([name if dash else env_id, *length, *differences, f"{dash}{version}" if dash else ""])


def _flat(table: Mapping[str, Any], above: str = "") -> Iterable[tuple[str, Any]]:
    for key, value in table.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{above}{key}.")
        else:
            yield f"{above}{key}", value


def _merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(base)
    for key, value in changes.items():
        old = merged.get(key)
        both = isinstance(old, Mapping) and isinstance(value, Mapping)
        merged[key] = _merged(old, value) if both else value  # type: ignore[arg-type]
    return merged
