"""A camera as a render job states it: plain numbers, so that Blender's own Python can read it."""

from dataclasses import dataclass

Row = tuple[float, float, float, float]


@dataclass(frozen=True, kw_only=True)
class StatedCamera:
    """A pinhole with OpenCV axes.

    Attributes:
        focal: px, the same along x and y.
        principal: (x, y) px of the principal point; the center of the first pixel is at (0.5, 0.5).
        size: (width, height) px.
        camera_from_world: (4, 4) rigid, row by row; x right, y down, z forward, m.
    """

    focal: float
    principal: tuple[float, float]
    size: tuple[int, int]
    camera_from_world: tuple[Row, Row, Row, Row]
