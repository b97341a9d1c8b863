"""Data that people write, checked by pydantic; every error is one line that names what is wrong."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, fields
from difflib import get_close_matches
from functools import cache, wraps
from pathlib import Path
from typing import Annotated, Any, Final, TypeVar, cast, dataclass_transform

from pydantic import ConfigDict, Field, PydanticUserError, TypeAdapter, ValidationError
from pydantic_core import ArgsKwargs

from apnc_core.in_python import in_python

Model = TypeVar("Model")
Location = tuple[int | str, ...]

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
"""A finite number; no text and no truth value."""

LONGEST: Final = 200
"""Characters of a refused value that a message shows."""

_UNKNOWN_KEY: Final = ("unexpected_keyword_argument", "extra_forbidden")


class KeyRefusedError(ValueError):
    """A value that does not fit to others of its table; a message then names where it is written.

    Args:
        key: its key in the table.
        words: what is wrong with it, and what is allowed.
    """

    def __init__(self, key: str, words: str) -> None:
        super().__init__(words)
        self.key = key


def limits(unit: str = "", allowed: str = "", **constraints: Any) -> Any:
    """Constraints of a field, and what a message says about them.

    Args:
        unit: unit of the numbers.
        allowed: words for what is allowed; without them they are made from the constraints.
        constraints: arguments of ``pydantic.Field``: ``gt``, ``ge``, ``le``, ``pattern`` and so on.
    """
    words: Any = {name: text for name, text in (("unit", unit), ("allowed", allowed)) if text}
    return Field(json_schema_extra=words, **constraints)


@dataclass_transform(frozen_default=True, field_specifiers=(field, Field))
def checked(error: type[ValueError]) -> Callable[[type[Model]], type[Model]]:
    """Decorator that makes a frozen dataclass, whose fields are checked by their types.

    Args:
        error: raised for a value that is not allowed, with the line of :func:`error_line`.

    Numbers and arrays of numpy are converted to Python's own. A field that holds such a dataclass
    also accepts a table of its values.
    """

    def decorate(cls: type[Model]) -> type[Model]:
        made: Any = dataclass(frozen=True)(cls)
        made.__pydantic_config__ = ConfigDict(extra="forbid")
        names = [each.name for each in fields(made)]

        @wraps(made.__init__)
        def init(self: Model, *args: Any, **values: Any) -> None:
            named = dict(zip(names, args, strict=False))  # so that an error names the field
            if len(named) < len(args) or named.keys() & values.keys():
                raise TypeError(f"{cls.__name__} takes each of {', '.join(names)} once")
            given = ArgsKwargs((), {k: in_python(v) for k, v in (named | values).items()})
            try:
                _adapter(made).validator.validate_python(given, self_instance=self)
            except ValidationError as refused:
                raise error(error_line(refused, made)) from None

        made.__init__ = init
        return cast(type[Model], made)

    return decorate


@cache
def _adapter(model: Any) -> TypeAdapter[Any]:
    """Validator of a model. It is built at the first use, because that takes long."""
    return TypeAdapter(model)


def read_table(path: Path) -> dict[str, Any]:
    """Content of a file: TOML if its name ends in ``.toml``, else JSON.

    Raises:
        ValueError: the file cannot be read, or its content is not a table.
    """
    kind = "TOML" if path.suffix == ".toml" else "JSON"
    try:
        text = path.read_text(encoding="utf-8")
        content = tomllib.loads(text) if kind == "TOML" else json.loads(text)
    except OSError as error:
        raise ValueError(f"cannot be read: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise ValueError(f"not readable as {kind} ({error})") from None
    if not isinstance(content, dict):
        raise ValueError("not a table of NAME: VALUE")
    return content


def checked_file(model: type[Model], path: Path | str) -> Model:
    """The object that a file describes.

    Args:
        model: a pydantic model, or a dataclass that may be :func:`checked`.
        path: TOML if its name ends in ``.toml``, else JSON.

    Raises:
        ValueError: one line with the path, the key, its value and what is allowed.
    """
    try:
        return checked_table(model, read_table(Path(path)))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def checked_table(
    model: type[Model],
    table: Mapping[str, Any],
    *,
    shown_as: Callable[[Location], Location] = lambda location: location,
) -> Model:
    """The object that a table describes.

    Args:
        model: as of :func:`checked_file`.
        table: values by name.
        shown_as: converts a location in the table to the one that the author of a file wrote.

    Raises:
        ValueError: one line with the key, its value and what is allowed.
    """
    try:
        made = _adapter(cast(Any, model)).validate_python(dict(table), context={"file": True})
        return cast(Model, made)
    except ValidationError as error:
        raise ValueError(error_line(error, model, shown_as)) from None


def error_line(
    error: ValidationError,
    model: Any,
    shown_as: Callable[[Location], Location] = lambda location: location,
) -> str:
    """An error of pydantic as one line with key, value and what is allowed.

    Of several errors the first is reported, or an unknown key, because a misspelt key explains why
    another is missing. Items of a list are counted from 1.

    Args:
        error: the error.
        model: the model that refused the values.
        shown_as: as of :func:`checked_table`.
    """
    found = sorted(error.errors(include_url=False), key=lambda e: e["type"] not in _UNKNOWN_KEY)[0]
    location, kind = found["loc"], found["type"]
    if kind == "missing" and location and isinstance(location[-1], int):
        location, kind = location[:-1], "too_short"  # a tuple that ends early
    own = found["ctx"]["error"] if kind == "value_error" else None
    shown = shown_as(location)
    if isinstance(own, KeyRefusedError):
        shown = shown_as((*location, own.key))[:-1]
    name = ""
    for key in shown:
        name += f"[{key + 1}]" if isinstance(key, int) else f".{key}" if name else key
    if own is not None:  # raised by a check of our own, whose text says what is allowed
        return ": ".join(filter(None, (name, str(own))))
    value = "missing" if kind == "missing" else repr(found["input"])
    if len(value) > LONGEST:
        value = f"{value[:LONGEST]} ..."
    schema = _schema_at(model, location[:-1] if kind in _UNKNOWN_KEY else location)
    if kind in _UNKNOWN_KEY:
        known = sorted(schema.get("properties", {}))
        close = get_close_matches(str(location[-1]), known, 1)
        allowed = f"only {', '.join(known)}" + (f"; did you mean {close[0]}?" if close else "")
    else:
        allowed = _words(schema) or found["msg"].removeprefix("Input should be ")
    return f"{name or 'it'} is {value}; allowed: {allowed}"


def _schema_at(model: Any, location: Location) -> dict[str, Any]:
    """JSON schema of a value in a model; empty if there is none."""
    try:
        whole = _adapter(model).json_schema()
        schema = _resolved(whole, whole.get("$defs", {}))
        for key in location:
            kinds = [each for each in schema.get("anyOf", ()) if each.get("type") != "null"]
            schema = kinds[0] if len(kinds) == 1 else schema
            if isinstance(key, int):
                schema = schema["prefixItems"][key] if "prefixItems" in schema else schema["items"]
            else:
                known = schema.get("properties", {})
                schema = known[key] if key in known else schema["additionalProperties"]
    except (PydanticUserError, TypeError, KeyError, IndexError):
        return {}
    return _of_optional(cast(dict[str, Any], schema))


def _of_optional(schema: dict[str, Any]) -> dict[str, Any]:
    """Schema of the table that may be left out; the schema itself if it is of something else."""
    tables = [each for each in schema.get("anyOf", ()) if "properties" in each]
    return tables[0] if len(tables) == 1 else schema


def _resolved(node: Any, named: Mapping[str, Any]) -> Any:
    """Part of a JSON schema in which references are replaced by their definitions."""
    if isinstance(node, list):
        return [_resolved(entry, named) for entry in node]
    if not isinstance(node, dict):
        return node
    for reference in (node, *node.get("allOf", ())):
        if "$ref" in reference:
            node = {**named[reference["$ref"].rpartition("/")[2]], **node}
    return {key: _resolved(entry, named) for key, entry in node.items() if key != "$ref"}


_KINDS: Final = {
    "number": ("a finite number", "finite numbers"),
    "integer": ("a whole number", "whole numbers"),
    "boolean": ("true or false", "truth values"),
    "string": ("a text", "texts"),
    "object": ("a table", "tables"),
}


def _words(schema: Mapping[str, Any], many: bool = False) -> str:
    """Words for what a JSON schema allows; empty if it allows anything."""
    if "allowed" in schema:
        return str(schema["allowed"])
    if "enum" in schema or "const" in schema:
        return " or ".join(map(str, schema.get("enum", [schema.get("const")])))
    if "anyOf" in schema:
        return " or ".join(_words(each) or "nothing" for each in schema["anyOf"])
    if schema.get("type") == "array":
        if items := schema.get("prefixItems"):
            return f"{len(items)} {_words(items[0], many=True)}"
        text = f"a list of {_words(schema.get('items', {}), many=True) or 'values'}"
        return f"{text}, at least {schema['minItems']}" if "minItems" in schema else text
    words = _KINDS.get(schema.get("type", ""), ("", ""))[many]
    return words and words + _bounds(schema) + (f" [{schema['unit']}]" if "unit" in schema else "")


def _bounds(schema: Mapping[str, Any]) -> str:
    low, above = schema.get("minimum"), schema.get("exclusiveMinimum")
    high, below = schema.get("maximum"), schema.get("exclusiveMaximum")
    if low is not None and high is not None:
        return f" from {low:g} to {high:g}"
    texts = (
        "" if above is None else f" above {above:g}",
        "" if low is None else f", {low:g} or more",
        "" if high is None else f" up to {high:g}",
        "" if below is None else f" below {below:g}",
    )
    return "".join(texts)
