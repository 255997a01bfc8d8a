"""What is logged: how long compiling takes, into a file."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from typing import ClassVar

from robohive.mujoco.enums.view import mjtLogTopic

_COMPILING = 1 << (int(mjtLogTopic.mjTOPIC_TIME_CMP) - 1)


class MjLogConfig:
    """Where messages go, and which topics are logged (bits of `mjtLogTopic`, from the first on).

    Of the topics there is `mjTOPIC_TIME_CMP`, the time that compiling takes [s].
    """

    _present: ClassVar["MjLogConfig | None"] = None

    def __init__(self) -> None:
        self.logfile = "MUJOCO_LOG.TXT"
        self.logto_console = True
        self.logto_file = True
        self.topics = 0

    @staticmethod
    def get() -> "MjLogConfig":
        """A copy of what is set."""
        copy = MjLogConfig()
        if MjLogConfig._present is not None:
            vars(copy).update(vars(MjLogConfig._present))
        return copy

    def set(self) -> None:
        """Makes this what is set."""
        MjLogConfig._present = MjLogConfig()
        vars(MjLogConfig._present).update(vars(self))


@contextmanager
def compile_timed() -> Iterator[None]:
    """Logs the time that compiling takes, where that is asked for."""
    start = time.perf_counter()
    yield
    config = MjLogConfig._present
    if config is None or not config.topics & _COMPILING:
        return
    line = f"{datetime.now():%Y-%m-%d %H:%M:%S}  compile time: {time.perf_counter() - start:.6f} s"
    if config.logto_file:
        with open(config.logfile, "a", encoding="utf-8") as file:
            file.write(line + "\n")
    if config.logto_console:
        print(line)


def mju_writeLog(type: str, msg: str) -> None:
    """Appends a line to the log file."""
    with open(MjLogConfig.get().logfile, "a", encoding="utf-8") as file:
        file.write(f"{datetime.now():%Y-%m-%d %H:%M:%S}\n{type}: {msg}\n\n")
