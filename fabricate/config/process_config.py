"""The section [process]: how the parts are made, and what that decides in [solid]."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from pydantic import Field

from fabricate.config.section import Section
from fabricate.config.shop_config import ShopConfig
from fabricate.process import PROCESSES, Process, ProcessName
from fabricate.units import format_length


class ProcessConfig(Section):
    """How the parts are made: defaults and limits."""

    name: ProcessName = "fdm"
    """Printing process."""
    shop: ShopConfig | None = Field(default=None, examples=[{"polygons": 1_000_000, "file_mb": 64.0}])
    """What the print shop accepts: parts are made to fit, or it is said why they do not; no limits unless given."""


PROCESS_DEFAULTS: Mapping[str, str] = MappingProxyType({"thickness": "wall_default", "clearance": "gap_default"})
"""Keys of [solid] whose default is the process' own, and the attribute of `Process` that holds it."""


def with_process_defaults(document: object) -> object:
    """Return a raw config whose [solid] has the defaults of its process; as it is if either is no section."""
    if not isinstance(document, dict):
        return document
    solid, process = document.get("solid", {}), _process(document.get("process", {}))
    if not isinstance(solid, dict) or process is None:
        return document
    defaults = {key: format_length(getattr(process, attribute)) for key, attribute in PROCESS_DEFAULTS.items()}
    return {**document, "solid": {**defaults, **solid}}


def _process(section: object) -> Process | None:
    """Return the process named by a section that may still be raw; None when validation will refuse it."""
    name = section.get("name", "fdm") if isinstance(section, dict) else getattr(section, "name", None)
    return PROCESSES.get(name) if isinstance(name, str) else None
