import dataclasses
import os
from typing import Any, Mapping, Sequence

import numpy as np
import numpy.typing as npt

__version__: str

Picture = npt.NDArray[np.uint8]
Disparities = npt.NDArray[np.float32]

@dataclasses.dataclass
class Geometry:
    left_disparity: Disparities
    right_disparity: Disparities
    left_occlusion: npt.NDArray[np.uint8]
    right_occlusion: npt.NDArray[np.uint8]
    found_share: float

@dataclasses.dataclass
class Style:
    preset: str = ...
    parameters: Mapping[str, Any] = ...
    seed: int = ...
    def toml(self) -> str: ...

@dataclasses.dataclass
class Column:
    values: npt.NDArray[np.float32]
    extent: tuple[float, float, float, float]

class Painting:
    @property
    def left(self) -> Picture: ...
    @property
    def right(self) -> Picture: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    def views(self, count: int, span: float = ..., screen_disparity: float | None = ...) -> Picture: ...
    def save(self, path: str | os.PathLike[str]) -> None: ...

def match(left: Picture, right: Picture, quality: str = ...) -> Geometry: ...
def paint(
    left: Picture,
    right: Picture,
    style: str | os.PathLike[str] | Style = ...,
    *,
    quality: str = ...,
    disparity: Disparities | None = ...,
) -> Painting: ...
def render(
    particles: str | os.PathLike[str] | npt.ArrayLike,
    *,
    density: npt.ArrayLike | None = ...,
    temperature: npt.ArrayLike | None = ...,
    smoothing_length: npt.ArrayLike | None = ...,
    mass: npt.ArrayLike | None = ...,
    views: int = ...,
    size: Sequence[int] = ...,
    span: float = ...,
    azimuth: float | None = ...,
    elevation: float | None = ...,
    zoom: float | None = ...,
    exposure: float | None = ...,
) -> Picture: ...
def column_density(
    positions: npt.ArrayLike,
    *,
    mass: npt.ArrayLike | None = ...,
    smoothing_length: npt.ArrayLike | None = ...,
    size: Sequence[int] = ...,
    azimuth: float | None = ...,
    elevation: float | None = ...,
    zoom: float | None = ...,
) -> Column: ...
def load(path: str | os.PathLike[str]) -> Any: ...
