"""What notebooks and browsers show: pages, which the library makes, and pictures."""

import html
import pathlib
import tempfile
import webbrowser

import numpy as np

from . import _arguments, _wheatstone


class Shown:
    """Something that notebooks show as a page; a subclass says how its page is made, and a still picture of it."""

    def _page(self, words):
        raise NotImplementedError

    def _page_at(self, words, path):
        """The page for a file of this name."""
        return self._page(words)

    def _still(self):
        raise NotImplementedError

    def show(self):
        """Opens the page in the web browser."""
        path = pathlib.Path(tempfile.mkdtemp(prefix="wheatstone-")) / "page.html"
        _wheatstone.write_page(path, self._page(words_for("Wheatstone")))
        webbrowser.open(path.as_uri())

    def _repr_png_(self):
        return _wheatstone.png(np.ascontiguousarray(self._still()))

    def _repr_html_(self):
        return frame(self._page(words_for("Wheatstone")), *self._still().shape[1::-1])


def words_for(title, caption="", description=""):
    return _wheatstone.PageWords(_arguments.text("title", title), _arguments.text("caption", caption),
                                 _arguments.text("description", description))


def frame(page, width, height):
    """A page inside another, with room for its buttons below a picture of this size."""
    return (f'<iframe srcdoc="{html.escape(page)}" title="Wheatstone" width="{min(width, 960)}" '
            f'height="{min(height, 720) + 160}" style="border: 0; max-width: 100%" sandbox="allow-scripts" '
            'allow="fullscreen; xr-spatial-tracking; accelerometer; gyroscope"></iframe>')
