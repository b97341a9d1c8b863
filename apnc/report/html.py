"""The frame of every report: one HTML file that needs nothing but a browser."""

from __future__ import annotations

import zlib
from base64 import b64encode
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, Final

import jinja2

from apnc.report.encoding import script_json
from apnc.report.figure import Figure
from apnc.report.theme import DARK

PLOTLY: Final = Path(__file__).parent / "plotly_basic" / "plotly-basic.min.js"
"""The basic bundle of plotly.js; its README tells where it is from."""


@cache
def _packed_plotly() -> str:
    """plotly.js as the page unpacks it: deflated (RFC 1950), in base64."""
    return b64encode(zlib.compress(PLOTLY.read_bytes(), 9)).decode("ascii")


def page(
    template: str,
    figures: Sequence[Figure],
    *,
    package: str = "apnc.report",
    scripts: Sequence[str] = (),
    data: Mapping[str, Any] | None = None,
    **context: Any,
) -> str:
    """Text of a page.

    Args:
        template: name of a template that extends ``base.html.j2`` (blocks title, style, header,
            main) and includes ``figure.html.j2`` for each figure.
        figures: of the page. A page with a figure contains plotly.js, packed to 0.5 MB.
        package: package with the template in its folder ``templates``.
        scripts: names of further templates that run as scripts, before the figures are drawn.
        data: what the scripts read as ``apnc.data``; ``time`` has the times of the figures.
        context: names in the template.
    """
    packages = dict.fromkeys((package, "apnc.report"))
    environment = jinja2.Environment(
        loader=jinja2.ChoiceLoader([jinja2.PackageLoader(p, "templates") for p in packages]),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )

    def source(name: str) -> str:
        assert environment.loader is not None
        return environment.loader.get_source(environment, name)[0]

    plotting = [source(name) for name in ("unpack.js", "plots.js")] if figures else []
    drawn = {"figures": [figure.to_dict() for figure in figures], "dark": DARK}
    drawn |= {"plotly": _packed_plotly()} if figures else {}
    return environment.get_template(template).render(
        figures=figures,
        css=source("style.css"),
        core=source("core.js"),
        scripts=[*(source(name) for name in scripts), *plotting],
        data=script_json({**(data or {}), **drawn}),
        **context,
    )
