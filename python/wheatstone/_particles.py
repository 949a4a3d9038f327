"""Particles, their views, and their column density."""

import dataclasses
import os

import numpy as np

from . import _arguments, _wheatstone
from ._displays import Views
from ._notebook import Shown

_COLUMNS = ("density", "temperature", "smoothing_length", "mass")


class Particles:
    """Particles of a file (GADGET, HDF5, PLY, LAS, NumPy, FITS or text), or of arrays; one number a particle each.

    Columns that they do not have are None.
    """

    def __init__(self, positions, *, density=None, temperature=None, smoothing_length=None, mass=None):
        length = _unit_of(positions)
        if length:
            smoothing_length = _in_unit(smoothing_length, length)
        columns = {"density": density, "temperature": temperature, "smoothing_length": smoothing_length, "mass": mass}
        with np.errstate(over="ignore"):  # numbers beyond single precision are an error
            self._made = _wheatstone.Particles(positions, columns)
        self.units = {name: unit for name, unit in (("length", length), ("mass", _unit_of(mass))) if unit}

    @classmethod
    def load(cls, path):
        """Those of a file."""
        particles = cls.__new__(cls)
        particles._made = _wheatstone.load_particles(_arguments.path("path", path))
        particles.units = dict(particles._made.units)
        return particles

    def __len__(self):
        return len(self._made)

    @property
    def positions(self):
        """Of shape (number, 3), in double precision."""
        return self._made.positions()

    @property
    def density(self):
        return self._made.density

    @property
    def temperature(self):
        return self._made.temperature

    @property
    def smoothing_length(self):
        return self._made.smoothing_length

    @property
    def mass(self):
        return self._made.mass

    @property
    def box_size(self):
        """Of a periodic box; 0 where there is none."""
        return self._made.box_size

    @property
    def format(self):
        return self._made.format

    def render(self, **options):
        """As render() does."""
        return render(self, **options)

    def column_density(self, **options):
        """As column_density() does."""
        return column_density(self, **options)

    def slices(self, *, size=(640, 360), span=4.0, azimuth=None, elevation=None, zoom=None):
        """Slices in depth, from which views up to `span` eye separations apart are made."""
        options = _options(2, size, span, azimuth=azimuth, elevation=elevation, zoom=zoom)
        return Slices(_wheatstone.slices(self._made, options))


class Slices(Shown):
    """Particles cut into planes in depth: enough for all views."""

    def __init__(self, made):
        self._made = made

    def __len__(self):
        return len(self._made)

    @property
    def span(self):
        """Eye separations between the outermost views for which nothing is missing."""
        return self._made.span

    def views(self, count, span=1.0):
        """`count` views, leftmost first, as an array of shape (count, height, width, 3)."""
        return Views.of(self._made.views(_arguments.whole("views", count), _arguments.number("span", span)))

    def save(self, path):
        """Writes the slices as OpenEXR (.exr)."""
        self._made.save(_arguments.path("path", path))

    def _page(self, words):
        return _wheatstone.page_of_slices(self._made, words)

    def _still(self):
        return np.asarray(self.views(1)[0])


@dataclasses.dataclass(eq=False)
class Column:
    """Mass per area along the lines of sight."""

    values: np.ndarray
    """Of shape (height, width), the top row first, in units of mass and length of what was given."""
    extent: tuple
    """Left, right, bottom and top edge in the scene's unit of length, from the middle: as Matplotlib's imshow takes it."""
    units: str = ""
    """Of the values, where it is known, as unyt and astropy.units parse it: "Msun/kpc**2"."""
    length_units: str = ""
    """Of the extent, where it is known."""


def render(particles, *, density=None, temperature=None, smoothing_length=None, mass=None, views=2, size=(640, 360),
           span=1.0, azimuth=None, elevation=None, zoom=None, exposure=None):
    """Views of particles, leftmost first, as an array of shape (views, height, width, 3).

    `particles` is a file, Particles, a data container of yt, or positions of shape (number, 3), which may have units as
    those of unyt and astropy have. The views show mass; with `exposure` they are those of `--look thesis`.
    """
    made = _particles_of(particles, density=density, temperature=temperature, smoothing_length=smoothing_length,
                         mass=mass)
    options = _options(views, size, span, azimuth=azimuth, elevation=elevation, zoom=zoom, exposure=exposure)
    return Views.of(_wheatstone.render(made._made, options))


