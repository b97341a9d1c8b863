"""Serves a page and its websocket on the loopback of this machine, to those with the token."""

from __future__ import annotations

import http
import logging
import secrets
import threading
import time
from collections.abc import Callable
from typing import Any, Final, Protocol

HOST: Final = "127.0.0.1"
LONGEST: Final = 1000
"""Largest message of a page [bytes]."""

TAKEN: Final = 4409
"""Code with which a second page is closed."""

REFUSED: Final = 1008
"""Code with which a page is closed whose message is not understood."""

PAUSE: Final = 0.015
"""Least time between two messages to the page [s]."""


class Source(Protocol):
    """What a page is told, and who hears what it asks for."""

    def greeting(self) -> list[str | bytes]:
        """Messages to a page that was opened."""

    def news(self, wait: float) -> list[str | bytes]:
        """Messages since the last call; it waits for some for at most a time [s]."""

    def hear(self, message: str | bytes) -> None:
        """Take a message of the page.

        Raises:
            ValueError: it is not understood.
        """


class Server:
    """One page at ``http://127.0.0.1:PORT/TOKEN/`` and its websocket at ``live`` below.

    Requests without the token, for another host name or from pages of another origin are refused.
    One page is shown at a time.

    Args:
        page: makes the page for the address of its websocket.
        source: what it is told.

    Attributes:
        address: of the page.
        left_at: when the last page was closed, see ``time.monotonic`` [s].

    Raises:
        ModuleNotFoundError: the extra ``view`` is not installed.
        OSError: no port is free.
    """

    def __init__(self, page: Callable[[str], str], source: Source) -> None:
        from websockets.sync.server import serve  # noqa: PLC0415  # an extra

        self._source, self._token = source, secrets.token_urlsafe(24)
        self._one, self._shown = threading.Lock(), threading.Event()
        self._connection: Any = None
        self.left_at = time.monotonic()
        quiet = logging.getLogger("apnc.view")
        quiet.addHandler(logging.NullHandler())
        quiet.propagate = False
        self._server = serve(
            self._talk, HOST, 0, process_request=self._answer, max_size=LONGEST,
            compression=None, logger=quiet,
        )  # fmt: skip
        self._name = f"{HOST}:{self._server.socket.getsockname()[1]}"
        self.address = f"http://{self._name}/{self._token}/"
        self._page = page(f"ws://{self._name}/{self._token}/live").encode()
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    @property
    def shown(self) -> bool:
        """Whether a page is open."""
        return self._shown.is_set()

    def wait(self, seconds: float) -> bool:
        """Wait until a page is open, for at most a time [s]; whether one is."""
        return self._shown.wait(seconds)

    def close(self) -> None:
        """End all connections."""
        self._server.shutdown()
        if connection := self._connection:
            connection.close()
        self._thread.join(timeout=5.0)

    def _answer(self, connection: Any, request: Any) -> Any:
        """The page or a refusal; None lets a websocket be opened."""
        if request.headers.get_all("Host") != [self._name]:
            return connection.respond(http.HTTPStatus.FORBIDDEN, "another host\n")
        root, _, path = request.path.removeprefix("/").partition("/")
        if not secrets.compare_digest(root.encode(), self._token.encode()):
            return connection.respond(http.HTTPStatus.NOT_FOUND, "nothing here\n")
        if path == "live":
            if request.headers.get_all("Origin") != [f"http://{self._name}"]:
                return connection.respond(http.HTTPStatus.FORBIDDEN, "another origin\n")
            return None
        if path:
            return connection.respond(http.HTTPStatus.NOT_FOUND, "nothing here\n")
        return self._response()

    def _response(self) -> Any:
        from websockets.datastructures import Headers  # noqa: PLC0415  # an extra
        from websockets.http11 import Response  # noqa: PLC0415  # as well

        headers = Headers({
            "Content-Type": "text/html; charset=utf-8",
            "Content-Length": str(len(self._page)),
            "Cache-Control": "no-store",
            "Connection": "close",
            "Content-Security-Policy": "frame-ancestors 'none'",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
        })  # fmt: skip
        return Response(200, "OK", headers, self._page)

    def _talk(self, connection: Any) -> None:
        if not self._one.acquire(blocking=False):
            connection.close(TAKEN, "the walk is shown in another page")
            return
        gone = threading.Event()
        told = threading.Thread(target=self._tell, args=(connection, gone), daemon=True)
        self._connection = connection
        self._shown.set()
        told.start()
        try:
            for message in connection:
                self._source.hear(message)
        except ValueError as error:
            connection.close(REFUSED, str(error))
        finally:
            gone.set()
            connection.close()
            told.join()
            self._connection, self.left_at = None, time.monotonic()
            self._shown.clear()
            self._one.release()

    def _tell(self, connection: Any, gone: threading.Event) -> None:
        from websockets.exceptions import ConnectionClosed  # noqa: PLC0415  # an extra

        try:
            for message in self._source.greeting():
                connection.send(message)
            while not gone.wait(PAUSE):
                for message in self._source.news(0.1):
                    connection.send(message)
        except ConnectionClosed:
            pass
