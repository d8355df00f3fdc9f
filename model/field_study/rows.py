"""The rows of `artgen study render-field`."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class SamplesRow:
    """Samples along rays, against the same field with very many.

    Attributes:
        samples, coarse, quadrature: options of `render_along`.
        inverse_beta: 1 / radii.
        psnr_db: of the composite over white, the worse of both states.
        part_psnr_db: of parts alone.
        forward_ms, step_ms: of 1,000 rays that meet a box: without gradient, and with the backward
            pass.
    """

    samples: int
    coarse: int
    quadrature: str
    inverse_beta: float
    psnr_db: float
    part_psnr_db: float
    forward_ms: float
    step_ms: float


@dataclass(frozen=True, kw_only=True)
class PlanesRow:
    """Resolution of hexa-planes, taught the cabinet for the same number of steps.

    Attributes:
        plane_px: rows and columns.
        distance_error: mean, at points of the true surface, radii.
        psnr_db: of the composite over white against the true field, rendered alike.
        step_ms: of 1,000 rays that meet a box, with the backward pass.
        numbers: in the planes of one part.
    """

    plane_px: int
    distance_error: float
    psnr_db: float
    step_ms: float
    numbers: int


@dataclass(frozen=True, kw_only=True)
class PrecisionRow:
    """Precision of the two networks; the rest is float32 always.

    Attributes:
        precision: of the networks' matrix products.
        distance_error: mean difference of distances from float64 near the surface, radii.
        psnr_db: of the composite over white against float64.
        forward_ms, step_ms: as of `SamplesRow`.
    """

    precision: str
    inverse_beta: float
    distance_error: float
    psnr_db: float
    forward_ms: float
    step_ms: float


@dataclass(frozen=True, kw_only=True)
class MeshRow:
    """Resolution of marching cubes.

    Attributes:
        resolution: cells along the longest side of a part.
        distance_error: mean distance of points of the mesh from the true surface, radii, the field
            being exact.
        worst_error: 99th percentile of it.
        volume_error: relative, the largest of all parts.
        triangles: of all parts.
        ms: of all parts, asked of hexa-planes.
    """

    resolution: int
    distance_error: float
    worst_error: float
    volume_error: float
    triangles: int
    ms: float
