"""What can go wrong, said with what to do."""

from __future__ import annotations


class Trouble(RuntimeError):
    """There is no runtime, no headset, no session, or a package is missing; the message says what to do."""

    @classmethod
    def lacks(cls, package: str, error: Exception) -> Trouble:
        """For a package that cannot be imported."""
        return cls(f"{package} cannot be imported ({error}): python -m pip install pyopenxr websockets")
