"""Divide a closed surface by one closed curve, and make two interlocking printable solids of it.

The names below are the straight line, stage by stage; each takes what the one before returned.
"""

from fabricate.checks.judge import judged_parts
from fabricate.checks.measured import expectations
from fabricate.duotone.certificate import certified
from fabricate.duotone.spanning_tree import grown_duotone
from fabricate.errors import FabricateError
from fabricate.formats.source import read_closed
from fabricate.mesh.torus import torus
from fabricate.output.sculpture import write_sculpture
from fabricate.solid.settling import fitted_cut
from fabricate.solid.solids import solids
from fabricate.surface.sizing import sized, tiled

__all__ = [
    "FabricateError",
    "certified",
    "expectations",
    "fitted_cut",
    "grown_duotone",
    "judged_parts",
    "read_closed",
    "sized",
    "solids",
    "tiled",
    "torus",
    "write_sculpture",
]
