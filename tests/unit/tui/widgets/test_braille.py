"""A braille canvas: the dots of cells as codes and characters, and several canvases as one picture."""

from __future__ import annotations

import numpy as np
import pytest
from bot_console.tui.widgets.braille import BITS, BrailleCanvas, layered


def codes_by_dot(dots, width, height):
    """The codes according to the Unicode standard: a bit for each dot."""
    codes = np.zeros((height, width), np.uint8)
    for row, column in zip(*np.nonzero(dots), strict=True):
        codes[row // 4, column // 2] |= BITS[row % 4, column % 2]
    return codes


def pieces_by_cell(layers, styles, across):
    """Row by row and cell by cell: a blank belongs to the run before it, leading ones to the first run."""
    rows = []
    for cells in zip(*layers, strict=True):
        pieces = []
        for x in range(across):
            code = int(np.bitwise_or.reduce([each[x] for each in cells]))
            own = next((name for name, each in zip(styles, cells, strict=True) if each[x]), None)
            character = chr(0x2800 + code) if code else " "
            if not pieces or (own is not None and pieces[-1][1] not in (None, own)):
                pieces.append([character, own])
            else:
                pieces[-1] = [pieces[-1][0] + character, pieces[-1][1] if own is None else own]
        rows.append([(text, name or "") for text, name in pieces])
    return rows


@pytest.mark.parametrize("seed", range(30))
def test_canvases_equal_a_reference_drawn_dot_by_dot_and_cell_by_cell(seed):
    draw = np.random.default_rng(seed)
    width, height = int(draw.integers(1, 30)), int(draw.integers(1, 9))
    layers, styles = [], ["one", "two", "three"][: int(draw.integers(1, 4))]
    for _ in styles:
        dots = draw.random((height * 4, width * 2)) < draw.choice([0.0, 0.02, 0.3])
        canvas = BrailleCanvas(width, height)
        canvas.mask(dots)
        layers.append(codes_by_dot(dots, width, height))
        assert (canvas.codes() == layers[-1]).all()
        lettered = ["".join(chr(0x2800 + each) if each else " " for each in row) for row in layers[-1].tolist()]
        assert canvas.rows() == lettered
    assert layered(layers, styles, width, height) == pieces_by_cell(layers, styles, width)


def test_no_layers_give_a_blank_picture():
    assert layered([], [], 3, 2) == [[("   ", "")], [("   ", "")]]