def column_density(particles, *, mass=None, smoothing_length=None, size=(640, 360), azimuth=None, elevation=None,
                   zoom=None):
    """The column density of particles, seen orthographically; each counts 1 where no mass is given.

    `particles` is what render() takes.
    """
    made = _particles_of(particles, smoothing_length=smoothing_length, mass=mass)
    options = _options(1, size, 1.0, azimuth=azimuth, elevation=elevation, zoom=zoom)
    values, pixel = _wheatstone.column_density(made._made, options)
    height, width = values.shape
    extent = (-width * pixel / 2, width * pixel / 2, -height * pixel / 2, height * pixel / 2)
    length, mass_unit = made.units.get("length", made.units.get("x", "")), made.units.get("mass", "")
    if made.mass is None:
        mass_unit = "1"
    return Column(values, extent, _wheatstone.column_unit(mass_unit, length), length)


def _options(views, size, span, **camera):
    options = _wheatstone.RenderOptions(_arguments.whole("views", views),
                                        _arguments.two_whole("size", size, "(width, height)"),
                                        _arguments.number("span", span))
    for name, value in camera.items():
        if value is not None:
            setattr(options, name, _arguments.number(name, value))
    return options


def _particles_of(given, **columns):
    """Particles of whatever has them; columns belong to positions."""
    known = {name: column for name, column in columns.items() if column is not None}
    if isinstance(given, (str, os.PathLike)):
        _refuse_columns(known, "a file")
        return Particles.load(given)
    if isinstance(given, Particles):
        _refuse_columns(known, "Particles")
        return given
    if hasattr(given, "ds") and hasattr(given, "__getitem__"):
        _refuse_columns(known, "a data container")
        return _particles_of_yt(given)
    return Particles(given, **known)


def _refuse_columns(columns, what):
    for name in columns:
        raise ValueError(f"{name} is given beside {what}, expected it beside positions")


def _particles_of_yt(data):
    """Those of a data container of yt, in the simulation's own units: its gas where that is particles, else all."""
    fields = set(data.ds.derived_field_list)
    if ("gas", "smoothing_length") in fields:
        axes = [_in_unit(data[("gas", axis)], "code_length") for axis in "xyz"]
        columns = {name: data[("gas", name)] for name in _COLUMNS if ("gas", name) in fields}
        return _in_code_units(_joined(axes), **columns)
    if ("all", "particle_position") not in fields:
        raise ValueError("the data container of yt has no particles, expected the field ('gas', 'smoothing_length') or "
                         "('all', 'particle_position')")
    mass = data[("all", "particle_mass")] if ("all", "particle_mass") in fields else None
    return _in_code_units(data[("all", "particle_position")], mass=mass)


def _in_code_units(positions, *, mass=None, **columns):
    """In grams and centimetres, yt's usual units, masses and areas would exceed single precision."""
    return Particles(_in_unit(positions, "code_length"), mass=_in_unit(mass, "code_mass"), **columns)


def _joined(axes):
    """Three columns of one unit as positions."""
    joined = np.stack([np.asarray(axis) for axis in axes], axis=1)
    return axes[0].__class__(joined, axes[0].units) if _unit_of(axes[0]) else joined


def _unit_of(array):
    """The name of the unit that an array has, as those of unyt, yt, pynbody and astropy do; empty where it has none."""
    unit = getattr(array, "units", getattr(array, "unit", None))
    return "" if unit is None else str(unit)


def _in_unit(array, unit):
    """An array with a unit in another; what has none stays."""
    if not _unit_of(array) or _unit_of(array) == unit:
        return array
    return array.to(unit) if hasattr(array, "to") else array.in_units(unit)
