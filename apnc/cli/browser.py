"""Opens a page in the browser of the user."""

from __future__ import annotations

from apnc.cli.console import say


def open_page(address: str) -> None:
    """Open an address in the browser; where there is none, a line says what to open.

    Args:
        address: e.g. ``file:///home/me/apnc-walk/report.html``.
    """
    import webbrowser  # noqa: PLC0415  # seldom needed

    if not webbrowser.open(address):
        say(f"no browser found; open {address}")
