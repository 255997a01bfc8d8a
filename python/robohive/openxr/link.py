"""The WebSocket of a session by hand."""

from __future__ import annotations

import json
from types import TracebackType
from typing import Any
from urllib.parse import urlsplit

from robohive.openxr.trouble import Trouble

#: Longest wait for the session to answer, or to take a message [s].
PATIENCE = 5.0


def socket_of(address: str) -> str:
    """Address of the WebSocket of a session, from the address that the session prints.

    Raises:
        Trouble: it is not such an address.
    """
    parts = urlsplit(address)
    key = parts.path.strip("/")
    if parts.scheme != "http" or not parts.hostname or not key or "/" in key:
        raise Trouble(
            f"{address!r} is not the address of a session; `robohive teleop ID --device openxr` prints one, such as http://127.0.0.1:8090/KEY"
        )
    return f"ws://{parts.netloc}/{key}/socket"


class Link:
    """A connection to a session, which takes one at a time."""

    def __init__(self, address: str) -> None:
        """Connects to the session at an address that it has printed.

        Raises:
            Trouble: the address is wrong, nobody listens there, or the session refuses.
        """
        target = socket_of(address)
        try:
            from websockets.exceptions import ConnectionClosed, WebSocketException
            from websockets.sync.client import connect
        except ImportError as error:
            raise Trouble.lacks("websockets", error) from error
        self._closed = ConnectionClosed
        try:
            # The session is on the loopback, or behind a tunnel that ends there: no proxy.
            self._socket = connect(target, open_timeout=PATIENCE, close_timeout=1.0, ping_interval=None, compression=None, proxy=None)
        except (OSError, WebSocketException) as error:
            raise Trouble(f"no session at {address}: {error}; take the address that `robohive teleop` prints now, with its key") from error

    def send(self, message: dict[str, Any]) -> bool:
        """Sends a message; false if the session has ended."""
        try:
            self._socket.send(json.dumps(message))
        except (self._closed, OSError):
            return False
        return True

    def __enter__(self) -> Link:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, traceback: TracebackType | None) -> None:
        self._socket.close()
