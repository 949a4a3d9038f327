"""Uses of the package that a type checker accepts."""

import numpy as np
import numpy.typing as npt
import wheatstone

picture: npt.NDArray[np.uint8] = np.zeros((20, 20, 3), dtype=np.uint8)
painting: wheatstone.Painting = wheatstone.paint(picture, picture, wheatstone.Style("mosaic", tile=8))
views: npt.NDArray[np.uint8] = painting.views(3, span=2.0)
share: float = wheatstone.match(picture, picture).found_share
gas: npt.NDArray[np.uint8] = wheatstone.render([[0.0, 1.0, 2.0]], density=[1.0], size=(64, 36))
column: wheatstone.Column = wheatstone.Particles.load("u.hdf5").column_density(size=(64, 36))
quilt: npt.NDArray[np.uint8] = wheatstone.pack(views, "quilt", quilt=(3, 1))
rows: tuple[float, float] = wheatstone.rectify(picture, picture).rows_after
still: wheatstone.Photograph = wheatstone.still((64, 48))
frames: list[float] = [frame.seconds for frame in wheatstone.rotoscope("film.mp4", "mosaic")]
job: wheatstone.Job = wheatstone.rotoscope("film.mp4", output="painted.mp4", codec="ffv1")
wheatstone.share(painting, "page.html", title="Fruit")
