"""The zip archive that a 3MF file is: its parts, unpacked piece by piece and never past their declared size."""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections.abc import Iterator
from types import MappingProxyType

from fabricate.errors import ReadError
from fabricate.formats.limits import DEFAULT_LIMITS, ReadLimits
from fabricate.formats.read_3mf_xml import read_xml

_RELATIONS = "_rels/.rels"
_RELATION = "http://schemas.openxmlformats.org/package/2006/relationships}Relationship"
_MODEL_RELATION = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_USUAL_MODEL = "3D/3dmodel.model"

_ENTRY_MARK = b"PK\x01\x02"
_MOST_ENTRIES = 100_000
_CHUNK_BYTES = 1 << 20
_ENCRYPTED = 1

_FAULTS = (
    zipfile.BadZipFile, zlib.error, struct.error, EOFError, OSError, OverflowError, RuntimeError, ValueError,
)  # fmt: skip
"""What zipfile raises on archives that are damaged or of kinds that it does not know."""


class Package:
    """The parts of a 3MF file.

    Raises
    ------
    ReadError
        If the content is no whole zip archive, or one that would unpack to more than is read.
    """

    def __init__(self, content: bytes, *, limits: ReadLimits = DEFAULT_LIMITS) -> None:
        if content.count(_ENTRY_MARK) > _MOST_ENTRIES:
            raise ReadError(f"a 3MF file with at most {_MOST_ENTRIES} entries was expected, found more")
        try:
            self._archive = zipfile.ZipFile(io.BytesIO(content))
        except _FAULTS as error:
            raise ReadError(f"the 3MF file is no whole zip archive ({_reason(error)})") from None
        entries = self._archive.infolist()
        limits.check_bytes(sum(entry.file_size for entry in entries), what="what is packed into the file")
        self._entries = MappingProxyType({part_name(entry.filename): entry for entry in entries})

    def model_name(self) -> str:
        """Return the name of the part that says what is built, the usual one if the package names none.

        Raises
        ------
        ReadError
            If the list of its relations is damaged.
        """
        relations = _Relations()
        if _RELATIONS in self._entries:
            read_xml(self.chunks(_RELATIONS), relations)
        return relations.target

    def chunks(self, name: str) -> Iterator[bytes]:
        """Unpack a part piece by piece.

        Raises
        ------
        ReadError
            If there is no such part, or it is encrypted, damaged or packed in a way that 3MF does not know.
        """
        entry = self._entries.get(part_name(name))
        if entry is None:
            raise ReadError(f"a 3MF file with a part {name[:120]!r} was expected, found a zip archive without it")
        if entry.flag_bits & _ENCRYPTED:
            raise ReadError(f"the part {name[:120]!r} is encrypted; save the file without a password")
        if entry.compress_type not in {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}:
            raise ReadError(f"the part {name[:120]!r} is packed in a way that 3MF does not allow; save it anew")
        try:
            with self._archive.open(entry) as stream:
                while chunk := stream.read(_CHUNK_BYTES):
                    yield chunk
        except _FAULTS as error:
            raise ReadError(f"the part {name[:120]!r} cannot be unpacked ({_reason(error)})") from None


def part_name(name: str) -> str:
    """Return a part's name as parts are compared: from the root, in any case."""
    return name.lstrip("/").lower()


class _Relations:
    """Finds the model among the relations of a package."""

    def __init__(self) -> None:
        self.target = part_name(_USUAL_MODEL)

    def declared(self, prefix: str | None, namespace: str) -> None:
        pass

    def begun(self, name: str, attributes: dict[str, str]) -> None:
        if name == _RELATION and attributes.get("Type") == _MODEL_RELATION and "Target" in attributes:
            self.target = part_name(attributes["Target"])

    def ended(self, name: str) -> None:
        pass


def _reason(error: Exception) -> str:
    return " ".join(str(error).split())[:120] or type(error).__name__
