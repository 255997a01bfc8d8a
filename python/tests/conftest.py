"""What tests share."""

import os
import shutil
import subprocess

import pytest
import robohive
from displays import Display


@pytest.fixture
def env():
    """An arm that reaches."""
    env = robohive.make("hive/FrankaReach-v0", seed=0)
    env.reset(seed=0)
    yield env
    env.close()


@pytest.fixture(scope="session")
def virtual(tmp_path_factory):
    if shutil.which("Xvfb") is None:
        pytest.skip("there is no Xvfb: apt-get install xvfb")
    folder = tmp_path_factory.mktemp("display")
    ready, told = os.pipe()
    # Without -noreset, Xvfb resets when its last client disconnects, and refuses connections during the reset.
    arguments = ["-noreset", "-nolisten", "tcp", "-screen", "0", "1280x1024x24", "-fbdir", str(folder), "-displayfd", str(told)]
    server = subprocess.Popen(["Xvfb", *arguments], pass_fds=[told], stderr=subprocess.DEVNULL)
    os.close(told)
    with os.fdopen(ready) as words:
        number = words.readline().strip()
    if not number:
        pytest.fail(f"Xvfb ended with status {server.wait()} before there was a display")
    yield Display(number, folder / "Xvfb_screen0")
    server.terminate()
    server.wait()


@pytest.fixture
def display(virtual, monkeypatch):
    """A display on which windows open."""
    monkeypatch.setenv("DISPLAY", virtual.name)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    return virtual
