"""Particles, their views, and their column density."""

import dataclasses
import os

import numpy as np

from . import _arguments, _render_options, _wheatstone
from ._displays import Views
from ._notebook import Shown

_COLUMNS = ("density", "temperature", "smoothing_length", "mass", "quantity")


class Particles:
    """Particles of a file (GADGET, HDF5, PLY, LAS, NumPy, FITS or text), or of arrays; one number a particle each.

    Columns that they do not have are None. `quantity` is a column of any kind, which render(quantity="quantity") shows.
    """

    def __init__(self, positions, *, density=None, temperature=None, smoothing_length=None, mass=None, quantity=None):
        length = _unit_of(positions)
        if length:
            smoothing_length = _in_unit(smoothing_length, length)
        columns = {"density": density, "temperature": temperature, "smoothing_length": smoothing_length, "mass": mass,
                   "quantity": quantity}
        with np.errstate(over="ignore"):  # numbers beyond single precision are an error
            self._made = _wheatstone.Particles(positions, columns)
        units = {"length": length} | {name: _unit_of(columns[name]) for name in ("mass", "density", "quantity")}
        self._made.units = [(name, unit) for name, unit in units.items() if unit]

    @classmethod
    def load(cls, path):
        """Those of a file."""
        return cls._of(_wheatstone.load_particles(_arguments.path("path", path)))

    @classmethod
    def _of(cls, made):
        particles = cls.__new__(cls)
        particles._made = made
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

    @property
    def units(self):
        """Of "length", "mass" and columns, as far as they are known: texts that unyt and astropy.units parse."""
        return dict(self._made.units)

    def render(self, **options):
        """As render() does."""
        return render(self, **options)

    def column_density(self, **options):
        """As column_density() does."""
        return column_density(self, **options)

    def slices(self, *, size=(640, 360), span=4.0, **options):
        """Slices in depth, from which views up to `span` eye separations apart are made, with options as render()'s."""
        return Slices(_wheatstone.slices(self._made, _words("slices", size=size, span=span, **options)))


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
    """Mass per area along the lines of sight, or the mean of a quantity."""

    values: np.ndarray
    """Of shape (height, width), the top row first, in units of mass and length of what was given."""
    extent: tuple
    """Left, right, bottom and top edge in the scene's unit of length, from the middle: as Matplotlib's imshow takes it."""
    units: str = ""
    """Of the values, where it is known, as unyt and astropy.units parse it: "Msun/kpc**2"."""
    length_units: str = ""
    """Of the extent, where it is known."""


class Series:
    """Snapshots of one simulation: a name with a number, as "snap_%03d.hdf5"."""

    def __init__(self, path):
        self._made = _wheatstone.Series(os.fsdecode(_arguments.path("path", path)))

    def __len__(self):
        return len(self._made.files)

    def __getitem__(self, number):
        """One of the snapshots."""
        return Particles.load(self.files[number])

    @property
    def files(self):
        return self._made.files

    @property
    def times(self):
        """Of the snapshots, as their headers tell them."""
        return self._made.times

    def at(self, time):
        """The particles at a time between the first snapshot and the last, moved along their velocities."""
        return Particles._of(self._made.at(_arguments.number("time", time)))

    def frames(self, count=0, *, orbit=0.0, **options):
        """The views of a film's frames, one after the other, with options as render()'s.

        There are `count` of them, one a snapshot for 0; the camera turns by `orbit` degrees. Colours, brightness and what
        the views show are the same in all frames.
        """
        made = self._made.frames(_words("frames", **options), _arguments.whole("count", count, 0),
                                 _arguments.number("orbit", orbit))
        return (Views.of(*made.frame(number)) for number in range(len(made)))


def render(particles, *, density=None, temperature=None, smoothing_length=None, mass=None, quantity=None, **options):
    """Views of particles, leftmost first, as an array of shape (views, height, width, 3).

    `particles` is a file, Particles, a data container of yt, or positions of shape (number, 3), which may have units as
    those of unyt have; columns are arrays beside positions, and names of datasets beside a file. A file may also be one of
    slices or a model. What is told of the views, as the limits and the unit of their colours, is their `facts`.

    All other options are those of `wheatstone render`. None stands for one that is not given:

"""
    columns = {"density": density, "temperature": temperature, "smoothing_length": smoothing_length, "mass": mass,
               "quantity": quantity}
    options |= {name: value for name, value in columns.items() if isinstance(value, str)}
    columns = {name: value for name, value in columns.items() if value is not None and not isinstance(value, str)}
    if "quantity" in columns:
        options["quantity"] = "quantity"
    words = _words("render", **options)
    if isinstance(particles, (str, os.PathLike)):
        _refuse_columns(columns, "a file")
        return Views.of(*_wheatstone.render_file(_arguments.path("particles", particles), words))
    return Views.of(*_wheatstone.render(_particles_of(particles, **columns)._made, words))


render.__doc__ += _render_options.help_text() + "\n"


def column_density(particles, *, mass=None, smoothing_length=None, size=(640, 360), **options):
    """The column density of particles, seen orthographically; each counts 1 where no mass is given.

    `particles` and options are what render() takes. With `quantity`, the mean of that quantity along the lines of sight.
    """
    made = _particles_of(particles, smoothing_length=smoothing_length, mass=mass)
    values, pixel, unit = _wheatstone.values(made._made, _words("column_density", views=1, size=size, **options))
    height, width = values.shape
    extent = (-width * pixel / 2, width * pixel / 2, -height * pixel / 2, height * pixel / 2)
    length = made.units.get("length", made.units.get("x", ""))
    if not options.get("quantity"):
        unit = _wheatstone.column_unit("1" if made.mass is None else made.units.get("mass", ""), length)
    elif unit == "code_unit":  # not known
        unit = ""
    return Column(values, extent, unit, length)


def _words(function, **options):
    for name in ("views", "size", "span"):
        if name in options and options[name] is None:
            _arguments.two_whole(name, None, "(width, height)") if name == "size" else _arguments.number(name, None)
    return _render_options.words_of(function, options)


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
