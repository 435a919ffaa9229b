"""Openings and a stand are said in the report, and handles are expected of them."""

from __future__ import annotations

import numpy as np

from fabricate.checks.expectations import Expectations
from fabricate.checks.facts import BaseFacts, FinishFacts
from fabricate.checks.finished import finish_facts, with_finish, with_handles
from fabricate.solid.booleans import Cylinder
from fabricate.solid.finish import Finished
from fabricate.solid.openings import Opening
from fabricate.solid.part import Part
from fabricate.solid.stand import Stand

EMPTY = Part("none", np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
FOOT = Cylinder(np.zeros(3), np.array([0.0, 0.0, 3.0]), 2.0)
UP = np.array([0.0, 0.0, 1.0])
READY = Finished(
    (),
    (EMPTY, EMPTY),
    (Opening("yellow", np.array([1.0, 2.0, 3.0]), UP, 3.5, 2.4), Opening("blue", np.zeros(3), UP, 3.5, 2.4)),
    Stand("yellow", 3.0, FOOT._replace(radius=20.0), (FOOT, FOOT, FOOT)),
)


def test_facts_say_where_and_how_large() -> None:
    facts = finish_facts(READY)
    assert facts.openings[0].at == (1.0, 2.0, 3.0)
    assert facts.openings[1].part == "blue"
    assert facts.base == BaseFacts("yellow", 3.0, 40.0, 3)


def test_openings_and_feet_are_handles_of_their_part() -> None:
    facts = finish_facts(READY)
    assert with_handles({"yellow": 0, "blue": 2}, facts) == {"yellow": 3, "blue": 3}
    assert with_handles({"yellow": 0, "blue": 2}, FinishFacts((), None)) == {"yellow": 0, "blue": 2}
    wanted = with_finish(Expectations(clearance=0.3, genus={"yellow": 0, "blue": 2}), READY)
    assert wanted.genus == {"yellow": 3, "blue": 3}
    assert wanted.clearance == 0.3
