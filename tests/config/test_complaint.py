"""Whatever is wrong with a config is said in one sentence: its key, what was expected, what was found."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

import pytest
from pydantic import ValidationError

from fabricate.config import Config
from fabricate.config.complaint import first_complaint
from fabricate.config.section import ConfigFolder

TORUS = '[source]\nshape = "torus"\n'
LOCK = '[[pattern.locks]]\njoined = "yellow"\n'


@dataclass(frozen=True)
class Mistake:
    text: str
    words: tuple[str, ...]


MISTAKES = [
    # what to divide
    Mistake("", ("source:", "shape", "path", "neither")),
    Mistake("[source]", ("source:", "neither")),
    Mistake("source = 3", ("expected a section [source]", "found 3")),
    Mistake('[source]\nshape = "tors"', ("source.shape", '"tors"', 'did you mean "torus"?')),
    Mistake('[source]\nshape = "double_torus"', ('did you mean "double-torus"?',)),
    Mistake("[source]\nshape = 3", ("source.shape", "found 3")),
    Mistake("[source]\nshape = []", ("source.shape", "found []")),
    Mistake('[source]\nshpae = "torus"', ("source.shpae", "unknown key", "source.shape?")),
    Mistake('[sorce]\nshape = "torus"', ("sorce", "unknown", "did you mean source?")),
    Mistake(TORUS + 'path = "a.obj"', ("source.shape", "either shape or path", "not both")),
    Mistake('[source]\npath = ""', ("source.path", "text", '""')),
    Mistake("[source]\npath = 3", ("source.path", "found 3")),
    Mistake('[source]\npath = "a\\u0000b"', ("source.path", "expected text")),
    Mistake('[source]\npath = "a.obj"\naround = 3', ("source.around", '"torus"', '"knot"', "path, size")),
    Mistake('[source]\nshape = "sphere"\naround = 3', ("source.around", '"torus"', '"knot"', "frequency")),
    Mistake('[source]\nshape = "sphere"\nface = "triangles"', ("source.face", "source.faces?")),
    Mistake('[source]\nshape = "sphere"\nfaces = "squares"', ("source.faces", '"hexagons"', '"squares"')),
    Mistake('[source]\nshape = "sphere"\nfrequency = 33', ("source.frequency", "at most 32", "33")),
    Mistake('[source]\nshape = "cube"\ndivisions = 0', ("source.divisions", "at least 1", "found 0")),
    Mistake('[source]\nshape = "cube"\ndivisions = 2.0', ("source.divisions", "whole number", "2.0")),
    Mistake('[source]\nshape = "cube"\ndivisions = true', ("source.divisions", "whole number", "true")),
    Mistake('[source]\nshape = "cube"\nTorusConfig = 1', ("source.TorusConfig", "unknown key")),
    Mistake(TORUS + "tube = 1.0", ("source.tube", "less than 1", "found 1.0")),
    Mistake(TORUS + "tube = 0.0", ("source.tube", "more than 0")),
    Mistake('[source]\nshape = "knot"\ntube = 0.77', ("source.tube", "at most 0.76")),
    Mistake(TORUS + "size = 100", ("source.size", "unit", '"100 mm"')),
    Mistake(TORUS + 'size = "100"', ("source.size", "unit", '"100 mm"')),
    Mistake(TORUS + 'size = "wide"', ("source.size", "length", '"wide"')),
    Mistake(TORUS + "size = true", ("source.size", "a length", "true")),
    Mistake(TORUS + "size = 1979-05-27", ("source.size", "a length", "1979-05-27")),
    Mistake(TORUS + 'size = "0 mm"', ("source.size", "more than 0 mm", '"0 mm"')),
    Mistake(TORUS + 'size = "11000 mm"', ("source.size", "at most 10000 mm")),
    Mistake(TORUS + "size = nan", ("source.size", "length")),
    # the curve
    Mistake(TORUS + "[patern]\nseed = 1", ("patern", "did you mean pattern?")),
    Mistake(TORUS + "[[pattern]]\nseed = 1", ("pattern:", "expected a section [pattern]")),
    Mistake(TORUS + "[pattern]\nsed = 1", ("pattern.sed", "unknown key", "did you mean pattern.seed?")),
    Mistake(TORUS + "[pattern]\nxyz = 1", ("pattern.xyz", "known here", "pattern.tile_size")),
    Mistake(TORUS + "[pattern]\nseed = -1", ("pattern.seed", "at least 0", "-1")),
    Mistake(TORUS + '[pattern]\nseed = "x"', ("pattern.seed", "whole number", '"x"')),
    Mistake(TORUS + '[pattern]\nlevels = 2\ntile_size = "7 mm"', ("levels", "tile_size", "not both")),
    Mistake(TORUS + "[pattern]\nlevels = 13", ("pattern.levels", "at most 12", "13")),
    Mistake(TORUS + '[pattern]\ntile_size = "0 mm"', ("pattern.tile_size", "more than 0 mm")),
    Mistake(TORUS + '[pattern]\ntile_size = "101 mm"', ("pattern.tile_size", "not larger than the body", "100 mm")),
    Mistake(TORUS + '[pattern]\ntree = "Random"', ("pattern.tree", 'did you mean "random"?')),
    Mistake(TORUS + '[pattern]\ntree = ["random"]', ("pattern.tree", '["random"]')),
    Mistake(TORUS + "[pattern]\narc = 0.293", ("pattern.arc", "more than 0.293", "less than 0.707")),
    Mistake(TORUS + "[pattern]\narc = nan", ("pattern.arc", "a number", "NaN")),
    Mistake(TORUS + '[pattern]\nroot = ["1 mm", "2 mm"]', ("pattern.root", "three lengths", "found")),
    Mistake(TORUS + '[pattern]\nroot = ["1 mm", "2 mm", 3]', ("pattern.root[2]", "unit", '"3 mm"')),
    Mistake(TORUS + "[pattern]\nlocks = 3", ("pattern.locks:", "tables [[pattern.locks]]", "found 3")),
    Mistake(TORUS + "[pattern]\nlocks = [3]", ("pattern.locks[0]:", "found 3")),
    Mistake(TORUS + LOCK, ("pattern.locks[0]", "expected one of tiles, near with within, or side")),
    Mistake(TORUS + LOCK + "tiles = []", ("pattern.locks[0].tiles:", "numbers of tiles", "found []")),
    Mistake(TORUS + LOCK + "tiles = [0, -1]", ("pattern.locks[0].tiles[1]:", "numbers of tiles", "found -1")),
    Mistake(TORUS + LOCK + "tile = [0]", ("pattern.locks[0].tile:", "did you mean tiles?")),
    Mistake(TORUS + LOCK + "side = { normal = [0, 0, 1] }", ("pattern.locks[0].side.point:", "found nothing")),
    Mistake(TORUS + LOCK.replace("yellow", "green"), ("pattern.locks[0].joined:", '"blue"', "green")),
    # what the curve follows
    Mistake(TORUS + "field = 3", ("source.field",)),
    Mistake("field = 3\n" + TORUS, ("field:", "expected a section [field]", "found 3")),
    Mistake(TORUS + "[field]", ("field:", 'expected kind = "..."', "found none")),
    Mistake(TORUS + "[field]\nkinds = 3", ("field.kinds", "unknown key", "did you mean field.kind?")),
    Mistake(TORUS + '[field]\nkind = "hight"', ("field.kind", '"direction"', 'did you mean "height"?')),
    Mistake(TORUS + '[field]\nkind = "height"', ("field:", "nothing follows", 'tree = "field"')),
    Mistake(TORUS + '[field]\nkind = "height"\nlines = "circles"', ("field.lines", 'kind = "direction"')),
    Mistake(TORUS + '[field]\nkind = "height"\naxis = [0, 0, 0]', ("field.axis", "three zeros")),
    Mistake(TORUS + '[field]\nkind = "height"\nreverse = 1', ("field.reverse", "true or false", "found 1")),
    Mistake(TORUS + '[field]\nkind = "image"', ("field.image", "expected text", "found nothing")),
    Mistake(TORUS + '[pattern]\ntree = "field"', ("pattern.tree", "section [field]", "found none")),
    # the parts
    Mistake(TORUS + '[solid]\nthicknes = "2 mm"', ("solid.thicknes", "did you mean solid.thickness?")),
    Mistake(TORUS + 'thickness = "2 mm"', ("source.thickness", "did you mean solid.thickness?")),
    Mistake(TORUS + '[solid]\nthickness = "0 mm"', ("solid.thickness", "more than 0 mm")),
    Mistake(TORUS + "[solid]\nthickness = [1]", ("solid.thickness", "a length", "or a table of min, max, by", "[1]")),
    Mistake(TORUS + '[solid.thickness]\nmin = "1 mm"', ("solid.thickness.max", "a length", "found nothing")),
    Mistake(TORUS + "[solid.thickness]\nmin = 1", ("solid.thickness.min", "unit", '"1 mm"')),
    Mistake(
        TORUS + '[solid]\nthickness = { min = "3 mm", max = "2 mm", by = "height" }',
        ("solid.thickness.min", "at most max, 2 mm", '"3 mm"'),
    ),
    Mistake(
        TORUS + '[solid]\nthickness = { min = "1 mm", max = "50 mm", by = "height" }',
        ("solid.thickness", "half the size", '"50 mm"'),
    ),
    Mistake(
        TORUS + '[solid]\nthickness = { min = "1 mm", max = "2 mm", by = "heigth" }',
        ("solid.thickness.by", 'did you mean "height"?'),
    ),
    Mistake(TORUS + "[solid]\nopenings = { count = 2 }", ("solid.openings.diameter", "a length", "found nothing")),
    Mistake(
        TORUS + '[solid]\nopenings = { diameter = "3 mm", count = 0 }', ("solid.openings.count", "at least 1", "0")
    ),
    Mistake(TORUS + '[solid]\ncore = "blue"\nopenings = { diameter = "3 mm" }', ("solid.openings", 'core = "blue"')),
    Mistake(TORUS + '[solid]\njoint = "toungue"', ("solid.joint", '"straight", "draft", "tongue"', "tongue")),
    Mistake(TORUS + "[solid]\ndraft = 3", ("solid.draft", "deg")),
    Mistake(TORUS + '[solid]\ndraft = "50 deg"', ("solid.draft", "less than 45 deg")),
    Mistake(TORUS + '[solid]\ntongue = { height = "0 mm" }', ("solid.tongue.height", "more than 0 mm")),
    Mistake(
        TORUS + '[solid]\njoint = "tongue"\nthickness = "1 mm"\ntongue = { width = "1.2 mm" }',
        ("solid.tongue.width", "0.8 mm", "1.2 mm"),
    ),
    Mistake(TORUS + "[solid]\nopenings = 3", ("solid.openings", "a table of diameter, count", "found 3")),
    Mistake(TORUS + '[solid]\nbase = { heigth = "3 mm" }', ("solid.base.heigth", "did you mean height?")),
    Mistake(TORUS + '[solid]\nthickness = "50 mm"', ("solid.thickness", "half the size", "50 mm")),
    Mistake(TORUS + 'size = "4 mm"', ("solid.thickness", "half the size", '"2.4 mm"')),
    Mistake(TORUS + '[solid]\nclearance = "-0.1 mm"', ("solid.clearance", "at least 0 mm", '"-0.1 mm"')),
    Mistake(TORUS + '[solid]\nclearance = "9.6 mm"', ("solid.clearance", "four times", "9.6 mm")),
    Mistake(TORUS + '[solid]\ntolerance = "0 mm"', ("solid.tolerance", "more than 0 mm")),
    Mistake(TORUS + '[solid]\ncore = "bleu"', ("solid.core", 'did you mean "blue"?')),
    # how they are made
    Mistake(TORUS + '[process]\nname = "fmd"', ("process.name", 'did you mean "fdm"?')),
    Mistake(TORUS + "[process]\nname = []", ("process.name", "found []")),
    Mistake('process = "fdm"\n' + TORUS, ("expected a section [process]", '"fdm"')),
    Mistake('seed = "3"\n' + TORUS, ("seed", "unknown", "did you mean pattern.seed?")),
]


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda mistake: mistake.text[-40:])
def test_a_mistake_is_named(mistake: Mistake) -> None:
    document = tomllib.loads(mistake.text)
    with pytest.raises(ValidationError) as caught:
        Config.model_validate(document, context=ConfigFolder(Path()))
    complaint = first_complaint(caught.value, document)
    message = f"{complaint.key}: {complaint.sentence}"
    assert "\n" not in message
    assert not [word for word in mistake.words if word not in message], message


def test_an_unknown_key_comes_before_what_is_missing_for_it() -> None:
    document = {"source": {"shape": "double-torus", "holes": 0.5, "hole": 2.0}}
    with pytest.raises(ValidationError) as caught:
        Config.model_validate(document)
    assert first_complaint(caught.value, document).key == "source.holes"
