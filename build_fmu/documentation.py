"""Files in the FMU for people: documentation, licences, icon, reference experiment."""

from __future__ import annotations

import importlib.resources
import re
from collections.abc import Mapping
from typing import Final

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined, Template
from markupsafe import Markup

import apnc_core
from apnc_core.schema import Causality, Shape, Value, Variable
from apnc_core.settings import Setting
from build_fmu.controller import controller_model
from build_fmu.icon import icon_png
from build_fmu.model import Model
from build_fmu.options import BuildOptions, value_in_words
from build_fmu.reference import FOLDER, TICKS, TOLERANCE, reference_files
from build_fmu.terminals import ICON

_GREEK: Final = {
    name: chr(code)
    for name, code in {
        "alpha": 945, "gamma": 947, "theta": 952, "kappa": 954, "xi": 958, "rho": 961,
        "sigma": 963, "phi": 966,
    }.items()
}  # fmt: skip


def controller_documentation(options: BuildOptions) -> dict[str, bytes]:
    """Files of the controller by their path in the FMU.

    Args:
        options: what is built; names and tables follow it.
    """
    page = {
        "own_defaults": options.own_defaults(),
        "reference_folder": FOLDER if options.fmi == 2 else "",
        "reference_stop": f"{TICKS * options.parameters().Ts:g}",
        "reference_step": f"{options.parameters().Ts:g}",
        "reference_tolerance": f"{TOLERANCE:g}",
    }
    files = documentation(
        controller_model(options), page_of("build_fmu", "documentation_controller.html.j2"), page
    )
    return files | (reference_files(options) if options.fmi == 2 else {})


def page_of(package: str, name: str) -> Template:
    """A page that extends ``documentation.html.j2``.

    Args:
        package: whose folder ``templates`` holds it.
        name: of the file.
    """
    loader = ChoiceLoader([PackageLoader(package), PackageLoader("build_fmu")])
    env = Environment(loader=loader, undefined=StrictUndefined, autoescape=True)
    env.filters |= {"symbol": _symbol, "paper": _paper, "span": _span}
    return env.get_template(name)


def documentation(model: Model, page: Template, more: Mapping[str, object]) -> dict[str, bytes]:
    """Page, licences and icon of a model by their path in the FMU.

    Args:
        model: names and tables follow it.
        page: of :func:`page_of`.
        more: what else the page shows.
    """
    files = {
        "documentation/index.html": _rendered(model, page, more).encode(),
        "documentation/licenses/license.txt": _template_text("license.txt").encode(),
        "documentation/licenses/fmi_headers.txt": _licence_of_the_headers().encode(),
    }
    icon = "model.png" if model.fmi == 2 else ICON
    return files | {icon: icon_png()}


def _rendered(model: Model, page: Template, more: Mapping[str, object]) -> str:
    return page.render(
        model=model.identifier,
        version=apnc_core.__version__,
        legs=len(model.legs),
        leg_names=model.legs,
        right=len(model.legs) // 2,
        fmi="2.0" if model.fmi == 2 else "3.0",
        inputs=model.variables_of(Causality.input),
        outputs=model.variables_of(Causality.output),
        local=model.variables_of(Causality.local),
        parameters=model.variables_of(Causality.parameter),
        enumerations=[v for v in model.variables_of(Causality.parameter) if v.enumeration],
        of_paper=any(v.paper is not None for v in model.table),
        entry=lambda v: _entry(model, v),
        start=lambda v: value_in_words(v, _alike(model.start(v))),
        **more,
    )


def _entry(model: Model, v: Variable) -> str:
    """``leg[1].grf ... leg[4].grf``, or the one name of a scalar."""
    count = model.count(v)
    if model.arrays:
        return v.name if v.shape is Shape.scalar else f"{v.name} [{count}]"
    first, last = (v.scalar_name(i, model.naming) for i in (0, count - 1))
    return first if count == 1 else f"{first} ... {last}"


def _symbol(text: str) -> Markup:
    """``phi_1k`` with its index below and its Greek letter."""
    for name, letter in _GREEK.items():
        text = re.sub(rf"\b{name}(?=\b|_)", letter, text)
    text = re.sub(r"_(\w+)", r"<sub>\1</sub>", text)
    return Markup(re.sub(r"\^(\w+)", r"<sup>\1</sup>", text))


def _alike(values: tuple[Value, ...]) -> Setting:
    return values[0] if len(set(values)) == 1 else values


def _paper(v: Variable) -> str:
    return "" if v.paper is None else value_in_words(v, v.paper)


def _span(v: Variable) -> str:
    return "" if v.min is None or v.max is None else f"{v.min:g} ... {v.max:g}"


def _template_text(name: str) -> str:
    folder = importlib.resources.files("build_fmu").joinpath("templates")
    return folder.joinpath(name).read_text(encoding="utf-8")


def _licence_of_the_headers() -> str:
    """The licence that the headers of the standard carry, as it stands in them."""
    folder = importlib.resources.files("fmpy").joinpath("c-code")
    text = folder.joinpath("fmi2Functions.h").read_text(encoding="utf-8")
    start = text.index("Copyright")
    lines = [line.strip() for line in text[start : text.index("*/", start)].splitlines()]
    return "Headers of the FMI standard in sources/ (files fmi*.h)\n\n" + "\n".join(lines) + "\n"
