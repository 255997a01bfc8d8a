"""What was loaded last, which `mj_saveLastXML` writes."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Loaded:
    """A file or a text of MJCF, and the files that came with it."""

    source: str
    is_text: bool
    files: dict[str, bytes]


_last: list[Loaded] = []


def remember(source: str, is_text: bool, files: dict[str, bytes]) -> None:
    """Notes what was loaded."""
    _last[:] = [Loaded(source, is_text, files)]


def last_loaded() -> Loaded | None:
    """What was loaded last; None before anything was."""
    return _last[0] if _last else None
