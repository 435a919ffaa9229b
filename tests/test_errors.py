from __future__ import annotations

import inspect

import pytest

from fabricate import errors
from fabricate.errors import FabricateError, OutputError

LEAVES = [
    kind
    for _, kind in inspect.getmembers(errors, inspect.isclass)
    if issubclass(kind, FabricateError) and kind is not FabricateError
]


def test_there_are_leaves() -> None:
    assert {kind.__name__ for kind in LEAVES} >= {"ConfigError", "ReadError", "MeshError", "PatternError"}


@pytest.mark.parametrize("kind", LEAVES)
def test_one_clause_catches_every_error_and_its_text_is_what_was_said(kind: type[FabricateError]) -> None:
    with pytest.raises(FabricateError, match=r"^the sentence$"):
        raise kind("the sentence")


@pytest.mark.parametrize("kind", LEAVES)
def test_each_error_is_also_the_builtin_that_python_callers_expect(kind: type[FabricateError]) -> None:
    assert issubclass(kind, OSError if kind is OutputError else ValueError)


@pytest.mark.parametrize("kind", [*LEAVES, FabricateError])
def test_each_error_says_what_it_means(kind: type[FabricateError]) -> None:
    assert kind.__doc__
    assert len(kind.__doc__.splitlines()) == 1


@pytest.mark.parametrize("kind", LEAVES)
def test_leaves_can_be_told_apart(kind: type[FabricateError]) -> None:
    assert [other for other in LEAVES if issubclass(kind, other)] == [kind]
