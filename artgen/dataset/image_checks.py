"""What the images of a sample must agree on, checked before they are written."""

import numpy as np

from artgen.core.errors import ShardError
from artgen.dataset.sample import BACKGROUND, LEFT_OUT, Bytes, Sample, Singles


def check_images(sample: Sample) -> None:
    """Raise ShardError unless colors, ids, depths and normals of a sample tell the same story.

    The writer calls it; afterwards checksums hold what it found, so readers are spared the time.
    """
    _check_colors(sample.meta.asset_id, sample.rgba, "rgba")
    _check_colors(sample.meta.asset_id, sample.part_rgba, "part_rgba")
    _check_surface(sample.meta.asset_id, sample.depth, sample.normal, "depth and normal")
    _check_surface(sample.meta.asset_id, sample.part_depth, sample.part_normal, "part images")
    _check_labels(sample)
    asset, count = sample.meta.asset_id, len(sample.meta.parts)
    shown = set(np.unique(sample.part_id).tolist())
    known = {*range(count), BACKGROUND} | ({LEFT_OUT} if sample.meta.parts_left_out else set())
    if unknown := sorted(shown - known):
        raise ShardError(
            f"{asset}: part ids {unknown} name no part (there are {count}); 255 is background"
        )
    if not np.array_equal(sample.part_id == BACKGROUND, sample.depth == 0):
        raise ShardError(
            f"{asset}: part_id is background elsewhere than depth is 0; cast both at once"
        )
    own = np.minimum(sample.part_id, count - 1)[:, :, None].astype(np.intp)
    alone = np.take_along_axis(sample.part_depth, own, axis=2)[:, :, 0]
    if (wrong := (sample.part_id < count) & (alone != sample.depth)).any():
        raise ShardError(
            f"{asset}: {int(wrong.sum())} pixels whose depth differs from that of the part they "
            "show; take the composite as the nearest over parts"
        )


def _check_labels(sample: Sample) -> None:
    """Optional images: labels are 0 on the background, and every number is finite."""
    asset, background = sample.meta.asset_id, sample.part_id == BACKGROUND
    for name in ("albedo", "roughness", "flow"):
        array = getattr(sample, name)
        if array is not None and array[background].any():
            raise ShardError(
                f"{asset}: {name} is not 0 on the background; take it where part_id is a part's"
            )
    if sample.flow is not None and sample.flow[-1].any():
        raise ShardError(f"{asset}: flow of the last state is not 0; no state follows it")
    for name in ("flow", "linear"):
        array = getattr(sample, name)
        if array is not None and not np.isfinite(array).all():
            raise ShardError(
                f"{asset}: {name} holds numbers that are not finite; float16 ends at 65504"
            )


def _check_colors(asset: str, rgba: Bytes, name: str) -> None:
    if rgba[rgba[..., 3] == 0].any():
        raise ShardError(
            f"{asset}: {name} has color under alpha 0, which images do not keep; pass it through "
            "transparent_cleared()"
        )


def _check_surface(asset: str, depth: Singles, normal: Singles, name: str) -> None:
    if not (np.isfinite(depth).all() and (depth >= 0).all()):
        raise ShardError(f"{asset}: {name} hold a depth that is not >= 0; background is 0 m")
    hit = depth > 0
    length = np.sqrt(np.einsum("...i,...i->...", normal, normal))
    # Stored normals are rounded to 1/127: each component is off by <= 1/254, the length by
    # <= sqrt(3)/254 = 0.0068.
    if (np.abs(length[hit] - 1) > 0.007).any() or normal[~hit].any():
        raise ShardError(
            f"{asset}: {name}: normals must be unit where depth > 0, and zero elsewhere"
        )
