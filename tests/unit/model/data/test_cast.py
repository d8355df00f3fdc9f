"""First hits against closed forms, and against embree as `renders.raycast` uses it."""

import numpy as np
import pytest
import torch
from scipy.spatial import Delaunay

from artgen.core.camera import Camera, framed, orbit_direction
from artgen.core.mesh import TriMesh
from model.data import cast
from model.data.cast import depth_of, first_hits, projected, triangle_of
from renders.raycast import PartCaster, View
from tests.unit.model.data.small import soup

SIZE = 72


@pytest.mark.parametrize("category", ["cabinet", "laptop", "cooking_pot", "folding_chair"])
@pytest.mark.parametrize("angles", [(0.3, 0.4), (2.5, -0.2), (0.0, 0.0)])
def test_hits_are_those_of_embree(category, angles):
    made = soup(category)
    points = ((made.vertices - made.center) / made.radius).astype(np.float32)
    direction = orbit_direction(*angles)
    camera = framed(points, direction=direction, fov=0.6, size=(SIZE, SIZE), fill=0.9)
    code, order = _cast(points[made.faces], made.body, camera)
    oracle = PartCaster(TriMesh(vertices=points, faces=made.faces))
    hits = oracle.cast(View(camera), np.eye(4), (0, 0, SIZE, SIZE))
    expected = np.zeros(SIZE * SIZE)
    expected[hits.pixel] = hits.depth
    depth = depth_of(code, order).numpy().ravel()
    # Rays within rounding of an outline may differ: 1e-5 px of an outline of 1,000 px is 0.01 rays.
    assert ((depth > 0) != (expected > 0)).sum() <= 1
    both = (depth > 0) & (expected > 0)
    # Corners are float32 in px (4e-6), over 36 px a radius, on slopes up to 1:50 along the sight;
    # bodies in one plane are told apart by LATER times their number.
    assert np.abs(depth - expected)[both].max() < 1e-5 * 5 + len(order) * cast.LATER


def test_a_tilted_plane_has_its_exact_depth_and_no_hole():
    """A plane cut in many slivers: every ray meets it, where its equation says."""
    rng = np.random.default_rng(0)
    cloud = np.concatenate([[[-3, -3], [3, -3], [3, 3], [-3, 3]], rng.uniform(-3, 3, (300, 2))])
    flat = _triangulated(cloud)
    corners = np.concatenate([flat, 4.0 + 0.3 * flat[..., :1] - 0.2 * flat[..., 1:]], axis=-1)
    camera = Camera(focal=SIZE, size=(SIZE, SIZE), camera_from_world=np.eye(4))
    code, order = _cast(corners.astype(np.float32), np.zeros(len(corners)), camera)
    _, directions = camera.rays()
    expected = 4.0 / (1.0 - 0.3 * directions[..., 0] + 0.2 * directions[..., 1])
    # Five roundings of float32 at depths up to 6.
    assert np.abs(depth_of(code, order)[0].numpy() - expected).max() < 5e-6


def test_of_two_bodies_in_one_plane_the_later_is_seen():
    square = np.array([[[-1, 1, 3], [1, 1, 3], [1, -1, 3]], [[-1, 1, 3], [1, -1, 3], [-1, -1, 3]]])
    square = square[:, ::-1].astype(float)  # Counter-clockwise for an eye whose y points down.
    small = square * (0.5, 0.5, 1.0)
    camera = Camera(focal=SIZE, size=(SIZE, SIZE), camera_from_world=np.eye(4))
    for first, second in ((square, small), (small, square)):
        corners = np.concatenate([first, second]).astype(np.float32)
        code, _ = _cast(corners, np.array([0, 0, 1, 1]), camera)
        seen = triangle_of(code)[0, SIZE // 2, SIZE // 2 + 3]
        assert int(seen) >= 2


def test_triangles_that_look_away_are_not_seen():
    made = soup("cabinet")
    points = ((made.vertices - made.center) / made.radius).astype(np.float32)
    camera = framed(points, direction=(0.0, -1.0, 0.0), fov=0.6, size=(SIZE, SIZE), fill=0.9)
    code, _ = _cast(points[made.faces][:, ::-1].copy(), made.body, camera)
    seen = points[made.faces][torch.unique(triangle_of(code[code >= 0])).numpy()].astype(float)
    normal = np.cross(*np.diff(seen, axis=1).transpose(1, 0, 2))
    # 1e-9: float32 rounding of products of millimeters in radii.
    assert (np.einsum("ij,ij->i", normal, seen[:, 0] - camera.position) > -1e-9).all()


def test_few_rows_at_a_time_make_no_difference(monkeypatch):
    made = soup("laptop")
    points = ((made.vertices - made.center) / made.radius).astype(np.float32)
    camera = framed(points, direction=(0.6, -0.8, 0.0), fov=0.6, size=(SIZE, SIZE), fill=0.9)
    whole, _ = _cast(points[made.faces], made.body, camera)
    monkeypatch.setattr(cast, "ROWS", 500)
    parts, _ = _cast(points[made.faces], made.body, camera)
    assert torch.equal(whole, parts)


def test_nothing_to_see_is_background():
    none = torch.zeros(0, 3, 3)
    hits = first_hits(none, none[:, 0, 0], none[:, 0, 0].long(), channels=2, size=(3, 4))
    assert hits.code_CHW.shape == (2, 3, 4)
    assert (hits.code_CHW < 0).all()
    assert not depth_of(hits.code_CHW, torch.zeros(1)).any()


def _cast(corners_F33, body_F, camera: Camera) -> tuple[torch.Tensor, torch.Tensor]:
    """Codes (1, H, W), and ranks of bodies, of world triangles."""
    pose = camera.camera_from_world
    local = np.asarray(corners_F33, np.float32) @ pose[:3, :3].T + pose[:3, 3]
    matrix = torch.tensor(camera.intrinsics, dtype=torch.float32).expand(3 * len(local), 3, 3)
    flat = projected(torch.tensor(local.reshape(-1, 3), dtype=torch.float32), matrix).view(-1, 3, 3)
    order = torch.tensor(np.asarray(body_F, np.float32))
    channel = torch.zeros(len(local), dtype=torch.int64)
    hits = first_hits(flat, order, channel, channels=1, size=camera.size)
    return hits.code_CHW, order


def _triangulated(cloud_N2) -> np.ndarray:
    """(F, 3, 2) Delaunay triangles, turned towards an eye below."""
    found = cloud_N2[Delaunay(cloud_N2).simplices]
    away = np.cross(found[:, 1] - found[:, 0], found[:, 2] - found[:, 0]) > 0
    found[away] = found[away][:, ::-1]
    return found
