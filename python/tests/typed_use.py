"""Uses of the package that a type checker accepts."""

import numpy as np
import numpy.typing as npt
import wheatstone

picture: npt.NDArray[np.uint8] = np.zeros((20, 20, 3), dtype=np.uint8)
painting: wheatstone.Painting = wheatstone.paint(picture, picture, wheatstone.Style("mosaic", {"tile": 8}))
views: npt.NDArray[np.uint8] = painting.views(3, span=2.0)
share: float = wheatstone.match(picture, picture).found_share
gas: npt.NDArray[np.uint8] = wheatstone.render([[0.0, 1.0, 2.0]], density=[1.0], size=(64, 36))
