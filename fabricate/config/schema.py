"""The JSON schema of config files, for editors."""

from __future__ import annotations

from typing import Any

from pydantic.json_schema import GenerateJsonSchema, JsonSchemaValue
from pydantic_core import core_schema

from fabricate.config.config import Config
from fabricate.units import format_length


def json_schema() -> dict[str, Any]:
    """Return the JSON schema of a config file, for editors that complete and check TOML."""
    schema = Config.model_json_schema(schema_generator=_EditorSchema)
    return {"$schema": _EditorSchema.schema_dialect, **schema}


class _EditorSchema(GenerateJsonSchema):
    """The schema of what stands in a TOML file: no null, and lengths as text even as defaults."""

    def nullable_schema(self, schema: core_schema.NullableSchema) -> JsonSchemaValue:
        return self.generate_inner(schema["schema"])

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> JsonSchemaValue:
        shown = super().default_schema(schema)
        default = shown.get("default")
        if default is None or isinstance(default, dict):
            shown.pop("default", None)
        elif shown.get("type") == "string" and isinstance(default, float):
            shown["default"] = format_length(default)
        return shown
