"""A headset of a test: the stand-in runtime, what its controllers do, and the bridge that reads them."""

import contextlib
import json
import os
import subprocess
import sys
import threading

import numpy as np
from displays import eventually
from websockets.sync.server import serve

#: Doubles of a hand in `runtime.c`, and of the whole stage.
HAND, STAGE = 15, 33
#: Where the fields of a hand begin.
FIELDS = {"position": slice(0, 3), "turn": slice(3, 7), "flags": 7, "trigger": 8, "squeeze": 9, "stick": slice(10, 12), "click": 12, "first": 13, "second": 14}
#: Valid and tracked, position and orientation.
TRACKED = 15
#: States of a session (XrSessionState).
STOPPED, SYNCHRONIZED, FOCUSED = 0, 3, 5


class Headset:
    """Two controllers that do what a test says."""

    def __init__(self, folder, manifest):
        path = folder / "stage"
        np.zeros(STAGE).tofile(path)
        self._stage = np.memmap(path, np.float64, "r+")
        self.environment = {"XR_RUNTIME_JSON": str(manifest), "STANDIN_STAGE": str(path), "XR_LOADER_DEBUG": "error"}
        for side in ("right", "left"):
            self.set(side, turn=[0, 0, 0, 1], flags=TRACKED)
        self.state(FOCUSED)

    def set(self, side, **fields):
        """Changes fields of a hand."""
        hand = self._stage[:HAND] if side == "right" else self._stage[HAND : 2 * HAND]
        for name, value in fields.items():
            hand[FIELDS[name]] = value

    def move(self, way):
        """Moves the right hand [m], along the axes of the headset."""
        self._stage[:3] += way

    def state(self, wanted):
        """The state to which the session goes."""
        self._stage[30] = wanted

    def centre(self):
        """A person centres the space again."""
        self._stage[31] += 1

    @property
    def frames(self):
        """Frames that were drawn, all of them empty."""
        return int(self._stage[32])


class Bridge:
    """A running `python -m robohive.openxr`."""

    def __init__(self, headset, *arguments, **environment):
        command = [sys.executable, "-m", "robohive.openxr", *arguments]
        self.process = subprocess.Popen(
            command, env={**os.environ, **headset.environment, **environment}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        self._said = []
        self._reader = threading.Thread(target=lambda: self._said.extend(self.process.stdout), daemon=True)
        self._reader.start()

    @property
    def said(self):
        return "".join(self._said)

    def end(self):
        """Its exit status, after it has ended."""
        status = self.process.wait(90)
        self._reader.join(90)
        return status

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()


class Listener:
    """A session that only listens."""

    def __init__(self):
        self.messages = []
        self._server = serve(self._take, "127.0.0.1", 0)
        self.address = f"http://127.0.0.1:{self._server.socket.getsockname()[1]}/0123456789abcdef"
        self._open = []
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def _take(self, connection):
        self._open.append(connection)
        self.path = connection.request.path
        for text in connection:
            self.messages.append(json.loads(text))

    def wait_for(self, is_so, what):
        """Waits for a message that is as wanted, among those that come from now on."""
        first = len(self.messages)
        eventually(lambda: any(map(is_so, self.messages[first:])), what)

    def wait_for_words(self, words):
        self.wait_for(lambda message: sorted(message["buttons"]) == sorted(words), f"the buttons are {words}")

    def close(self):
        for connection in self._open:
            connection.close()
        self._server.shutdown()


@contextlib.contextmanager
def listening():
    listener = Listener()
    try:
        yield listener
    finally:
        listener.close()
