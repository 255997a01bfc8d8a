"""An arm follows a controller: stand-in runtime, bridge, `robohive teleop --device openxr`, recording."""

import os
import pty
import re
import shutil
import subprocess
import threading

import numpy as np
import pytest
from robohive import data

headsets = pytest.importorskip("headset", reason="needs pyopenxr and websockets")
Bridge, eventually = headsets.Bridge, headsets.eventually

ID = "hive/FrankaReach-v0"
#: A circle of the hand [m]: places on it, and how near to each the hand comes before it goes on to the next.
RADIUS, PLACES, NEAR = 0.06, 8, 0.02
#: Longest step of the controller [m]: short, because the servos of this arm let it swing.
STEP = 0.005


@pytest.fixture(scope="module")
def robohive():
    """The command; `cargo xtask python` builds it."""
    command = os.environ.get("ROBOHIVE_COMMAND") or shutil.which("robohive")
    if command is None:
        pytest.skip("there is no robohive command: cargo build -p robohive-cli, and name it by ROBOHIVE_COMMAND")
    return command


class Session:
    """A session by hand in a terminal."""

    def __init__(self, command, *arguments):
        ours, theirs = pty.openpty()
        os.set_blocking(ours, True)
        self._ours, self._text = ours, ""
        self.process = subprocess.Popen([command, "teleop", ID, *arguments], stdin=theirs, stdout=theirs, stderr=theirs, env={**os.environ, "COLUMNS": "250"})
        os.close(theirs)
        threading.Thread(target=self._listen, daemon=True).start()
        self.wait_for("\x1b[?u")
        # A terminal that knows no kitty keyboard protocol.
        os.write(ours, b"\x1b[?62c")
        self.wait_for("episode 1")

    def _listen(self):
        try:
            while piece := os.read(self._ours, 4096):
                self._text += piece.decode(errors="replace")
        except OSError:
            pass  # The terminal of a process that has ended.

    def wait_for(self, text):
        eventually(lambda: text in self._text, f"{text!r} is in {self._text[-600:]!r}")

    @property
    def said(self):
        return self._text

    @property
    def address(self):
        return re.search(r"http://[0-9.:]+/[0-9a-f]{32}", re.sub(r"\s+", "", self._text.replace("run `python -m robohive.openxr ", "")))[0]

    def hand(self):
        """Where the hand is, by the next status line [m]."""
        begun = self._text.count("hand ")
        eventually(lambda: self._text.count("hand ") > begun, "the status line is written")
        lines = re.findall(r"hand +(-?[0-9.]+) +(-?[0-9.]+) +(-?[0-9.]+)", self._text)
        return np.array(lines[-1], float)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        os.close(self._ours)


def lead(headset, session, place):
    """Moves the controller as a person does who sees the arm, until the hand is at a place."""

    def there():
        way = place - session.hand()
        far = np.linalg.norm(way)
        if far > NEAR:
            x, y, z = way * min(0.3, STEP / far)
            # The person stands behind the robot: forward is x there, and -z of the headset.
            headset.move([-y, z, -x])
        return far <= NEAR

    eventually(there, f"the hand is at {place}: {session.hand()}")


def at_rest(session):
    """Where the hand has come to rest."""
    places = [session.hand()]

    def still():
        places.append(session.hand())
        return len(places) > 5 and np.ptp(places[-5:], axis=0).max() <= 1e-3

    eventually(still, "the hand is at rest")
    return places[-1]


def test_the_arm_follows_a_circle_and_stops_when_the_bridge_dies(headset, robohive, tmp_path):
    file = tmp_path / "openxr.h5"
    with Session(robohive, "--device", "openxr:0", "--seed", "3", "--record", str(file)) as session:
        start = session.hand()
        angles = 2 * np.pi * np.arange(1, PLACES + 1) / PLACES
        circle = start + RADIUS * np.stack([np.sin(angles), 1 - np.cos(angles), 0 * angles], axis=1)
        with Bridge(headset, session.address) as bridge:
            eventually(lambda: "the controllers are read" in bridge.said, "the bridge runs")
            # Without the clutch nothing follows.
            headset.move([0.0, 0.1, 0.0])
            assert np.abs(at_rest(session) - start).max() <= 1e-3
            headset.set("right", squeeze=1.0)
            for place in circle[: PLACES // 2]:
                lead(headset, session, place)
            headset.set("right", trigger=1.0)
            for place in circle[PLACES // 2 :]:
                lead(headset, session, place)
            # It is killed while the hand moves.
            headset.move([0.0, 0.02, 0.0])
        rest = at_rest(session)
        headset.move([0.0, 0.1, 0.0])
        assert np.abs(at_rest(session) - rest).max() <= 0.01, "nobody sends what the controller does"
        with Bridge(headset, session.address) as bridge:
            eventually(lambda: "the controllers are read" in bridge.said, "another bridge runs")
            assert np.abs(at_rest(session) - rest).max() <= 0.01, "a clutch that is held takes the present pose as its new origin"
            lead(headset, session, rest + [0.0, 0.0, 0.04])
            headset.set("right", first=1.0)
            session.wait_for("episode 2")
            headset.set("right", first=0.0, squeeze=0.0)
            headset.set("right", second=1.0)
            assert session.process.wait(90) == 0, session.said
            assert bridge.end() == 0 and "the session by hand has ended" in bridge.said
        eventually(lambda: "1 episodes kept, 1 succeeded" in session.said, session.said[-600:])
    trial = data.open(file)["Trial0"]
    # The target of an episode stands still, so its distance tells the motion of the hand.
    away = trial["env_infos/obs_dict/reach_err"].read()
    hand = start + away[0] - away
    centre = start + [0.0, RADIUS, 0.0]
    passed = 0
    for place in circle:
        near = np.linalg.norm(hand[passed:] - place, axis=1) <= 1.2 * NEAR
        assert near.any(), f"{place} was not reached after step {passed}"
        passed += int(np.argmax(near))
    x, y, _ = (hand[: passed + 1] - centre).T
    swept, radius = np.unwrap(np.arctan2(x, -y)), np.hypot(x, y)
    print(f"{passed} of {len(hand)} steps on the circle: {np.degrees(swept[-1] - swept[0]):.0f} degrees, {1e3 * radius.min():.0f} to {1e3 * radius.max():.0f} mm from its centre")
    assert abs(swept[-1] - swept[0] - 2 * np.pi) < 0.75 and RADIUS / 4 < radius.min() and radius.max() < 2 * RADIUS
    gripper = trial["actions"].read()[:, -1]
    assert gripper[1] > 0.9 and gripper[-2] < -0.9, "the trigger closed it"
