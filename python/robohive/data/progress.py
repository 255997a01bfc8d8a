"""What long work reports."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

Progress = Callable[[int, int], object]
"""Called with the episodes that are done and all there are; an exception that it raises stops the work."""


@dataclass(frozen=True)
class Exported:
    """What came of an export."""

    episodes: int
    """Episodes that were written."""
    steps: int
    """Steps of them."""
    folder: Path
    """The folder that holds the dataset."""
    dropped: dict[str, str]
    """What has no place in the dataset, and why."""
