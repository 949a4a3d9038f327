"""Photographs and paintings of them."""

import dataclasses

import numpy as np

from . import _arguments, _styles, _wheatstone
from ._displays import Views
from ._notebook import Shown


@dataclasses.dataclass
class Geometry:
    """Where every pixel of a rectified pair lies."""

    left_disparity: np.ndarray
    right_disparity: np.ndarray
    left_occlusion: np.ndarray
    right_occlusion: np.ndarray
    found_share: float


@dataclasses.dataclass(eq=False)
class Photograph(Shown):
    """Two or more views of a scene, and the disparity of the left one where it is known."""

    views: np.ndarray
    disparity: np.ndarray | None = None
    how: str = ""
    """Where the views come from, in words."""

    @property
    def left(self):
        """The left picture; of more than two views, that of the pair in the middle."""
        return self.views[len(self.views) // 2 - 1]

    @property
    def right(self):
        return self.views[len(self.views) // 2]

    def rectify(self, **options):
        """The photograph with matching points on the same rows, as rectify() makes it."""
        pair = rectify(self.left, self.right, **options)
        return Photograph(Views.of(np.stack([pair.left, pair.right])), how=self.how)

    def match(self, quality="good"):
        return match(self.left, self.right, quality)

    def paint(self, style="oil", *, quality="good", detail=None):
        return paint(self.left, self.right, style, quality=quality, disparity=self.disparity, detail=detail)

    def _page(self, words):
        return _wheatstone.page_of_photograph(self.left, self.right, self.disparity, words)

    def _still(self):
        return np.concatenate([self.left, self.right], axis=1)


class Painting(Shown):
    """Marks and the surfaces of their scene: drawn for any view."""

    def __init__(self, made):
        self._made = made

    @property
    def left(self):
        """The left eye's picture."""
        return self._made.left

    @property
    def right(self):
        """The right eye's picture; None in a film of one eye."""
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
        return Views.of(self._made.views(_arguments.whole("views", count), _arguments.number("span", span),
                                         _arguments.number_or_none("screen_disparity", screen_disparity)))

    def sliced(self, depth="", *, layer=None, keep="back"):
        """The painting without the strokes of its finest layer that lie before a plane at `depth`, as "40%" or "12px".

        "40%,60%" gives the next coarser layer a plane, too. `layer` is the finest layer, from the coarsest, 0; `keep`
        is the side whose strokes stay, back or front.
        """
        return Painting(self._made.sliced(None if layer is None else _arguments.whole("layer", layer, 0),
                                          _arguments.text("depth", depth), _arguments.text("keep", keep)))

    def slice_film(self, path, begin="0%", end="100%", *, frames=120, rate=24.0, to="left-right", keep="back"):
        """Writes a film of both eyes in which slicing planes travel through the painting, from `begin` to `end`.

        `to` is a layout ("left-right", "top-bottom-half", …), or anaglyph or a kind of it.
        """
        _wheatstone.write_slice_film(
            self._made, _arguments.path("path", path), _arguments.text("begin", begin), _arguments.text("end", end),
            _arguments.whole("frames", frames, 1), _arguments.number("rate", rate), _arguments.text("to", to),
            _arguments.text("keep", keep))

    def save(self, path):
        """Writes the painting as .wst."""
        self._made.save(_arguments.path("path", path))

    def _page(self, words):
        return _wheatstone.page_of_painting(self._made, words)

    def _still(self):
        return self.left if self.right is None else np.concatenate([self.left, self.right], axis=1)


def match(left, right, quality="good"):
    """Disparities of a rectified pair. `quality` is fast, good or best."""
    return Geometry(**_wheatstone.match(left, right, _arguments.text("quality", quality)))


@dataclasses.dataclass(eq=False)
class Rectified:
    """Two pictures whose matching points share a row, and how well."""

    left: np.ndarray
    right: np.ndarray
    measured_matches: int
    """That rows_before and rows_after are made of; 0: too few to measure."""
    rows_before: tuple
    """Median and 95th percentile of the row differences of the photographs, in pixels."""
    rows_after: tuple
    shift: float
    """Added to all disparities, in pixels, so that none is below 0."""
    eyes_swapped: bool


def rectify(left, right, *, calibration=None, match_colour=True, keep_size=False):
    """Rectifies two photographs by what they have in common, or by a calibration file of the rig."""
    return Rectified(**_wheatstone.rectify(
        left, right, None if calibration is None else _arguments.path("calibration", calibration),
        _arguments.flag("match_colour", match_colour), _arguments.flag("keep_size", keep_size)))


def paint(left, right, style="oil", *, quality="good", disparity=None, detail=None):
    """Paints a rectified pair so that the marks of both eyes fuse.

    `style` is a Style, the name of a preset or a style file. `disparity` is that of the left picture, where it is known.
    `detail` says how finely each place of the left picture is painted, as an array of uint8 of any size that is
    stretched over it: 255 is finest, 128 as the style says; without it, faces are finer than the rest.
    """
    return Painting(_wheatstone.paint(left, right, _styles.made(style), _arguments.text("quality", quality),
                                      disparity, detail))


def still(size=(640, 480), *, seed=1):
    """A synthetic still life with its exact disparity, to try things on."""
    return photograph_of(_wheatstone.still(_arguments.two_whole("size", size, "(width, height)"),
                                          _arguments.seed(seed)))


def photograph_of(read):
    views, how, disparity = read
    return Photograph(Views.of(views), disparity, how)


def load_photograph(path, layout):
    read = _wheatstone.read_photograph(path, layout)
    return photograph_of(read) if isinstance(read, tuple) else read
