"""Puts the parts together into one HTML file that needs nothing but a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import jinja2
from markupsafe import Markup
from plotly.offline import get_plotlyjs

from apnc.loop.recording import Record
from apnc.report.animation import animation_data
from apnc.report.encoding import packed, script_json
from apnc.report.figures import Figure, all_figures
from apnc.report.theme import leg_colours
from apnc.report.wording import rows, verdicts
from apnc.summary import Summary
from exudyn_models.robot.model import RobotDescription

_SCRIPTS: Final = ("plots.js", "scene.js", "animation.js")


def write_report(
    record: Record, summary: Summary, path: Path | str, robot: RobotDescription | None = None
) -> Path:
    """Write the self-contained report of a run.

    Args:
        record: the run, finished or interrupted.
        summary: its key figures.
        path: HTML file to write; its folder must exist.
        robot: the robot that walked, for the animation; None draws straight legs.

    Returns:
        The path written.

    Raises:
        OSError: the file cannot be written.
        ValueError: the robot lacks a leg of the record.

    Pitfall: the file carries plotly.js (about 5 MB) and every sample; it is no archive format.
    """
    target = Path(path)
    target.write_text(render(record, summary, robot), encoding="utf-8")
    return target


def render(record: Record, summary: Summary, robot: RobotDescription | None = None) -> str:
    """HTML text of the report, see ``write_report``."""
    figures = all_figures(record, summary) if len(record) else []
    environment = _environment()
    template = environment.get_template("report.html.j2")
    return template.render(
        summary=summary,
        verdicts=verdicts(summary),
        rows=rows(summary),
        colours=leg_colours(record.legs),
        figures=figures,
        css=Markup(_source(environment, "style.css")),
        scripts=[Markup(_source(environment, name)) for name in _SCRIPTS],
        plotly=Markup(get_plotlyjs()),
        data=Markup(script_json(_data(record, figures, robot))),
    )


def _data(record: Record, figures: list[Figure], robot: RobotDescription | None) -> dict[str, Any]:
    return {
        "time": packed(record.time, "<f4"),
        "figures": [
            {"key": f.key, "data": f.data, "layout": f.layout, "overTime": f.over_time}
            for f in figures
        ],
        "animation": animation_data(record, robot),
    }


def _environment() -> jinja2.Environment:
    loader = jinja2.PackageLoader("apnc.report", "templates")
    return jinja2.Environment(loader=loader, autoescape=True, undefined=jinja2.StrictUndefined)


def _source(environment: jinja2.Environment, name: str) -> str:
    assert environment.loader is not None
    return environment.loader.get_source(environment, name)[0]
