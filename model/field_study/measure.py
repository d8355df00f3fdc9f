"""The measurements of `artgen study render-field`: four tables of error against time."""

import copy
from collections.abc import Callable, Iterator

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from artgen.core.stream import Stream
from artgen.geometry.solid import slab, union
from model.field.analytic import BoxField
from model.field.extract import ColoredMesh, part_meshes
from model.field.plane_field import PlaneField
from model.field.rays import Growth, half_sides
from model.field.sdf import Quadrature
from model.field_study.images import Setting, cost, part_psnr, psnr, reference, rendered
from model.field_study.rows import MeshRow, PlanesRow, PrecisionRow, SamplesRow
from model.field_study.scene import PARTS, Scene
from model.field_study.taught import CHANNELS, Taught
from model.field_study.timing import timed

SAMPLES, COARSE = (4, 8, 12, 16, 24, 32, 48, 64), (0, 16, 32)
QUADRATURES: tuple[Quadrature, ...] = ("point", "linear")
SHARPNESS = (30.0, 100.0, 300.0)
PLANES = (8, 16, 32, 64, 128)
RESOLUTIONS = (12, 16, 24, 32, 48, 64, 96, 128)
PLANE_PX = 64
"""Of the planes that samples, precision and meshes are measured on."""
SURFACE_POINTS = 4096
"""Points of every part at which distances are compared."""
SHARP = 100.0
"""1 / radii, at which costs are measured and planes compared."""


def usual(inverse_beta: float) -> Setting:
    """What planes and precision are measured under."""
    return Setting(samples=24, coarse=24, quadrature="point", inverse_beta=inverse_beta)


Advance = Callable[[str], None]


def sample_rows(
    field: PlaneField, scene: Scene, device: str, told: Advance
) -> Iterator[SamplesRow]:
    """Every number of samples by every coarse pass, quadrature and sharpness."""
    true = {sharp: reference(field, scene, sharp) for sharp in SHARPNESS}
    for samples in SAMPLES:
        for coarse in COARSE:
            for quadrature in QUADRATURES:
                setting = Setting(
                    samples=samples,
                    coarse=coarse,
                    quadrature=quadrature,
                    inverse_beta=SHARP,
                )
                price = cost(field, scene, setting, true[SHARP], device)
                for sharp in SHARPNESS:
                    options = vars(setting) | {"inverse_beta": sharp}
                    with torch.no_grad():
                        seen = rendered(field, scene, Setting(**options))
                    yield SamplesRow(
                        **options,
                        psnr_db=psnr(seen, true[sharp]),
                        part_psnr_db=part_psnr(seen, true[sharp]),
                        forward_ms=price.forward_ms,
                        step_ms=price.step_ms,
                    )
            told(f"{samples} samples, {coarse} coarse")


def plane_rows(
    scene: Scene, steps: int, stream: Stream, device: str, told: Advance
) -> Iterator[PlanesRow]:
    """Planes of growing resolution, each taught the scene anew."""
    true = reference(scene.field, scene, SHARP)
    slots = torch.arange(len(PARTS), device=device)
    points = surface_points(scene.field, stream.child("surface"), SURFACE_POINTS)
    there = scene.field.distances(points, slots)
    for plane_px in PLANES:
        field = Taught(scene.field, plane_px, steps, stream.child("taught", plane_px)).field()
        with torch.no_grad():
            found = reference(field, scene, SHARP)
            error = (field.distances(points, slots) - there).abs().mean().item()
        yield PlanesRow(
            plane_px=plane_px,
            distance_error=error,
            psnr_db=psnr(found, true),
            step_ms=cost(field, scene, usual(SHARP), true, device).step_ms,
            numbers=6 * CHANNELS * plane_px**2,
        )
        told(f"planes of {plane_px} px")


