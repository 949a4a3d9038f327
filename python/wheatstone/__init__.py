"""Stereo and multi-view painterly rendering, and particle rendering for 3D displays.

Pictures are NumPy arrays of uint8 and shape (height, width, 3); disparities are float32 of shape (height, width), in
pixels, larger is nearer. Long calls release the interpreter's lock and end with Ctrl-C.
"""

import dataclasses as _dataclasses
import os as _os

import numpy as _np

from . import _wheatstone
from ._wheatstone import __version__

__all__ = ["Column", "Geometry", "Painting", "Style", "column_density", "load", "match", "paint", "render"]


@_dataclasses.dataclass
class Geometry:
    """Where every pixel of a rectified pair lies."""

    left_disparity: _np.ndarray
    right_disparity: _np.ndarray
    left_occlusion: _np.ndarray
    right_occlusion: _np.ndarray
    found_share: float


@_dataclasses.dataclass
class Style:
    """A preset, or a style file (.toml), with changes to its parameters: Style("impressionist", {"threshold": 60})."""

    preset: str = "impressionist"
    parameters: dict = _dataclasses.field(default_factory=dict)
    seed: int = 1

    def toml(self):
        """The style as a style file."""
        return self._made().toml()

    def _made(self):
        def text(value):
            if isinstance(value, bool):
                return "true" if value else "false"
            if isinstance(value, (list, tuple)):
                return ",".join(str(entry) for entry in value)
            return str(value)

        changes = {name.replace("_", "-"): text(value) for name, value in self.parameters.items()}
        return _wheatstone.style(self.preset, changes, self.seed)


class Painting:
    """Marks and the surfaces of their scene: drawn for any view."""

    def __init__(self, made):
        self._made = made

    @property
    def left(self):
        """The left eye's picture."""
        return self._made.left

    @property
    def right(self):
        """The right eye's picture."""
        return self._made.right

    @property
    def width(self):
        return self._made.width

    @property
    def height(self):
        return self._made.height

    def views(self, count, span=1.0, screen_disparity=None):
        """`count` views, leftmost first, as an array of shape (count, height, width, 3).

        `span` is the distance from the first view to the last in eye separations; the photographs' eyes are 1 apart.
        `screen_disparity` lies on the screen, in pixels; the middle of the scene's by default.
        """
        return self._made.views(count, span, screen_disparity)

    def save(self, path):
        """Writes the painting as .wst."""
        self._made.save(path)

    def _repr_png_(self):
        return _wheatstone.png(_np.concatenate([self.left, self.right], axis=1))


def match(left, right, quality="good"):
    """Disparities of a rectified pair. `quality` is fast, good or best."""
    return Geometry(**_wheatstone.match(left, right, quality))


def paint(left, right, style="impressionist", *, quality="good", disparity=None):
    """Paints a rectified pair so that the marks of both eyes fuse.

    `style` is a Style, the name of a preset or a style file. `disparity` is that of the left picture, where it is known.
    """
    if not isinstance(style, Style):
        style = Style(_os.fspath(style))
    return Painting(_wheatstone.paint(left, right, style._made(), quality, disparity))


@_dataclasses.dataclass
class Column:
    """Mass per area along the lines of sight."""

    values: _np.ndarray
    """Of shape (height, width), the top row first, in units of mass and length of what was given."""
    extent: tuple
    """Left, right, bottom and top edge in the scene's unit of length, from the middle: as Matplotlib's imshow takes it."""


def _options(views, size, span, **camera):
    options = _wheatstone.RenderOptions(views, tuple(size), span)
    for name, value in camera.items():
        if value is not None:
            setattr(options, name, value)
    return options


def render(particles, *, density=None, temperature=None, smoothing_length=None, mass=None, views=2, size=(640, 360),
           span=1.0, azimuth=None, elevation=None, zoom=None, exposure=None):
    """Views of particles, leftmost first, as an array of shape (views, height, width, 3).

    `particles` is a file (GADGET, HDF5, PLY, LAS, NumPy, FITS or text), or positions of shape (number, 3). The views
    show mass; with `exposure` they are those of `--look thesis`.
    """
    options = _options(views, size, span, azimuth=azimuth, elevation=elevation, zoom=zoom, exposure=exposure)
    columns = {"density": density, "temperature": temperature, "smoothing_length": smoothing_length, "mass": mass}
    if isinstance(particles, (str, _os.PathLike)):
        for name, column in columns.items():
            if column is not None:
                raise ValueError(f"{name} is given beside a file, expected it beside positions")
        return _wheatstone.render_file(_os.fspath(particles), options)
    return _wheatstone.render_positions(particles, columns, options)


def column_density(positions, *, mass=None, smoothing_length=None, size=(640, 360), azimuth=None, elevation=None,
                   zoom=None):
    """The column density of particles, seen orthographically; each counts 1 where no mass is given."""
    options = _options(1, size, 1.0, azimuth=azimuth, elevation=elevation, zoom=zoom)
    columns = {"density": None, "temperature": None, "smoothing_length": smoothing_length, "mass": mass}
    values, pixel = _wheatstone.column_density(positions, columns, options)
    height, width = values.shape
    return Column(values, (-width * pixel / 2, width * pixel / 2, -height * pixel / 2, height * pixel / 2))


def load(path):
    """Reads a painting (.wst), or a picture as an array."""
    path = _os.fspath(path)
    if path.endswith(".wst"):
        return Painting(_wheatstone.load_painting(path))
    return _wheatstone.load_picture(path)
