from __future__ import annotations

from time import perf_counter

from fabricate.stopwatch import Stopwatch


def test_each_stage_is_told_and_ends_where_the_next_begins() -> None:
    told: list[str] = []
    start = perf_counter()
    watch = Stopwatch(told.append)
    for stage in ("read", "cut"):
        watch.begin(stage)
    watch.tell("step")
    seconds, passed = watch.ended(), perf_counter() - start
    assert told == ["read", "cut", "step"]
    assert list(seconds) == ["read", "cut"]
    assert min(seconds.values()) >= 0.0
    assert sum(seconds.values()) <= passed


def test_a_copy_goes_on_alone() -> None:
    watch = Stopwatch(lambda _: None)
    watch.begin("read")
    watch.stop()
    other = watch.copy()
    other.begin("cut")
    assert list(watch.ended()) == ["read"]
    assert list(other.ended()) == ["read", "cut"]
    assert other.ended()["read"] == watch.ended()["read"]
