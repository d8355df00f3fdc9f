"""Held-out items of a training source: what a network is shown, and what is true, kept apart.

An item has more views and states than the network sees: those are for judging its images.
B objects, T states, V views, P part slots, H W pixels, digits a length.
"""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import torch
from torch import Tensor

from artgen.core.mesh import TriMesh
from artgen.core.stream import Stream
from model.batch import Articulation, Batch, Images
from model.data.config import DataConfig
from model.data.items import Source
from model.data.soup import Soup
from model.data.soup_source import SoupSource
from model.evaluation.layout import Layout
from model.evaluation.predictions import layout_of

EXTRA_VIEWS = 2
EXTRA_STATES = 1
CPU = torch.device("cpu")
BLIND_INTRINSICS = ((60.0, 0.0, 24.0), (0.0, 60.0, 24.0), (0.0, 0.0, 1.0))
BLIND_POSE = (
    (1.0, 0.0, 0.0, 0.0),
    (0.0, 0.0, -1.0, 0.0),
    (0.0, 1.0, 0.0, 3.0),
    (0.0, 0.0, 0.0, 1.0),
)
"""Before the object, three radii away."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeldOut:
    """One object.

    Attributes:
        shown: a batch of this object with the views and states that a network may see.
        everything: with the extra ones behind them.
        layout: the truth in radii, with surfaces where the source has them.
    """

    name: str
    category: str
    shown: Batch
    everything: Batch
    layout: Layout


def held_out_config(config: DataConfig, *, extra: bool) -> DataConfig:
    """The data that judging needs: no rays, a white ground, one object at a time, the canonical
    truth, and more views and states where the source can make them."""
    return dataclasses.replace(
        config,
        batch=1,
        views=config.views + (EXTRA_VIEWS if extra else 0),
        states=config.states + (EXTRA_STATES if extra else 0),
        motion="states",
        rays=0,
        patch_px=0,
        targets_from="inputs",
        target_views=1,
        background="white",
        workers=0,
        part_order="canonical",
        rest="closed",
    )


def spread(count: int, length: int) -> Sequence[int]:
    """At most `count` of `length` positions, evenly: sources hold category after category."""
    total = min(count, length)
    return [k * length // total for k in range(total)]


def held_out(
    source: Source[Any], config: DataConfig, *, count: int, seed: int = 0
) -> Iterator[HeldOut]:
    """At most `count` objects, spread evenly over a source, each in a scene of its own.

    The scene follows from the object's position and `seed`.

    Args:
        config: of the network: `states` and `views` are those that it sees.
    """
    extra = isinstance(source, SoupSource)
    wide = held_out_config(config, extra=extra)
    for position in spread(count, len(source)):
        stream = Stream(seed, "evaluation", "held_out", position)
        batch = source.batch([source.plan(position, wide, stream)], wide, CPU)
        soup = source.library[source.positions[position]] if extra else None  # type: ignore[attr-defined]
        yield _item(batch, config, soup)


def _item(batch: Batch, config: DataConfig, soup: Soup | None) -> HeldOut:
    name, category = batch.asset_ids[0], batch.categories[0]
    shown = dataclasses.replace(
        batch,
        images=first_images(batch.images, states=config.states, views=config.views),
        truth=first_states(batch.truth, config.states),
    )
    meshes = None if soup is None else soup_meshes(soup)
    layout = layout_of(shown.truth, 0, name=name, category=category, meshes=meshes)
    return HeldOut(name=name, category=category, shown=shown, everything=batch, layout=layout)


def first_images(images: Images, *, states: int, views: int) -> Images:
    """The first states and views."""
    return images.mapped(lambda tensor: tensor[:, :states, :views])


def blinded(images: Images) -> Images:
    """Images that show nothing: white, and all from one camera, whatever was seen."""
    return Images(
        rgb_BTV3HW=torch.ones_like(images.rgb_BTV3HW),
        alpha_BTVHW=torch.zeros_like(images.alpha_BTVHW),
        intrinsics_BTV33=images.intrinsics_BTV33.new_tensor(BLIND_INTRINSICS).expand_as(
            images.intrinsics_BTV33
        ),
        camera_from_world_BTV44=images.camera_from_world_BTV44.new_tensor(BLIND_POSE).expand_as(
            images.camera_from_world_BTV44
        ),
    )


def first_states(articulation: Articulation, states: int) -> Articulation:
    """The articulation in its first states."""
    return dataclasses.replace(articulation, motion_BTP=articulation.motion_BTP[:, :states])


def soup_meshes(soup: Soup) -> dict[int, TriMesh]:
    """Part to its triangles at rest, in radii about the sphere's center."""
    vertices = (soup.vertices.astype(np.float64) - soup.center) / soup.radius
    found = {}
    for part in range(len(soup.parts)):
        faces = soup.faces[soup.part == part]
        if len(faces):
            used, index = np.unique(faces, return_inverse=True)
            found[part] = TriMesh(vertices=vertices[used], faces=index.reshape(-1, 3))
    return found


def flips(predicted: Articulation, true: Articulation) -> Tensor:
    """(B, P) -1 where an axis points against the true one, else 1."""
    along = (predicted.axis_BP3 * true.axis_BP3).sum(dim=-1)
    return torch.where(along < 0.0, -1.0, 1.0)
