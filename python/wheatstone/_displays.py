"""Views, and what displays, files and pages take of them."""

import dataclasses

import numpy as np

from . import _arguments, _wheatstone
from ._notebook import Shown, words_for


class Views(np.ndarray, Shown):
    """Views of one scene: an array of uint8 and shape (number, height, width, 3), which notebooks show."""

    facts: dict = {}
    """What the library tells of how they were made."""

    @classmethod
    def of(cls, array, facts=None):
        """The same array, not copied."""
        views = array.view(cls)
        views.facts = facts or {}
        return views

    def __array_finalize__(self, source):
        self.facts = getattr(source, "facts", {})

    def _page(self, words):
        return _wheatstone.page_of_views(np.ascontiguousarray(self), words)

    def _still(self):
        """Both eyes side by side, or of other numbers of views the one in the middle."""
        return np.concatenate(list(np.asarray(self)), axis=1) if len(self) == 2 else np.asarray(self[len(self) // 2])

    def _is_whole(self):
        return self.ndim == 4 and self.dtype == np.uint8

    def _repr_png_(self):
        return super()._repr_png_() if self._is_whole() else _png_of(self)

    def _repr_html_(self):
        return super()._repr_html_() if self._is_whole() else None


class Picture(np.ndarray):
    """One picture, an array of uint8 and shape (height, width, 3), which notebooks show."""

    def _repr_png_(self):
        return _png_of(self)


def _png_of(array):
    is_picture = array.ndim == 3 and array.shape[2] == 3 and array.dtype == np.uint8 and array.size > 0
    return _wheatstone.png(np.ascontiguousarray(array)) if is_picture else None


def _views_of(given):
    """The array of what has views: an array, a pair of pictures, a photograph, or a painting's eyes."""
    if isinstance(given, np.ndarray):
        return np.ascontiguousarray(given)
    if isinstance(given, (tuple, list)):
        shapes = {getattr(view, "shape", None) for view in given}
        if len(shapes) != 1 or None in shapes:
            raise ValueError(f"views have the shapes {sorted(map(str, shapes))}, expected arrays of one shape")
        return _stacked(given)
    views = getattr(given, "views", None)
    if isinstance(views, np.ndarray):
        return views
    if getattr(given, "right", None) is not None:
        return _stacked([given.left, given.right])
    raise ValueError(f"views is {type(given).__name__}, expected an array of shape (number, height, width, 3), two "
                     "pictures, a photograph or a painting")


def _stacked(pictures):
    arrays = [picture for picture in pictures if isinstance(picture, np.ndarray)]
    if len(arrays) != len(pictures):
        raise ValueError("views are not all arrays, expected pictures of uint8 and shape (height, width, 3)")
    return np.stack(arrays)


def pack(views, to="anaglyph", *, quilt=(8, 6), screen="", screen_disparity=0.0):
    """One picture of views in the format of a display, which notebooks show.

    `to` is anaglyph or a kind of it, a layout ("left-right", "top-bottom-half", …), "quilt", of `quilt` columns and
    rows, or "lenticular" for `screen`, the name of a display or its calibration (.json). Of a painting the two eyes are
    taken; `painting.views(48)` makes more. `screen_disparity` lies on the screen, in pixels from view to view.
    """
    return _wheatstone.pack(
        _views_of(views), _arguments.text("to", to), _arguments.two_whole("quilt", quilt, "(columns, rows)"),
        _arguments.path("screen", screen) if screen else b"",
        _arguments.number("screen_disparity", screen_disparity)).view(Picture)


def save(path, picture):
    """Writes a picture, or views to one file (.mpo, .jps, .exr, .gif, .webp), by the name's ending."""
    path = _arguments.path("path", path)
    if isinstance(picture, np.ndarray) and picture.ndim == 3:
        _wheatstone.write_picture(path, picture)
    else:
        _wheatstone.write_views(path, _views_of(picture))


@dataclasses.dataclass
class Measures:
    """How consistent two eyes' pictures are."""

    mean_absolute_difference: float
    """Between the eyes' pictures of the same points, 0..255."""
    rmse: float
    """Of the same, 0..1."""
    compared_share: float
    """Of the left picture's pixels."""
    density: float
    """Share of the pixels that can be matched again."""
    end_point_error: float
    """Of what was matched again, in pixels."""
    bad_1: float
    """Share that is unmatched or off by more than 1 pixel."""
    bad_2: float
    left_gradient_energy: float
    right_gradient_energy: float


def measure(left, right, disparity):
    """Measures a pair against the disparity of its left picture, NaN where it is not known."""
    return Measures(**_wheatstone.measure(left, right, disparity))


def share(shown, path, *, title="Wheatstone", caption="", description=""):
    """Writes a page that any browser shows: of a painting, photograph, views, slices or a film."""
    if not isinstance(shown, Shown):
        raise ValueError(f"shown is {type(shown).__name__}, expected a painting, photograph, views, slices or a film")
    path = _arguments.path("path", path)
    _wheatstone.write_page(path, shown._page_at(words_for(title, caption, description), path))
