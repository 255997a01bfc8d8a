"""Sizes and counts, checked where they come in: Rust would refuse them without saying which one it was."""

from __future__ import annotations

from typing import Any


def whole(name: str, value: Any, least: int = 0, most: int = 2**31 - 1) -> int:
    """The argument `name` as a whole number from `least` to `most`.

    Raises:
        TypeError: it is no number.
        ValueError: it is not whole, or out of the range.
    """
    try:
        number = int(value)
        is_whole = bool(number == value)
    except (OverflowError, ValueError):  # infinity, NaN, and texts
        number, is_whole = -1, False
    except TypeError:
        raise TypeError(f"{name} is a whole number, not a {type(value).__name__}") from None
    if not is_whole or not least <= number <= most:
        raise ValueError(f"{name} is a whole number from {least} to {most}, not {value!r}")
    return number
