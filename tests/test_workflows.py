"""The workflows call the scripts of ``.ci/run`` and leave none out: each step is written once."""

from __future__ import annotations

import os
import re
import shlex
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).resolve().parent.parent
SCRIPTS = {path.name: path for path in (ROOT / ".ci").iterdir()}
WORKFLOWS = {
    path.name: yaml.safe_load(path.read_text())
    for path in (ROOT / ".github" / "workflows").glob("*.yml")
}
ONLY_FOR_A_RELEASE = {"version", "release"}


def scripts_called_from(lines: Iterable[str]) -> set[str]:
    """Scripts that these lines of shell call, and those that these call."""
    code = "\n".join(line for line in lines if not line.lstrip().startswith("#"))
    names = set(re.findall(r"\.ci/(\w+)", code))
    assert names <= set(SCRIPTS)
    texts = (SCRIPTS[name].read_text() for name in names)
    return names.union(*(scripts_called_from(text.splitlines()) for text in texts))


def commands(workflow: dict[str, Any]) -> list[str]:
    steps = [step for job in workflow["jobs"].values() for step in job.get("steps", ())]
    return [step["run"] for step in steps if "run" in step]


def test_run_calls_every_script() -> None:
    called = scripts_called_from(SCRIPTS["run"].read_text().splitlines())
    assert called == set(SCRIPTS) - {"run"} - ONLY_FOR_A_RELEASE


def test_the_workflows_call_every_script() -> None:
    lines = [command for workflow in WORKFLOWS.values() for command in commands(workflow)]
    assert scripts_called_from(lines) == set(SCRIPTS) - {"run"}


@pytest.mark.parametrize("name", WORKFLOWS)
def test_a_step_is_one_command(name: str) -> None:
    """Longer ones belong into a script, where shellcheck and ``.ci/run`` see them."""
    for command in commands(WORKFLOWS[name]):
        assert "\n" not in command.strip(), command
        assert shlex.split(command)[0].startswith((".ci/", "gh")), command


@pytest.mark.parametrize("name", WORKFLOWS)
def test_a_workflow_may_read_only_and_ends(name: str) -> None:
    workflow = WORKFLOWS[name]
    assert workflow["permissions"] == {"contents": "read"}
    assert "concurrency" in workflow
    for job in workflow["jobs"].values():
        assert "uses" in job or job["timeout-minutes"] <= 90


def test_the_lowest_python_is_tested() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    for name, job in (("test.yml", "default"), ("packages.yml", "walk")):
        lowest = WORKFLOWS[name]["jobs"][job]["strategy"]["matrix"]["python"][0]
        assert project["requires-python"] == f">={lowest}"


@pytest.mark.parametrize("name", SCRIPTS)
def test_a_script_can_be_called_and_stops_at_the_first_error(name: str) -> None:
    lines = SCRIPTS[name].read_text().splitlines()
    assert os.access(SCRIPTS[name], os.X_OK)
    assert lines[0] == "#!/usr/bin/env bash"
    assert "set -euo pipefail" in lines
