"""Films, and painting them."""

import concurrent.futures
import dataclasses
import os

import numpy as np

from . import _arguments, _styles, _wheatstone
from ._notebook import Shown
from ._paintings import Painting


@dataclasses.dataclass(eq=False)
class Frame:
    """The eyes of a moment of a film; `right` is None in a film of one eye."""

    left: np.ndarray
    right: np.ndarray | None
    seconds: float


@dataclasses.dataclass(eq=False)
class PaintedFrame:
    """A painted moment of a film."""

    painting: Painting
    seconds: float
    scene_begins: bool


class Film(Shown):
    """A film of one or two eyes; iterating over it gives its frames, each time from the first."""

    def __init__(self, path, layout=""):
        self.path = os.fsdecode(_arguments.path("film", path))
        self._layout = _arguments.text("layout", layout)
        facts = self._open().facts()
        self.frame_rate = facts["frame_rate"]
        self.duration = facts["duration"]
        self.frame_count = facts["frame_count"]
        self.codec = facts["codec"]
        self.layout = facts["layout"]

    def frames(self, start=None, end=None, every=1):
        """The frames from a second to another, of which the last is left out, and of these every so many-th."""
        return _frames_in(self._open(_part(start, end, every)))

    def __iter__(self):
        return self.frames()

    def rotoscope(self, style="oil", **options):
        """As rotoscope() does."""
        return rotoscope(self.path, style, layout=self._layout, **options)

    def _open(self, part=(None, None, 1)):
        return _wheatstone.open_film(os.fsencode(self.path), self._layout, part)

    def _page(self, words):
        return self._page_at(words, "")

    def _page_at(self, words, path):
        return _wheatstone.page_of_film(os.fsencode(self.path), self._layout, path, words)

    def _repr_html_(self):
        try:
            return super()._repr_html_()
        except ValueError:  # browsers cannot play such a film, or it would have to stand beside the page
            return None

    def _still(self):
        first = next(iter(self))
        return first.left if first.right is None else np.concatenate([first.left, first.right], axis=1)


class Job:
    """A film that is painted in the background. `step` and `done`, 0..1, say how far it is."""

    def __init__(self, made):
        self._made = made

    @property
    def step(self):
        return self._made.step

    @property
    def done(self):
        return self._made.done

    def cancel(self):
        """Asks it to end. What was painted is kept beside the film and gone on with by `resume=True`."""
        self._made.cancel()

    def is_finished(self):
        return self._made.has_ended()

    def result(self, timeout=None):
        """Waits for the film and gives its number of frames and scenes, the seconds that it took, and notes.

        Raises what went wrong, CancelledError of concurrent.futures after cancel(), and its TimeoutError after so many
        seconds. Ctrl-C cancels the job.
        """
        try:
            if not self._made.wait(_arguments.number_or_none("timeout", timeout)):
                raise concurrent.futures.TimeoutError
            return self._made.result()
        except KeyboardInterrupt:
            if self._made.has_ended() and self._made.is_cancelled():
                raise concurrent.futures.CancelledError from None
            self.cancel()
            raise


def rotoscope(film, style="oil", *, output=None, layout="", start=None, end=None, every=1, depth_budget=0.03,
              codec="h264", crf=None, resume=False):
    """Paints a film. Without `output` it gives the painted frames one by one; with it, a Job that writes a film.

    `film` is a file, or numbered pictures ("left_%04d.png,right_%04d.png"). `depth_budget` is the depth from the
    farthest point to the nearest, at most, as a share of the width, for which the eyes are drawn; None: the film's own.
    """
    if isinstance(film, Film):
        layout = layout or film._layout
        film = film.path
    painted = _wheatstone.Rotoscoping(
        _arguments.path("film", film), _arguments.text("layout", layout), _part(start, end, every), _styles.made(style),
        _arguments.number_or_none("depth_budget", depth_budget))
    if output is None:
        return _frames_of(painted)
    return Job(painted.write(_arguments.path("output", output), _arguments.text("codec", codec),
                             _arguments.number_or_none("crf", crf), _arguments.flag("resume", resume)))


def _part(start, end, every):
    return (_arguments.number_or_none("start", start), _arguments.number_or_none("end", end),
            _arguments.whole("every", every))


def _frames_in(film):
    while (read := film.next()) is not None:
        yield Frame(*read)


def _frames_of(painted):
    while (frame := painted.next()) is not None:
        made, seconds, scene_begins = frame
        yield PaintedFrame(Painting(made), seconds, scene_begins)
