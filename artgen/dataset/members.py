"""Sample to the members of a tar and back."""

import io
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from artgen.articulation.targets import Targets
from artgen.articulation.types import Joint, Latch, Limit, Mimic, Precondition, Spring
from artgen.core.errors import ShardError
from artgen.core.jsonio import canonical_json
from artgen.dataset import codec
from artgen.dataset.image_checks import check_images
from artgen.dataset.sample import Cameras, PartLabel, Sample, SampleMeta

SAMPLE_SCHEMA = "artgen-sample/2"
CONVENTIONS = {
    "angles": "rad",
    "cameras": "OpenCV axes (x right, y down, z forward), camera_from_world, pixel centres at +0.5",
    "color": "sRGB, straight alpha",
    "depth": "m along the camera's z axis",
    "flow": "px right and down to the next state",
    "lengths": "m",
    "linear": "linear sRGB primaries, premultiplied alpha",
    "normals": "world frame at the state shown",
    "targets": "relative to center, at rest",
    "world": "object frame: z up, front -y",
}
_OPTIONAL: Mapping[
    str, tuple[str, Callable[[NDArray[Any]], bytes], Callable[[bytes], NDArray[Any]]]
] = {
    "albedo": ("albedo.webp", codec.webp, codec.read_rgb),
    "roughness": ("roughness.png", codec.png, codec.read_gray8),
    "flow": ("flow.exr", codec.flow_exr, codec.read_flow),
    "linear": ("linear.exr", codec.linear_exr, codec.read_linear),
}
"""Name in Sample to the member's name, its encoder and its decoder."""
_TARGETS = ("bounds", "type", "axis", "origin", "motion", "parent", "limits", "movable")


@dataclass(frozen=True, kw_only=True)
class EncodedSample:
    """A sample's members in their order in the tar; names lack the asset id."""

    asset_id: str
    members: tuple[tuple[str, bytes], ...]


def encoded(sample: Sample) -> EncodedSample:
    """The sample as members, checked; equal samples give equal bytes.

    Raises:
        ShardError: the sample's images contradict each other.
    """
    check_images(sample)
    depths = codec.depth_range(sample.depth, sample.part_depth)
    members = [("meta.json", _meta_text(sample, depths)), ("arrays.npz", _arrays(sample))]
    for t in range(sample.shape[0]):
        for v in range(sample.shape[1]):
            members += _images(sample, t, v, depths)
    return EncodedSample(asset_id=sample.meta.asset_id, members=tuple(members))


def decoded(
    read: Callable[[str], bytes],
    *,
    where: str,
    states: Sequence[int] | None = None,
    views: Sequence[int] | None = None,
) -> Sample:
    """The sample whose member NAME holds `read(NAME)`; only the states and views asked for.

    Raises:
        ShardError: another schema, or members that do not fit each other; `where` names the place.
    """
    facts = sample_facts(read, where=where)
    with np.load(io.BytesIO(read("arrays.npz")), allow_pickle=False) as archive:
        arrays = {name: archive[name] for name in archive.files}
    t_all, v_all = arrays["camera_from_world"].shape[:2]
    ts = _chosen(states, t_all, f"{where}: states")
    vs = _chosen(views, v_all, f"{where}: views")
    width, height = (int(length) for length in arrays["size"])
    depths = codec.DepthRange(**facts["depth_range"])

    def cameras(prefix: str) -> Cameras:
        return Cameras(
            intrinsics=arrays[f"{prefix}intrinsics"][vs],
            camera_from_world=arrays[f"{prefix}camera_from_world"][np.ix_(ts, vs)],
            size=(width, height),
        )

    def images(t: int, v: int) -> dict[str, NDArray[Any]]:
        return _read_images(read, _prefix(t, v), height, depths) | _read_optional(
            read, _prefix(t, v), facts["images"]
        )

    return Sample(
        meta=_meta(facts),
        cameras=cameras(""),
        stated_cameras=cameras("stated_") if "stated_intrinsics" in arrays else None,
        targets=Targets(
            **{name: arrays[name] for name in _TARGETS} | {"motion": arrays["motion"][ts]}
        ),
        q=_joint_values(facts, ts),
        center=arrays["center"],
        radius=float(arrays["radius"]),
        **_stacked([[images(t, v) for v in vs] for t in ts]),
    )


def sample_facts(read: Callable[[str], bytes], *, where: str) -> dict[str, Any]:
    """What `meta.json` says.

    Raises:
        ShardError: it has another schema.
    """
    facts: dict[str, Any] = json.loads(read("meta.json"))
    if facts.get("schema") != SAMPLE_SCHEMA:
        raise ShardError(
            f"{where}: sample schema is {facts.get('schema')!r}, this release reads "
            f"{SAMPLE_SCHEMA!r}; render and pack again, or read it with the release that wrote it "
            f"({facts.get('versions')})"
        )
    return facts


def _chosen(given: Sequence[int] | None, count: int, where: str) -> list[int]:
    numbers = list(range(count)) if given is None else list(given)
    if not numbers or not all(0 <= number < count for number in numbers):
        raise ShardError(f"{where} {numbers} asked for; expected one or more of 0 to {count - 1}")
    return numbers


def _prefix(t: int, v: int) -> str:
    return f"s{t}v{v:02d}"


