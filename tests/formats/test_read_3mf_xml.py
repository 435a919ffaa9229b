"""XML: elements are told in order, and nothing in a text can make it larger, deeper or slower than it is."""

from __future__ import annotations

import tracemalloc

import pytest

from fabricate.errors import ReadError
from fabricate.formats.read_3mf_xml import read_xml


class Told:
    """Remembers what it is told, and refuses an element that is named so."""

    def __init__(self) -> None:
        self.words: list[str] = []

    def declared(self, prefix: str | None, namespace: str) -> None:
        self.words.append(f"{prefix}={namespace}")

    def begun(self, name: str, attributes: dict[str, str]) -> None:
        if name == "refused":
            raise ReadError("an element was refused")
        self.words.append(f"<{name} {attributes}")

    def ended(self, name: str) -> None:
        self.words.append(f"{name}>")


def told(text: str | bytes, *, step: int = 1 << 20) -> list[str]:
    content = text.encode() if isinstance(text, str) else text
    listener = Told()
    read_xml((content[place : place + step] for place in range(0, len(content), step)), listener)
    return listener.words


TEXT = '<?xml version="1.0"?><a xmlns="u" xmlns:p="v" b="1"><p:c p:d="2"/><!-- note -->text</a>'
WORDS = ["None=u", "p=v", "<u}a {'b': '1'}", "<v}c {'v}d': '2'}", "v}c>", "u}a>"]


@pytest.mark.parametrize("step", [1, 7, 1000])
def test_elements_are_told_however_the_text_is_cut(step: int) -> None:
    assert told(TEXT, step=step) == WORDS


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1"])
def test_every_encoding_is_understood(encoding: str) -> None:
    declared = TEXT.replace('"1.0"?', f'"1.0" encoding="{encoding.removesuffix("-sig")}"?')
    assert told(declared.encode(encoding)) == WORDS


BILLION = (
    '<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY b "ha">'
    + "".join(f'<!ENTITY b{k} "{10 * f"&b{k - 1 if k else str()};"}">' for k in range(9))
    + "]><a>&b8;</a>"
)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "line 1: the XML is damaged"),
        ("<a>\n<b></a>", "line 2: the XML is damaged .mismatched tag"),
        ("<a>", "the XML is damaged"),
        ("<a>&b;</a>", "undefined entity"),
        ("<a\0/>", "the XML is damaged"),
        ('<?xml version="1.0"?>\n<!DOCTYPE a SYSTEM "file:///etc/passwd"><a/>', "line 2: a document type declaration"),
        (BILLION, "line 2: a document type declaration"),
        ('<?xml version="1.0" encoding="koi8-r"?><a/>', "UTF-8 or UTF-16 was expected, found 'koi8-r'"),
        ('<?xml version="1.0" encoding="shift_jis"?><a/>', "found 'shift_jis'"),
        ('<?xml version="1.0" encoding="none"?><a/>', "found 'none'"),
        ("<a>\n\n<refused/></a>", "line 3: an element was refused"),
    ],
    ids=lambda value: value if isinstance(value, str) and len(value) < 80 else "",
)
def test_faults_are_given_with_their_line(text: str, words: str) -> None:
    with pytest.raises(ReadError, match=words) as caught:
        told(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<a>" * 1_000_000, "nested less than 64 deep"),
        ("<r>" + "".join(f"<a{k}/>" for k in range(300_000)), "different names"),
        ("<r " + "".join(f'a{k}=""' for k in range(300_000)), "XML is damaged"),
        ('<r a="' + "x" * 10_000_000, "tags and comments of at most"),
        ("<r><!--" + "x" * 10_000_000, "tags and comments of at most"),
    ],
    ids=["depth", "names", "attributes", "tag", "comment"],
)
def test_texts_that_would_take_much_memory_or_time_are_left_early(text: str, words: str) -> None:
    content = text.encode()
    tracemalloc.start()
    with pytest.raises(ReadError, match=words):
        told(content, step=1 << 16)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 64_000_000
