"""Values of parameters: typed, in range, or refused in one line."""

import math

import pytest

from apnc_core.enumerations import KappaRule, Method
from apnc_core.presets import PRESETS, preset
from apnc_core.schema import Causality
from apnc_core.settings import checked, parse
from apnc_core.variables import variables_of

PARAMETERS = variables_of(Causality.parameter)


@pytest.mark.parametrize(
    ("name", "value", "expected"),
    [
        ("xi", 0.02, 0.02),
        ("xi", 1, 1.0),
        ("b1", -1.6, -1.6),
        ("N", 50, 50),
        ("N", 1, 1),
        ("N", 256, 256),
        ("phi_frozen", False, False),
        ("method", "tegotae", Method.tegotae),
        ("method", 2, Method.apc),
        ("kappa_rule", KappaRule.printed, KappaRule.printed),
        ("phi_stored", [3, -1.5, 0], (3.0, -1.5, 0.0)),
        ("phi_stored", (), ()),
        ("Ts", 1.0, 1.0),
    ],
)
def test_a_value_comes_back_in_the_type_of_its_parameter(
    name: str, value: object, expected: object
) -> None:
    result = checked(name, value)
    assert result == expected
    assert type(result) is type(expected)


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_passes_unchanged(name: str) -> None:
    chosen = preset(name)
    for variable in PARAMETERS:
        value = getattr(chosen, variable.name)
        assert checked(variable.name, value) == value


@pytest.mark.parametrize(
    "variable", [v for v in PARAMETERS if v.max is not None], ids=lambda v: v.name
)
def test_the_ends_of_every_range_are_in_and_what_lies_beyond_is_not(variable) -> None:  # type: ignore[no-untyped-def]
    whole = variable.type.value == "Integer"
    for limit, beyond in ((variable.min, -1), (variable.max, 1)):
        inside = int(limit) if whole else limit
        outside = inside + beyond * (1 if whole else max(1e-9, abs(limit) * 1e-9))
        many = [inside] if variable.name == "phi_stored" else inside
        assert checked(variable.name, many) in (inside, (inside,))
        with pytest.raises(ValueError, match=f"^{variable.name} = .*allowed: a "):
            checked(variable.name, [outside] if variable.name == "phi_stored" else outside)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("cow", 1, "parameter 'cow' is not one of Ts, robot_weight, F_max"),
        ("MI", 0.1, "parameter 'MI' is not one of Ts"),
        ("N", 3.7, "N = 3.7; allowed: a whole number from 1 to 256"),
        ("N", 3.0, "N = 3.0; allowed: a whole number"),
        ("N", True, "N = True"),
        ("N", 257, "N = 257; allowed: a whole number from 1 to 256"),
        ("xi", "much", "xi = 'much'; allowed: a number from 0 to 1"),
        ("xi", True, "xi = True"),
        ("xi", None, "xi = None"),
        ("xi", math.nan, "xi = nan"),
        ("xi", math.inf, "xi = inf"),
        ("Ts", 0, r"Ts = 0; allowed: a number from 0.0001 to 1 \[s\]"),
        ("phi_frozen", 1, "phi_frozen = 1; allowed: true or false"),
        ("phi_frozen", "true", "phi_frozen = 'true'"),
        ("method", "cow", "method = 'cow' is not one of apnc, apc, tegotae, phase_reset"),
        ("method", 0, "method = 0 is not one of apnc"),
        ("method", 5, "method = 5 is not one of apnc"),
        ("method", 1.0, "method = 1.0 is not one of apnc"),
        ("method", True, "method = True is not one of apnc"),
        ("phi_stored", 1.0, "phi_stored = 1.0; allowed: a list of numbers"),
        ("phi_stored", "12", "phi_stored = '12'; allowed: a list of numbers"),
        ("phi_stored", [1.0, "x"], r"phi_stored = \[1.0, 'x'\]; allowed: a number from -7 to 7"),
        ("phi_stored", [8.0], r"phi_stored = \[8.0\]"),
    ],
)
def test_what_a_parameter_cannot_be_is_refused_in_one_line(
    name: str, value: object, message: str
) -> None:
    with pytest.raises(ValueError, match=f"^{message}") as caught:
        checked(name, value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("xi=0.02", ("xi", 0.02)),
        (" xi = 1 ", ("xi", 1.0)),
        ("N=40", ("N", 40)),
        ("kappa_rule=armed", ("kappa_rule", KappaRule.armed)),
        ("kappa_rule=2", ("kappa_rule", KappaRule.printed)),
        ("phi_frozen=false", ("phi_frozen", False)),
        ("phi_stored=[1, 2]", ("phi_stored", (1.0, 2.0))),
    ],
)
def test_a_setting_in_words(text: str, expected: tuple[str, object]) -> None:
    assert parse(text) == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("cow=1", "parameter 'cow' is not one of Ts"),
        ("xi", "xi = ''; allowed: a number"),
        ("xi=", "xi = ''"),
        ("xi=1,5", "xi = '1,5'"),
        ("xi=NaN", "xi = nan"),
        ("N=3.7", "N = 3.7; allowed: a whole number"),
        ("Ts=1.5", "Ts = 1.5; allowed"),
        ("phi_frozen=yes", "phi_frozen = 'yes'; allowed: true or false"),
        ("kappa_rule=never", "kappa_rule = 'never' is not one of armed, printed"),
    ],
)
def test_words_that_set_nothing_are_refused(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        parse(text)
