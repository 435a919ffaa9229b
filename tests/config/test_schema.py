"""The schema describes configs as they are written, not as they are kept in memory."""

import json
from typing import Any

from fabricate.config.schema import json_schema


def test_the_schema_shows_configs_as_they_are_written() -> None:
    schema: dict[str, Any] = json.loads(json.dumps(json_schema()))
    pattern = schema["$defs"]["PatternConfig"]["properties"]
    tile_size = pattern["tile_size"]
    assert (tile_size["anyOf"][0]["const"], tile_size["anyOf"][1]["type"]) == ("auto", "string")
    assert tile_size["default"] == "7 mm"
    assert (pattern["levels"]["type"], pattern["levels"]["maximum"]) == ("integer", 12)
    assert "default" not in pattern["levels"]
    assert schema["$defs"]["SolidConfig"]["properties"]["thickness"]["default"] == "2.4 mm"
    assert "null" not in json.dumps(schema)
    sections = {"source", "prepare", "pattern", "curve", "field", "optimise", "solid", "process"}
    assert sections == set(schema["properties"])
    assert all(not each.get("additionalProperties", True) for each in schema["$defs"].values())