def precision_rows(
    taught: Taught, scene: Scene, stream: Stream, device: str, told: Advance
) -> Iterator[PrecisionRow]:
    """The same field with its networks in float32 and in bfloat16, against float64."""
    exact = copy.deepcopy(taught).double()
    fine = PlaneField(exact.planes, exact.size_BP3.double(), exact.head)
    double = scene.mapped(lambda tensor: tensor.double() if tensor.is_floating_point() else tensor)
    points = surface_points(scene.field, stream.child("surface"), SURFACE_POINTS)
    slots = torch.arange(len(PARTS), device=device)
    with torch.no_grad():
        there = fine.distances(points.double(), slots)
        true = {sharp: rendered(fine, double, usual(sharp)) for sharp in SHARPNESS}
    for precision in ("float32", "bfloat16"):
        with torch.autocast(device, dtype=torch.bfloat16, enabled=precision == "bfloat16"):
            field = taught.field()
            with torch.no_grad():
                error = (field.distances(points, slots) - there).abs().mean().item()
            for sharp in SHARPNESS:
                price = cost(field, scene, usual(sharp), true[sharp], device)
                with torch.no_grad():
                    seen = rendered(field, scene, usual(sharp))
                yield PrecisionRow(
                    precision=precision,
                    inverse_beta=sharp,
                    distance_error=error,
                    psnr_db=psnr(seen, true[sharp]),
                    forward_ms=price.forward_ms,
                    step_ms=price.step_ms,
                )
        told(precision)


def mesh_rows(field: PlaneField, scene: Scene, device: str, told: Advance) -> Iterator[MeshRow]:
    """Marching cubes of the boards in closed form, timed on hexa-planes."""
    for resolution in RESOLUTIONS:
        exact = part_meshes(scene.field, scene.articulation, resolution=resolution)
        errors = np.concatenate([mesh_errors(scene.field, mesh) for mesh in exact])
        _, spent = timed(
            lambda: part_meshes(field, scene.articulation, resolution=resolution),  # noqa: B023
            device,
            repeats=2,
        )
        yield MeshRow(
            resolution=resolution,
            distance_error=float(errors.mean()),
            worst_error=float(np.quantile(errors, 0.99)),
            volume_error=max(_volume_error(mesh) for mesh in exact),
            triangles=sum(len(mesh.faces) for mesh in exact),
            ms=spent,
        )
        told(f"{resolution} cells")


def surface_points(field: BoxField, stream: Stream, count: int) -> Tensor:
    """(P, count, 3) coordinates of points at the surface: the nearest of many even draws."""
    generator = torch.Generator().manual_seed(int(stream.generator().integers(2**31)))
    drawn = torch.rand(1, len(PARTS), 32 * count, 3, generator=generator) * 2.0 - 1.0
    drawn = drawn.to(field.center_BPM3.device)
    nearest = field(drawn)[0].abs().argsort(dim=-1)[..., :count]
    return torch.gather(drawn, 2, nearest[..., None].expand(-1, -1, -1, 3))[0]


def mesh_errors(field: BoxField, mesh: ColoredMesh) -> NDArray[np.float32]:
    """Distances of the mesh's vertices and of its triangles' middles from the true surface."""
    middles = mesh.vertices[mesh.faces].mean(axis=1)
    places = torch.as_tensor(np.concatenate([mesh.vertices, middles]), dtype=torch.float32)
    articulation = field.articulation
    half_3 = half_sides(articulation.size_BP3, Growth())[0, mesh.slot]
    local = (places.to(half_3.device) - articulation.center_BP3[0, mesh.slot]) / half_3
    slot = torch.tensor([mesh.slot], device=half_3.device)
    return field.distances(local[None], slot)[0].abs().cpu().numpy()


def _volume_error(mesh: ColoredMesh) -> float:
    boards = [(np.array(middle), np.array(size)) for middle, size, _ in PARTS[mesh.slot]]
    true = union(slab(middle - size / 2, middle + size / 2) for middle, size in boards).volume
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    return abs(float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0 / true - 1.0)
