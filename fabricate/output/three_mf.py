"""Parts as one 3MF file: names, colours and places kept, one thing to print."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np

from fabricate.output.files import write_whole
from fabricate.picture.palette import part_colours
from fabricate.solid.part import Part

XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
CONTENT_TYPES = (
    XML
    + """<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
 <Default Extension="config" ContentType="application/xml"/>
</Types>
"""
)
RELATIONSHIPS = (
    XML
    + """<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Id="model" Target="/3D/3dmodel.model" \
Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
)
MATERIALS = 1  # resource id; mesh objects follow from 2 on, the object that holds them is the last
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date a zip can hold: the same bytes every time


def write_3mf(path: Path, parts: Sequence[Part], *, name: str) -> None:
    """Write parts as one 3MF model in millimetres, in the places they have to each other.

    Each part is a mesh object of its own with its name and colour; one object called `name` holds them
    as components and is the only thing to build, so that readers have to keep them together. It stands
    on the build plate in the positive octant, as the specification advises. For PrusaSlicer, whose
    readers ignore core materials, the first part goes to extruder 1, the second to 2 and so on.

    The XML is written here and not by lib3mf: that scales coordinates in single precision before it
    prints them, and moves one in seven by a unit in the last place. Here a reader gets
    exactly the float32 coordinates of the parts.

    Raises
    ------
    ValueError
        If there are no parts, or one of them has no triangles.
    OutputError
        If the file can't be written.
    """
    empty = [part.name for part in parts if len(part.triangles) == 0]
    if empty or not parts:
        raise ValueError(f"expected parts with triangles, found {len(parts)} parts, without triangles: {empty}")
    buffer = BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for file, text in {
            "[Content_Types].xml": CONTENT_TYPES,
            "_rels/.rels": RELATIONSHIPS,
            "3D/3dmodel.model": _model(parts, name),
            "Metadata/Slic3r_PE_model.config": _prusaslicer_config(parts),
        }.items():
            entry = zipfile.ZipInfo(file, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text, compresslevel=4)
    write_whole(path, buffer.getvalue())


def _model(parts: Sequence[Part], name: str) -> str:
    ids = range(MATERIALS + 1, MATERIALS + 1 + len(parts))
    assembly = MATERIALS + 1 + len(parts)
    components = "".join(f'   <component objectid="{part_id}"/>\n' for part_id in ids)
    return f"""{XML}<model unit="millimeter" xml:lang="en-US" \
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <resources>
{_materials(parts)}{"".join(map(_mesh_object, parts, ids))}\
  <object id="{assembly}" type="model" name={_attribute(name)}>
   <components>
{components}   </components>
  </object>
 </resources>
 <build>
  <item objectid="{assembly}" transform="1 0 0 0 1 0 0 0 1 {_to_build_plate(parts)}"/>
 </build>
</model>
"""


def _materials(parts: Sequence[Part]) -> str:
    colours = part_colours([part.name for part in parts])
    bases = "".join(
        f'   <base name={_attribute(part.name)} displaycolor="#{red:02X}{green:02X}{blue:02X}"/>\n'
        for part, (red, green, blue) in zip(parts, colours, strict=True)
    )
    return f'  <basematerials id="{MATERIALS}">\n{bases}  </basematerials>\n'


def _mesh_object(part: Part, part_id: int) -> str:
    # One formatting operation per list: nine digits are enough to find each float32 again.
    vertices = '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n' * len(part.points)
    triangles = '<triangle v1="%d" v2="%d" v3="%d"/>\n' * len(part.triangles)
    material = f'pid="{MATERIALS}" pindex="{part_id - MATERIALS - 1}"'
    return f"""  <object id="{part_id}" type="model" name={_attribute(part.name)} {material}>
   <mesh>
    <vertices>
{vertices % tuple(part.points.ravel().tolist())}    </vertices>
    <triangles>
{triangles % tuple(part.triangles.ravel().tolist())}    </triangles>
   </mesh>
  </object>
"""


def _to_build_plate(parts: Sequence[Part]) -> str:
    """Return the move that brings the lowest corner of the box round all parts to the origin."""
    low = np.min([part.points.min(axis=0) for part in parts], axis=0)
    return " ".join(f"{-value + 0.0:.9g}" for value in low)


def _prusaslicer_config(parts: Sequence[Part]) -> str:
    """Which extruder prints which triangles of which object; without the ranges objects load empty."""
    objects = "".join(
        f""" <object id="{number + MATERIALS}" instances_count="1">
  <metadata type="object" key="name" value={_attribute(part.name)}/>
  <metadata type="object" key="extruder" value="{number}"/>
  <volume firstid="0" lastid="{len(part.triangles) - 1}">
   <metadata type="volume" key="name" value={_attribute(part.name)}/>
   <metadata type="volume" key="volume_type" value="ModelPart"/>
   <metadata type="volume" key="extruder" value="{number}"/>
  </volume>
 </object>
"""
        for number, part in enumerate(parts, start=1)
    )
    return f"{XML}<config>\n{objects}</config>\n"


def _attribute(text: str) -> str:
    """Quote a text for XML; characters that XML can't hold become question marks."""
    allowed = "\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff"
    return quoteattr(re.sub(f"[^{allowed}]", "?", text))
