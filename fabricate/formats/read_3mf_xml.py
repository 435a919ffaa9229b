"""Reading XML of unknown origin piece by piece: nothing in it can make it larger than it is."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol
from xml.parsers import expat

from fabricate.errors import ReadError

_DEEPEST = 64
"""Elements within elements; a model has less than ten, and each takes memory until it is closed."""

_MOST_NAMES = 10_000
"""Different names of elements and attributes; a model has about a hundred, and all are remembered."""

_LONGEST_TAG = 1 << 22
"""Bytes from one `<` to its `>`: a tag is read from its begin with every chunk until it is whole."""

_ENCODINGS = frozenset({"utf-8", "utf-16", "utf-16le", "utf-16be", "us-ascii", "iso-8859-1"})


class XmlListener(Protocol):
    """What is told of elements as they are read; names are `namespace}name`, attributes without one just `name`."""

    def declared(self, prefix: str | None, namespace: str) -> None:
        """Take note that a prefix stands for a namespace."""

    def begun(self, name: str, attributes: dict[str, str]) -> None:
        """Take note of the begin of an element."""

    def ended(self, name: str) -> None:
        """Take note of the end of an element."""


def read_xml(chunks: Iterable[bytes], listener: XmlListener) -> None:
    """Tell a listener of all elements in an XML text that comes in chunks.

    Raises
    ------
    ReadError
        If it is no well-formed XML, declares its own entities, or is nested, named or spread out as no model is;
        and if the listener raises one. The message gives the line.
    """
    parser = expat.ParserCreate(namespace_separator="}")
    parser.StartDoctypeDeclHandler = _refuse_doctype
    parser.XmlDeclHandler = _check_encoding
    depth = 0

    def begun(name: str, attributes: dict[str, str]) -> None:
        nonlocal depth
        depth += 1
        if depth > _DEEPEST:
            raise ReadError(f"elements were expected to be nested less than {_DEEPEST} deep")
        listener.begun(name, attributes)

    def ended(name: str) -> None:
        nonlocal depth
        depth -= 1
        listener.ended(name)

    parser.StartNamespaceDeclHandler = listener.declared
    parser.StartElementHandler, parser.EndElementHandler = begun, ended
    try:
        read = 0
        for chunk in chunks:
            parser.Parse(chunk, False)
            read += len(chunk)
            _check_memory(parser, read)
        parser.Parse(b"", True)
    except expat.ExpatError as error:
        raise ReadError(f"line {error.lineno}: the XML is damaged ({expat.ErrorString(error.code)})") from None
    except ReadError as error:
        raise ReadError(f"line {parser.CurrentLineNumber}: {error}") from None


def _check_memory(parser: expat.XMLParserType, read: int) -> None:
    if len(parser.intern) > _MOST_NAMES:
        raise ReadError(f"at most {_MOST_NAMES} different names of elements and attributes were expected, found more")
    if read - parser.CurrentByteIndex > _LONGEST_TAG:
        raise ReadError(f"tags and comments of at most {_LONGEST_TAG} bytes were expected, found a longer one")


def _refuse_doctype(*_: object) -> None:
    raise ReadError("a document type declaration was found, which 3MF does not allow")


def _check_encoding(_version: str, encoding: str | None, _standalone: int) -> None:
    if encoding is not None and encoding.lower() not in _ENCODINGS:
        raise ReadError(f"text in UTF-8 or UTF-16 was expected, found {encoding[:40]!r}")
