"""Reading any file."""

import errno
import os

from . import _arguments, _wheatstone
from ._films import Film
from ._paintings import Painting, load_photograph
from ._particles import Particles, Slices


def load(path, *, layout=""):
    """Reads what a file holds.

    A painting (.wst) becomes a Painting; a film, or numbered pictures ("left_%04d.png,right_%04d.png"), a Film; slices
    (.exr) Slices; a snapshot or point cloud Particles; a file of two views or more, a quilt or a picture with its depth
    a Photograph; and any other picture an array. `layout` says how a film or a picture holds both views ("left-right",
    "top-bottom-half", …), where the file itself does not.
    """
    path, layout = os.fsdecode(_arguments.path("path", path)), _arguments.text("layout", layout)
    if _wheatstone.is_film(path) or (not os.path.exists(path) and "," in path):
        return Film(path, layout)
    if not os.path.exists(path):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), path)
    if path.endswith(".wst"):
        return Painting(_wheatstone.load_painting(path))
    if path.endswith(".exr") and not layout and not _wheatstone.is_multiview(path):
        return Slices(_wheatstone.load_slices(path))
    if _wheatstone.holds_particles(path):
        return Particles.load(path)
    return load_photograph(path, layout)
