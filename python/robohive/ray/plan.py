"""Which episodes are to run, run, and have arrived: bookkeeping without a cluster."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field


class LostEpisodes(RuntimeError):
    """Episodes whose actors died at every attempt."""


@dataclass(frozen=True)
class Unit:
    """Episodes that one actor runs in one call."""

    number: int
    episodes: tuple[int, ...]


@dataclass
class Plan:
    """Units of a collection. A unit is waiting or running until it is done; a lost one waits again, before all others."""

    waiting: deque[Unit]
    attempts_allowed: int
    running: dict[int, Unit] = field(default_factory=dict)
    lost: int = 0
    """How often a unit was lost."""
    _attempts: dict[int, int] = field(default_factory=dict)

    @classmethod
    def of(cls, episodes: Iterable[int], size: int, attempts_allowed: int) -> Plan:
        """Units of `size` episodes each, the last with what remains."""
        return cls(deque(_units(episodes, size)), attempts_allowed)

    def take(self) -> Unit | None:
        """A unit to run, now running; None when none waits."""
        if not self.waiting:
            return None
        unit = self.waiting.popleft()
        self.running[unit.number] = unit
        self._attempts[unit.number] = self._attempts.get(unit.number, 0) + 1
        return unit

    def finish(self, unit: Unit) -> None:
        """The episodes of a running unit have arrived."""
        del self.running[unit.number]

    def lose(self, unit: Unit) -> None:
        """The actor of a running unit died, or its result was lost with a node.

        Raises:
            LostEpisodes: the unit was lost at every attempt allowed.
        """
        del self.running[unit.number]
        self.lost += 1
        if self._attempts[unit.number] >= self.attempts_allowed:
            first, last = unit.episodes[0], unit.episodes[-1]
            raise LostEpisodes(
                f"episodes {first} to {last} were lost {self.attempts_allowed} times, each time with their actor; "
                "if they exhaust its memory, use fewer environments an actor or smaller units"
            )
        self.waiting.appendleft(unit)

    @property
    def is_over(self) -> bool:
        """Nothing waits and nothing runs."""
        return not self.waiting and not self.running


def _units(episodes: Iterable[int], size: int) -> Iterator[Unit]:
    pending: list[int] = []
    number = 0
    for episode in episodes:
        pending.append(episode)
        if len(pending) == size:
            yield Unit(number, tuple(pending))
            pending, number = [], number + 1
    if pending:
        yield Unit(number, tuple(pending))
