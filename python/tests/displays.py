"""A display that nobody sees, and a person at it."""

import os
import shutil
import struct
import subprocess
import time

import numpy as np
import pytest

#: What a window may take to do something on a busy machine [s].
LONG = 90.0


def eventually(is_so, what):
    """Waits until something is so."""
    until = time.monotonic() + LONG
    while time.monotonic() < until:
        if is_so():
            return
        time.sleep(0.02)
    raise AssertionError(f"after {LONG:.0f} s it is still not so that {what}")


class Display:
    """A virtual display: its picture, and a person at its keyboard and mouse."""

    def __init__(self, number, picture):
        self.name, self._picture = f":{number}", picture

    def pixels(self):
        """Height x width x 3 bytes, as Xvfb keeps them in a file of xwd's format."""
        content = self._picture.read_bytes()
        head = struct.unpack(">25I", content[:100])
        size, width, height, line, colours = head[0], head[4], head[5], head[12], head[19]
        start = size + 12 * colours
        rows = np.frombuffer(content, np.uint8, height * line, start).reshape(height, line)
        return rows[:, : 4 * width].reshape(height, width, 4)[:, :, 2::-1]

    def count(self, is_wanted):
        """Pixels whose red, green and blue, 0 to 255, are wanted."""
        red, green, blue = np.moveaxis(self.pixels().astype(int), -1, 0)
        return int(is_wanted(red, green, blue).sum())

    def person(self, *does):
        """A person does something: words of xdotool."""
        if shutil.which("xdotool") is None:
            pytest.skip("there is no xdotool: apt-get install xdotool")
        done = subprocess.run(["xdotool", *map(str, does)], env={**os.environ, "DISPLAY": self.name}, capture_output=True, text=True)
        return done.stdout.split()

    def focus(self, process):
        """Lets the keyboard be a window's; false where the process has none."""
        found = self.person("search", "--onlyvisible", "--pid", process)
        if found:
            self.person("windowraise", found[0], "windowfocus", found[0])
        return bool(found)