def _images(sample: Sample, t: int, v: int, depths: codec.DepthRange) -> list[tuple[str, bytes]]:
    at, strip = (t, v), codec.strip
    images = {
        "rgba.webp": codec.webp(sample.rgba[at]),
        "part.png": codec.png(sample.part_id[at]),
        "depth.png": codec.png(depths.encode(sample.depth[at])),
        "normal.webp": codec.webp(codec.normal_codes(sample.normal[at])),
        "parts.rgba.webp": codec.webp(strip(sample.part_rgba[at])),
        "parts.depth.png": codec.png(strip(depths.encode(sample.part_depth[at]))),
        "parts.normal.webp": codec.webp(strip(codec.normal_codes(sample.part_normal[at]))),
    }
    images |= {
        file: write(getattr(sample, name)[at])
        for name, (file, write, _) in _OPTIONAL.items()
        if name in sample.images
    }
    return [(f"{_prefix(t, v)}.{name}", data) for name, data in images.items()]


def _read_images(
    read: Callable[[str], bytes], prefix: str, height: int, depths: codec.DepthRange
) -> dict[str, NDArray[Any]]:
    def member(name: str) -> bytes:
        return read(f"{prefix}.{name}")

    def parts(image: NDArray[Any]) -> NDArray[Any]:
        return image.reshape(-1, height, *image.shape[1:])

    return {
        "rgba": codec.read_rgba(member("rgba.webp")),
        "part_id": codec.read_gray8(member("part.png")),
        "depth": depths.decode(codec.read_gray16(member("depth.png"))),
        "normal": codec.decoded_normals(codec.read_rgb(member("normal.webp"))),
        "part_rgba": parts(codec.read_rgba(member("parts.rgba.webp"))),
        "part_depth": depths.decode(parts(codec.read_gray16(member("parts.depth.png")))),
        "part_normal": codec.decoded_normals(parts(codec.read_rgb(member("parts.normal.webp")))),
    }


def _read_optional(
    read: Callable[[str], bytes], prefix: str, images: Sequence[str]
) -> dict[str, NDArray[Any]]:
    return {
        name: decode(read(f"{prefix}.{file}"))
        for name, (file, _, decode) in _OPTIONAL.items()
        if name in images
    }


def _stacked(images: list[list[dict[str, NDArray[Any]]]]) -> dict[str, Any]:
    return {
        name: np.stack([np.stack([view[name] for view in row]) for row in images])
        for name in images[0][0]
    }


def _arrays(sample: Sample) -> bytes:
    """`numpy.savez` puts a fixed date into its zip, so equal arrays give equal bytes."""
    arrays: dict[str, Any] = {
        "intrinsics": sample.cameras.intrinsics,
        "camera_from_world": sample.cameras.camera_from_world,
        "size": np.array(sample.cameras.size, np.int32),
        "center": sample.center,
        "radius": np.float64(sample.radius),
    } | {name: getattr(sample.targets, name) for name in _TARGETS}
    if sample.stated_cameras is not None:
        arrays["stated_intrinsics"] = sample.stated_cameras.intrinsics
        arrays["stated_camera_from_world"] = sample.stated_cameras.camera_from_world
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def _meta_text(sample: Sample, depths: codec.DepthRange) -> bytes:
    names = [joint.name for joint in sample.meta.joints]
    facts = {name: getattr(sample.meta, name) for name in SampleMeta.__dataclass_fields__} | {
        "schema": SAMPLE_SCHEMA,
        "conventions": CONVENTIONS,
        "depth_range": depths,
        "images": sample.images,
        "states": [dict(zip(names, row, strict=True)) for row in sample.q.tolist()],
        "shape": dict(
            zip(("states", "views", "slots", "height", "width"), sample.shape, strict=True)
        ),
    }
    return canonical_json(facts).encode()


def _joint_values(facts: dict[str, Any], states: list[int]) -> NDArray[np.float64]:
    """(T, J) q in the order of the joints."""
    names = [joint["name"] for joint in facts["joints"]]
    return np.array([[facts["states"][t][name] for name in names] for t in states], np.float64)


def _meta(facts: dict[str, Any]) -> SampleMeta:
    return SampleMeta(
        asset_id=facts["asset_id"],
        category=facts["category"],
        seed=facts["seed"],
        index=facts["index"],
        parts=tuple(PartLabel(**part) for part in facts["parts"]),
        joints=tuple(_joint(joint) for joint in facts["joints"]),
        preconditions=tuple(Precondition(**rule) for rule in facts["preconditions"]),
        versions=facts["versions"],
        shading=facts["shading"],
        light=facts["light"],
        effects=facts["effects"],
        rendering=facts["rendering"],
        donors=tuple(facts["donors"]),
        slots=facts["slots"],
        parts_left_out=tuple(facts["parts_left_out"]),
    )


def _joint(facts: dict[str, Any]) -> Joint:
    def built(kind: type, key: str) -> Any:
        return None if facts.get(key) is None else kind(**facts[key])

    return Joint(
        **facts
        | {
            "axis": tuple(facts["axis"]),
            "origin": tuple(facts["origin"]),
            "limit": built(Limit, "limit"),
            "spring": built(Spring, "spring"),
            "latch": built(Latch, "latch"),
            "mimic": built(Mimic, "mimic"),
        }
    )
