"""RoboHive's environments for robot learning, in Rust, on physics that follows MuJoCo."""

from robohive import _core

__version__ = _core.VERSION


def ids(suite: str | None = None) -> list[str]:
    """Ids of all environments, or of one suite, in the registry's order.

    Raises:
        ValueError: there is no such suite; the message lists those that there are.
    """
    rows = _core.ids()
    suites = list(dict.fromkeys(name for _, name in rows))
    if suite is not None and suite not in suites:
        raise ValueError(f"no suite {suite!r}; there are {', '.join(suites)}")
    return [id for id, name in rows if suite in (None, name)]
