"""The page is served on the loopback, to one page that knows the token and comes from here."""

from __future__ import annotations

import http.client
import socket
import time
from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest

pytest.importorskip("websockets")

from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from apnc.view.server import HOST, LONGEST, REFUSED, TAKEN, Server


class Source:
    """Tells every page the same, and keeps what it hears."""

    def __init__(self) -> None:
        self.heard: list[str | bytes] = []

    def greeting(self) -> list[str | bytes]:
        return ["hello"]

    def news(self, wait: float) -> list[str | bytes]:
        time.sleep(0.01)
        return [b"news"]

    def hear(self, message: str | bytes) -> None:
        if message == "bad":
            raise ValueError("not a wish")
        self.heard.append(message)


@pytest.fixture
def source() -> Source:
    return Source()


@pytest.fixture
def server(source: Source) -> Iterator[Server]:
    made = Server(lambda address: f"<p>{address}</p>", source)
    yield made
    made.close()


def get(address: str, path: str | None = None, host: str | None = None) -> tuple[int, str, str]:
    """Status, text and policy of an answer."""
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.netloc, timeout=10)
    connection.putrequest("GET", path or parts.path, skip_host=host is not None)
    if host is not None:
        connection.putheader("Host", host)
    connection.endheaders()
    answer = connection.getresponse()
    policy = answer.getheader("Content-Security-Policy") or ""
    return answer.status, answer.read().decode(), policy


def opened(
    address: str, *, origin: str | None = "own", token: str | None = None
) -> ClientConnection:
    parts = urlsplit(address)
    path = parts.path if token is None else f"/{token}/"
    own = f"http://{parts.netloc}" if origin == "own" else origin
    return connect(f"ws://{parts.netloc}{path}live", origin=own)  # type: ignore[arg-type]


def test_the_page_is_given_to_those_who_know_the_token(server: Server) -> None:
    parts = urlsplit(server.address)
    status, text, policy = get(server.address)
    assert status == 200 and text == f"<p>ws://{parts.netloc}{parts.path}live</p>"
    assert "frame-ancestors 'none'" in policy
    assert len(parts.path.strip("/")) >= 32
    for path in ("/", "/live", "/x/", f"{parts.path[:-2]}/", f"{parts.path}other", "/%C3%A9/"):
        assert get(server.address, path)[0] == 404


def test_every_server_has_a_token_of_its_own(server: Server, source: Source) -> None:
    other = Server(lambda address: "", source)
    try:
        assert urlsplit(other.address).path != urlsplit(server.address).path
    finally:
        other.close()


@pytest.mark.parametrize("host", ["evil.example", "localhost:1", "127.0.0.1", ""])
def test_another_host_name_is_refused(host: str, server: Server) -> None:
    assert get(server.address, host=host)[0] == 403


def test_nothing_listens_beyond_the_loopback(server: Server) -> None:
    assert HOST == "127.0.0.1"
    assert server._server.socket.getsockname()[0] == HOST
    assert server._server.socket.family == socket.AF_INET


@pytest.mark.parametrize("origin", [None, "null", "http://evil.example", "http://127.0.0.1"])
def test_a_page_of_another_origin_is_refused(origin: str | None, server: Server) -> None:
    with pytest.raises(InvalidStatus) as refused:
        opened(server.address, origin=origin)
    assert refused.value.response.status_code == 403
    assert not server.shown


def test_a_wrong_token_is_refused(server: Server) -> None:
    with pytest.raises(InvalidStatus) as refused:
        opened(server.address, token="x" * 32)
    assert refused.value.response.status_code == 404
    assert not server.shown


def test_one_page_at_a_time_is_told_and_heard(server: Server, source: Source) -> None:
    with opened(server.address) as page:
        assert [page.recv() for _ in range(2)] == ["hello", b"news"]
        page.send("wish")
        with opened(server.address) as second:
            with pytest.raises(ConnectionClosed) as closed:
                second.recv()
            assert closed.value.rcvd and closed.value.rcvd.code == TAKEN
        assert server.shown
        page.recv()
    end = time.monotonic() + 10.0
    while server.shown and time.monotonic() < end:
        time.sleep(0.01)
    with opened(server.address) as third:
        assert third.recv() == "hello"
    assert source.heard == ["wish"]


@pytest.mark.parametrize(("message", "code"), [("bad", REFUSED), ("x" * (LONGEST + 1), 1009)])
def test_what_is_not_understood_ends_the_connection(
    message: str, code: int, server: Server, source: Source
) -> None:
    with opened(server.address) as page:
        page.send(message)
        with pytest.raises(ConnectionClosed) as closed:
            while True:
                page.recv()
    assert closed.value.rcvd and closed.value.rcvd.code == code
    assert source.heard == []


def test_closing_ends_the_page(server: Server) -> None:
    with opened(server.address) as page:
        page.recv()
        server.close()
        with pytest.raises(ConnectionClosed):
            while True:
                page.recv()
    with pytest.raises(OSError, match=r"."):
        get(server.address)
