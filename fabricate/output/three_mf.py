"""Parts as one 3MF file: names, colours and places kept, one thing to print."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Sequence
from io import BytesIO
from itertools import accumulate
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
MATERIALS, OBJECT = 1, 2  # resource ids
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest date a zip can hold: the same bytes every time


def write_3mf(path: Path, parts: Sequence[Part], *, name: str) -> None:
    """Write parts as one 3MF object of several parts, in millimetres, in the places they have to each other.

    All parts are one mesh object called `name`, the only thing to build: no reader can move them apart. Each part
    is a named set of its triangles with a named colour. The object stands on the build plate in the positive
    octant, as the specification advises. PrusaSlicer finds one object of several parts, as it writes them itself;
    its readers ignore core materials, and the first part goes to extruder 1, the second to 2 and so on. An object of
    `<components>` would become several objects there, each dropped to the bed by itself.

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
            "Metadata/Slic3r_PE_model.config": _prusaslicer_config(parts, name),
        }.items():
            entry = zipfile.ZipInfo(file, EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text, compresslevel=4)
    write_whole(path, buffer.getvalue())


def _model(parts: Sequence[Part], name: str) -> str:
    starts = accumulate((len(part.points) for part in parts), initial=0)
    triangles = "".join(_triangles(part, k, start) for k, (part, start) in enumerate(zip(parts, starts, strict=False)))
    sets = "".join(
        f'     <t:triangleset name={_attribute(part.name)} identifier="part-{number}">\n'
        f"{_members(first, last)}     </t:triangleset>\n"
        for number, (part, (first, last)) in enumerate(zip(parts, _ranges(parts), strict=True), start=1)
    )
    return f"""{XML}<model unit="millimeter" xml:lang="en-US" \
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" \
xmlns:t="http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07" \
xmlns:slic3rpe="http://schemas.slic3r.org/3mf/2017/06">
 <metadata name="slic3rpe:Version3mf">1</metadata>
 <resources>
{_materials(parts)}\
  <object id="{OBJECT}" type="model" name={_attribute(name)} pid="{MATERIALS}" pindex="0">
   <mesh>
    <vertices>
{"".join(map(_vertices, parts))}    </vertices>
    <triangles>
{triangles}    </triangles>
    <t:trianglesets>
{sets}    </t:trianglesets>
   </mesh>
  </object>
 </resources>
 <build>
  <item objectid="{OBJECT}" transform="1 0 0 0 1 0 0 0 1 {_to_build_plate(parts)}"/>
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


def _vertices(part: Part) -> str:
    # One formatting operation per list: nine digits are enough to find each float32 again.
    text = '<vertex x="%.9g" y="%.9g" z="%.9g"/>\n' * len(part.points)
    return text % tuple(part.points.ravel().tolist())


def _triangles(part: Part, number: int, start: int) -> str:
    """Return the triangles of a part in its colour; its points begin at number `start`."""
    colour = f' pid="{MATERIALS}" p1="{number}"' if number else ""  # the object's own is that of the first part
    text = f'<triangle v1="%d" v2="%d" v3="%d"{colour}/>\n' * len(part.triangles)
    return text % tuple((part.triangles + start).ravel().tolist())


def _members(first: int, last: int) -> str:
    # One element each: lib3mf does not read the ranges that the extension has as well.
    return '<t:ref index="%d"/>\n' * (last + 1 - first) % tuple(range(first, last + 1))


def _ranges(parts: Sequence[Part]) -> list[tuple[int, int]]:
    """Return the numbers of each part's first and last triangle."""
    ends = [*accumulate(len(part.triangles) for part in parts)]
    return [(end - len(part.triangles), end - 1) for part, end in zip(parts, ends, strict=True)]


def _to_build_plate(parts: Sequence[Part]) -> str:
    """Return the move that brings the lowest corner of the box round all parts to the origin."""
    low = np.min([part.points.min(axis=0) for part in parts], axis=0)
    return " ".join(f"{-value + 0.0:.9g}" for value in low)


def _prusaslicer_config(parts: Sequence[Part], name: str) -> str:
    """Which extruder prints which triangles of the object."""
    volumes = "".join(
        f"""  <volume firstid="{first}" lastid="{last}">
   <metadata type="volume" key="name" value={_attribute(part.name)}/>
   <metadata type="volume" key="volume_type" value="ModelPart"/>
   <metadata type="volume" key="extruder" value="{number}"/>
  </volume>
"""
        for number, (part, (first, last)) in enumerate(zip(parts, _ranges(parts), strict=True), start=1)
    )
    return f"""{XML}<config>
 <object id="{OBJECT}" instances_count="1">
  <metadata type="object" key="name" value={_attribute(name)}/>
{volumes} </object>
</config>
"""


def _attribute(text: str) -> str:
    """Quote a text for XML; characters that XML can't hold become question marks."""
    allowed = "\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff"
    return quoteattr(re.sub(f"[^{allowed}]", "?", text))
