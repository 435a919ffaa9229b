"""Sections are strict: only known keys, exact types, no edits; validators blame the key they mean."""

from pathlib import Path

import pytest
from pydantic import ValidationError, ValidationInfo, model_validator

from fabricate.config.section import ConfigFolder, Section, wrong_value


class Drill(Section):
    turns: int = 1
    depth: float = 2.0

    @model_validator(mode="after")
    def _deep_enough(self, info: ValidationInfo) -> "Drill":
        if isinstance(info.context, ConfigFolder) and self.turns > 9:
            raise wrong_value("drill.turns", f"{{too}} many for {info.context.path}")
        return self


@pytest.mark.parametrize(
    "keys", [{"turn": 2}, {"turns": "2"}, {"turns": 2.0}, {"turns": True}, {"depth": float("nan")}]
)
def test_anything_but_known_keys_of_their_types_is_refused(keys: dict[str, object]) -> None:
    with pytest.raises(ValidationError):
        Drill.model_validate(keys)


def test_a_section_cannot_be_edited() -> None:
    section = Drill(turns=2)
    with pytest.raises(ValidationError):
        section.turns = 3  # type: ignore[misc]
    assert section == Drill(turns=2)


def test_a_wrong_value_carries_its_key_and_sentence_as_they_are() -> None:
    with pytest.raises(ValidationError) as caught:
        Drill.model_validate({"turns": 10}, context=ConfigFolder(Path("here")))
    (details,) = caught.value.errors()
    assert (details["type"], details["msg"]) == ("wrong_value", "{too} many for here")
    assert details["ctx"]["key"] == "drill.turns"
