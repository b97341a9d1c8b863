"""What lies in the FMU for people: documentation, licences, icon, reference experiment."""

from __future__ import annotations

import importlib.resources
import re
from typing import Final

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

import apnc_core
from apnc_core.legs import leg_names
from apnc_core.schema import Causality, Shape, Value, Variable
from apnc_core.variables import rows
from build_fmu.icon import icon_png
from build_fmu.options import MODEL, BuildOptions, Setting, in_words
from build_fmu.reference import FOLDER, TICKS, TOLERANCE, reference_files

_GREEK: Final = {
    name: chr(code)
    for name, code in {
        "alpha": 945, "gamma": 947, "theta": 952, "kappa": 954, "xi": 958, "rho": 961,
        "sigma": 963, "phi": 966,
    }.items()
}  # fmt: skip


def documentation(options: BuildOptions) -> dict[str, bytes]:
    """Files by their path in the FMU.

    Args:
        options: what is built; names and tables follow it.
    """
    files = {
        "documentation/index.html": _page(options).encode(),
        "documentation/licenses/license.txt": _template_text("license.txt").encode(),
        "documentation/licenses/fmi_headers.txt": _licence_of_the_headers().encode(),
    }
    if options.fmi == 2:
        files["model.png"] = icon_png()
        files |= reference_files(options)
    else:
        files["terminalsAndIcons/icon.png"] = icon_png()
    return files


def _page(options: BuildOptions) -> str:
    env = Environment(loader=PackageLoader("build_fmu"), undefined=StrictUndefined, autoescape=True)
    env.filters |= {"symbol": _symbol, "paper": _paper, "span": _span, "entry": _entry(options)}
    env.filters["start"] = lambda v: in_words(v.name, _alike(options.start(v)))
    names = leg_names(options.legs)
    return env.get_template("documentation.html.j2").render(
        model=MODEL,
        version=apnc_core.__version__,
        legs=options.legs,
        leg_names=names,
        right=options.legs // 2,
        own_defaults=options.own_defaults(),
        fmi="2.0" if options.fmi == 2 else "3.0",
        inputs=rows(Causality.input),
        outputs=rows(Causality.output),
        local=rows(Causality.local),
        parameters=rows(Causality.parameter),
        enumerations=[v for v in rows(Causality.parameter) if v.enumeration],
        reference_folder=FOLDER if options.fmi == 2 else "",
        reference_stop=f"{TICKS * options.parameters().Ts:g}",
        reference_step=f"{options.parameters().Ts:g}",
        reference_tolerance=f"{TOLERANCE:g}",
    )


def _entry(options: BuildOptions) -> object:
    def name(v: Variable) -> str:
        """``leg[1].grf ... leg[4].grf``, or the one name a row has."""
        count = v.count(options.legs)
        if v.shape is Shape.scalar or options.fmi == 3:
            return v.name if v.shape is Shape.scalar else f"{v.name} [{count}]"
        first, last = (v.scalar_name(i, options.naming) for i in (0, count - 1))
        return first if count == 1 else f"{first} ... {last}"

    return name


def _symbol(text: str) -> Markup:
    """``phi_1k`` with its index below and its Greek letter."""
    for name, letter in _GREEK.items():
        text = re.sub(rf"\b{name}(?=\b|_)", letter, text)
    text = re.sub(r"_(\w+)", r"<sub>\1</sub>", text)
    return Markup(re.sub(r"\^(\w+)", r"<sup>\1</sup>", text))


def _alike(values: tuple[Value, ...]) -> Setting:
    return values[0] if len(set(values)) == 1 else values


def _paper(v: Variable) -> str:
    return "" if v.paper is None else in_words(v.name, v.paper)


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
