"""``report.html`` and ``claims.md``: figures and the table of claims of one or all studies."""

from __future__ import annotations

import importlib.resources
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup
from plotly.offline import get_plotlyjs

import apnc_core
from apnc.bench.run import machine
from apnc.report.encoding import script_json
from apnc.studies.evaluation.claims import Claim, Finding, findings
from apnc.studies.evaluation.figures import figures_of
from apnc.studies.evaluation.grids import STUDIES
from apnc.studies.evaluation.trial import Row


def write_evaluation(rows: Sequence[Row], folder: Path, wall_s: float | None = None) -> None:
    """Write ``report.html`` and ``claims.md`` for the studies that have rows.

    Args:
        rows: finished trials.
        folder: existing folder.
        wall_s: wall time of the trials that this call ran [s], for the header.

    Raises:
        OSError: a file cannot be written.
    """
    parts = [_part(name, [r for r in rows if r["study"] == name]) for name in STUDIES]
    parts = [part for part in parts if part["trials"]]
    facts = _facts(rows, wall_s)
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("apnc.studies", "evaluation/templates"),
        autoescape=jinja2.select_autoescape(["j2", "html"]),
        undefined=jinja2.StrictUndefined,
    )
    page = environment.get_template("evaluation.html.j2").render(
        parts=parts,
        facts=facts,
        plotly=Markup(get_plotlyjs()),
        data=Markup(script_json([f for part in parts for f in part["plots"]])),
        css=Markup(_style()),
    )
    (folder / "report.html").write_text(page, encoding="utf-8")
    (folder / "claims.md").write_text(_markdown(parts, facts), encoding="utf-8")


def _style() -> str:
    return (
        importlib.resources.files("apnc.report")
        .joinpath("templates", "style.css")
        .read_text("utf-8")
    )


def _part(name: str, rows: Sequence[Row]) -> dict[str, Any]:
    study = STUDIES[name]
    figures = figures_of(name, rows)
    return {
        "name": name,
        "title": study.title,
        "place": study.place,
        "trials": len(rows),
        "errors": sum(bool(r["error"]) for r in rows),
        "figures": [
            {"id": f"{name}-{i}", "title": f.title, "note": f.note, "height": f.layout["height"]}
            for i, f in enumerate(figures)
        ],
        "plots": [
            {"id": f"{name}-{i}", "data": f.data, "layout": f.layout} for i, f in enumerate(figures)
        ],
        "claims": findings(rows, name) if rows else [],
    }


def _facts(rows: Sequence[Row], wall_s: float | None) -> dict[str, str]:
    simulated = sum(float(r["duration"]) for r in rows)
    hashes = sorted({str(r["parameters"]) for r in rows if r.get("parameters")})
    m = machine()
    facts = {
        "trials": f"{len(rows)}, {simulated:.0f} s simulated",
        "machine": m["processor"],
        "version": f"apnc {apnc_core.__version__}, commit {m['commit']}",
        "parameters": ", ".join(hashes) if len(hashes) <= 3 else f"{len(hashes)} sets",
    }
    if wall_s:
        facts["wall time"] = f"{wall_s / 60:.1f} min"
    return facts


def _markdown(parts: list[dict[str, Any]], facts: dict[str, str]) -> str:
    lines = [f"- {name}: {text}" for name, text in facts.items()]
    lines += ["", "| paper says | where | measured (median and 95 % interval) | verdict |"]
    lines += ["|---|---|---|---|"]
    rows: list[tuple[Claim, Finding]] = [pair for part in parts for pair in part["claims"]]
    for claim, finding in rows:
        measured = finding.measured.replace("|", "/")
        lines.append(f"| {claim.text} | {claim.place} | {measured} | **{finding.verdict}** |")
    return "\n".join(lines) + "\n"
