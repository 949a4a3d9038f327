"""Stereo and multi-view painterly rendering, and particle rendering for 3D displays.

Pictures are NumPy arrays of uint8 and shape (height, width, 3); views are arrays of shape (number, height, width, 3),
the leftmost first; disparities are float32 of shape (height, width), in pixels, larger is nearer. Long calls release
the interpreter's lock and end with Ctrl-C.
"""

from ._displays import Measures, Picture, Views, measure, pack, save, share
from ._files import load
from ._films import Film, Frame, Job, PaintedFrame, rotoscope
from ._paintings import Geometry, Painting, Photograph, Rectified, match, paint, rectify, still
from ._particles import Column, Particles, Series, Slices, column_density, render
from ._styles import Style
from ._wheatstone import __version__

__all__ = [
    "Column", "Film", "Frame", "Geometry", "Job", "Measures", "PaintedFrame", "Painting", "Particles", "Photograph",
    "Picture", "Rectified", "Series", "Slices", "Style", "Views", "column_density", "load", "match", "measure",
    "pack", "paint", "rectify", "render", "rotoscope", "save", "share", "still",
]
