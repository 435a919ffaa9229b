"""What a type does not say in words is said in its metadata."""

from typing import Annotated

from pydantic.fields import FieldInfo

from fabricate.config.expectation import expectation
from fabricate.config.takes import Takes


def test_the_words_are_those_of_the_message() -> None:
    assert expectation(FieldInfo.from_annotation(Annotated[str, Takes("a colour")])) == "a colour"
