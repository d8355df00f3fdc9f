"""Pictures of layouts: parts in colors, axes as lines, truth and prediction from one camera."""

import io

import numpy as np
from PIL import Image, ImageDraw

from artgen.articulation.targets import FIXED, REVOLUTE
from artgen.core.camera import Camera, framed
from artgen.core.mesh import Floats
from artgen.core.transform import apply
from model.evaluation.boxes import corners
from model.evaluation.layout import Layout
from model.evaluation.silhouettes import FIELD_OF_VIEW, VIEWS, hit_triangles, placed_triangles

SIZE = 176
OPEN = 0.7
"""Share of the way at which the open picture is taken."""
COLORS = np.array(
    [
        (0.72, 0.74, 0.78), (0.89, 0.47, 0.20), (0.22, 0.49, 0.82), (0.28, 0.66, 0.39),
        (0.78, 0.33, 0.56), (0.85, 0.70, 0.18), (0.42, 0.36, 0.73), (0.20, 0.66, 0.70),
    ]
)  # fmt: skip
LIGHT = np.array([-0.35, -0.75, 0.56])
AXIS = (20, 20, 24)


def strip(predicted: Layout, true: Layout) -> bytes:
    """A PNG: truth at rest and open, prediction at rest and open, side by side."""
    camera = _camera((predicted, true))
    tiles = [_tile(layout, share, camera) for layout in (true, predicted) for share in (0.0, OPEN)]
    image = Image.new("RGB", (SIZE * len(tiles), SIZE), "white")
    for k, tile in enumerate(tiles):
        image.paste(tile, (SIZE * k, 0))
    buffer = io.BytesIO()
    image.quantize(64).save(buffer, "PNG", optimize=True)
    return buffer.getvalue()


def _camera(layouts: tuple[Layout, Layout]) -> Camera:
    points = []
    for layout in layouts:
        for share in (0.0, OPEN):
            poses = layout.poses(layout.opened(share))
            points += [apply(p, corners(b)) for p, b in zip(poses, layout.boxes, strict=True)]
    cloud = np.concatenate(points)
    return framed(cloud, direction=VIEWS[0], fov=FIELD_OF_VIEW, size=(SIZE, SIZE), fill=0.92)


def _tile(layout: Layout, share: float, camera: Camera) -> Image.Image:
    parts = placed_triangles(layout, share)
    triangles = np.concatenate(parts)
    owner = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    hit = hit_triangles(triangles, camera).astype(int)
    edge = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normal = edge / np.linalg.norm(edge, axis=1, keepdims=True).clip(min=1e-300)
    shade = 0.55 + 0.45 * np.abs(normal @ LIGHT)
    painted = COLORS[owner % len(COLORS)] * shade[:, None]
    pixels = np.where((hit >= 0)[..., None], painted[hit], 1.0)
    image = Image.fromarray((pixels * 255.0).round().astype(np.uint8))
    _draw_axes(image, layout, camera)
    return image


def _draw_axes(image: Image.Image, layout: Layout, camera: Camera) -> None:
    """A line along each axis through the part, with a dot at the end that it points to."""
    draw = ImageDraw.Draw(image)
    for part in np.flatnonzero(layout.types != FIXED).tolist():
        axis = layout.axes[part]
        if not np.isfinite(axis).all():
            continue
        middle, half = _axis_middle(layout, part), 0.35 * layout.radius
        ends = camera.project(np.stack([middle - half * axis, middle + half * axis]))[:, :2]
        if not np.isfinite(ends).all() or np.abs(ends).max() > 10 * SIZE:
            continue
        (a, b), (c, d) = ends.tolist()
        draw.line((a, b, c, d), fill=AXIS, width=2)
        draw.ellipse((c - 3, d - 3, c + 3, d + 3), fill=AXIS)


def _axis_middle(layout: Layout, part: int) -> Floats:
    """The point of the axis nearest to the part; the part's middle for slides."""
    center, axis = layout.centers[part], layout.axes[part]
    if layout.types[part] != REVOLUTE:
        return center
    origin = layout.origins[part]
    return np.asarray(origin + ((center - origin) @ axis) * axis)
