"""Messages name a command that installs an extra where the person stands."""

from __future__ import annotations

import importlib.metadata
import json
from pathlib import Path
from typing import Any

import pytest

from apnc import extras


class Installed:
    """A distribution of which only the place it was installed from is known."""

    def __init__(self, place: dict[str, Any] | None) -> None:
        self.place = place

    def read_text(self, name: str) -> str | None:
        assert name == "direct_url.json"
        return None if self.place is None else json.dumps(self.place)


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "a check out"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


def install(place: dict[str, Any] | None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(importlib.metadata, "distribution", lambda name: Installed(place))


def test_in_the_checkout_it_is_the_folder_one_is_in(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install({"url": checkout.as_uri(), "dir_info": {}}, monkeypatch)
    assert extras.install_command("build") == 'pip install ".[build]"'
    assert extras.missing("mujoco", "mujoco") == (
        "'mujoco' is not installed: pip install \".[mujoco]\""
    )


def test_what_was_installed_to_be_edited_stays_so(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    install({"url": checkout.as_uri(), "dir_info": {"editable": True}}, monkeypatch)
    assert extras.install_command("build") == 'pip install -e ".[build]"'


def test_elsewhere_the_checkout_or_the_wheel_is_named(
    checkout: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    install({"url": checkout.as_uri(), "dir_info": {}}, monkeypatch)
    assert extras.install_command("build") == f'pip install "{checkout}[build]"'
    wheel = tmp_path / "apnc-1.0-py3-none-any.whl"
    wheel.write_bytes(b"")
    install({"url": wheel.as_uri(), "archive_info": {}}, monkeypatch)
    assert extras.install_command("build") == f'pip install "{wheel}[build]"'


@pytest.mark.parametrize(
    "place", [None, {"url": "file:///gone", "dir_info": {}}, {"url": "https://host/apnc.whl"}]
)
def test_without_a_checkout_it_is_the_name_of_the_package(
    place: dict[str, Any] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    install(place, monkeypatch)
    assert extras.install_command("build") == 'pip install "apnc[build]"'


def test_a_package_that_was_not_installed_is_asked_of_the_index(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def gone(name: str) -> None:
        raise importlib.metadata.PackageNotFoundError(name)

    monkeypatch.setattr(importlib.metadata, "distribution", gone)
    assert extras.install_command("build") == 'pip install "apnc[build]"'
