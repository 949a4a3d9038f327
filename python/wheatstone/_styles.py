"""Styles of paintings."""

import dataclasses
import numbers
import os

import numpy as np

from . import _arguments, _wheatstone


@dataclasses.dataclass
class Style:
    """A preset, or a style file (.toml), and what is to differ from it; None: as it has it.

    The parameters are the options of `wheatstone paint`, whose help explains them.
    """

    preset: str | os.PathLike = "oil"
    radii: list | None = None
    absolute_radii: bool | None = None
    threshold: float | None = None
    grid: float | None = None
    blur: float | None = None
    curvature: float | None = None
    opacity: float | None = None
    min_length: int | None = None
    max_length: int | None = None
    jitter_hue: float | None = None
    jitter_saturation: float | None = None
    jitter_value: float | None = None
    jitter_red: float | None = None
    jitter_green: float | None = None
    jitter_blue: float | None = None
    fineness: float | None = None
    strokes: int | None = None
    bristle: float | None = None
    streaks: float | None = None
    ridge: float | None = None
    dry: float | None = None
    brush: str | os.PathLike | None = None
    dual: bool | None = None
    texture: bool | None = None
    marks: str | None = None
    colours: int | None = None
    tile: float | None = None
    depth_test: bool | None = None
    depth_threshold: float | None = None
    follow_depth_edges: bool | None = None
    occlusion_dilation: float | None = None
    propagation: str | None = None
    orientation: str | None = None
    reference_filter: str | None = None
    background: str | None = None
    canvas_colour: str | None = None
    seed: int = 1

    def toml(self):
        """The style as a style file."""
        return made(self).toml()


def made(style):
    """The library's own style of a Style, or of the name of a preset or file."""
    if not isinstance(style, Style):
        style = Style(style)
    changes = {}
    for field in dataclasses.fields(style):
        value = getattr(style, field.name)
        if field.name not in ("preset", "seed") and value is not None:
            changes[field.name.replace("_", "-")] = _text(field.name, value)
    return _wheatstone.style(_arguments.path("style", style.preset), changes, _arguments.seed(style.seed))


def _text(name, value):
    """A parameter as it is typed on a command line."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)) or getattr(value, "ndim", 0) == 1:
        return ",".join(_text(name, entry) for entry in value)
    return str(value) if isinstance(value, numbers.Real) and abs(value) < 1e300 else _arguments.text(name, value)
