"""MuJoCo's caches and threads, of which there are none: a call finds them empty."""

from robohive.mujoco.structs.data import MjData


class _Cache:
    """The cache of assets, which keeps nothing: `robohive` keeps compiled models on the disk, on demand."""


_CACHE = _Cache()


def mj_getCache() -> _Cache:
    """The cache of assets, which keeps nothing."""
    return _CACHE


def mj_getCacheSize(cache: _Cache) -> int:
    """0 [bytes]."""
    return 0


def mj_getCacheCapacity(cache: _Cache) -> int:
    """0 [bytes]: nothing is kept."""
    return 0


def mj_setCacheCapacity(cache: _Cache, size: int) -> int:
    """The capacity after that, which is 0 [bytes]."""
    return 0


def mj_clearCache(cache: _Cache) -> None:
    """Of no effect: nothing is kept."""


def mju_threadpool(d: MjData, nthread: int) -> None:
    """Of no effect: a step runs on the thread that calls it, with the same numbers. `rollout` takes threads."""
