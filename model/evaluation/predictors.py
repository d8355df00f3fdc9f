"""Who predicts: a trained network, or a baseline, behind one call.

B objects, T states, V views, P part slots, H W pixels, digits a length.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import torch

from artgen.core.errors import GeometryError
from artgen.core.mesh import Floats, TriMesh
from artgen.core.stream import Stream
from model.batch import Articulation, Batch
from model.config import Config
from model.evaluation.baselines import MeanLayout, NearestNeighbor, pixel_feature
from model.evaluation.gates import Gates
from model.evaluation.held_out import HeldOut, blinded, flips
from model.evaluation.images import ImageScores, Perceptual, image_scores
from model.evaluation.layout import Layout
from model.evaluation.predictions import layout_of, with_observed_limits
from model.evaluation.simulated import prediction_gates
from model.field.extract import ColoredMesh, part_meshes
from model.field.kinematics import world_from_rest
from model.field.pictures import pictures
from model.fitting.object_fit import FitConfig, fit_object
from model.infer import predict
from model.network.art import Art
from model.network.encoders.protocol import Encoder
from model.network.prediction import Prediction

Images = dict[str, list[ImageScores]]


@dataclass(frozen=True, eq=False)
class Guess:
    """What was predicted of one object, in radii, how its images compare, and what MuJoCo says.

    Attributes:
        rest: the observed state that it takes for rest; None where it is closed, as the truth is.
    """

    layout: Layout
    images: Images
    gates: Gates | None = None
    rest: int | None = None


class Predictor(Protocol):
    """Predicts from what is shown alone; `item.everything` serves to judge images."""

    def __call__(self, item: HeldOut) -> Guess:
        """The prediction of one object."""
        ...


@dataclass(frozen=True, eq=False)
class MeanPredictor:
    """The mean layout of the category and number of parts, which it is told."""

    mean: MeanLayout

    def __call__(self, item: HeldOut) -> Guess:
        """Looks at no image."""
        return Guess(self.mean.of(item.category, len(item.layout)), {})


@dataclass(frozen=True, eq=False)
class NeighborPredictor:
    """The nearest training object; it is told the number of parts."""

    neighbor: NearestNeighbor
    encoder: Encoder | None

    def __call__(self, item: HeldOut) -> Guess:
        """Looks at all images that are shown."""
        feature = feature_of(item.shown, self.encoder)
        return Guess(self.neighbor.of(feature, len(item.layout)), {})


def feature_of(batch: Batch, encoder: Encoder | None) -> Floats:
    """(D,) of the one object of a batch: gray thumbnails of its images, or the means of an
    encoder's maps over each of them."""
    rgb_FCHW = batch.images.rgb_BTV3HW[0].flatten(0, 1)
    if encoder is None:
        return pixel_feature(rgb_FCHW.double().numpy())
    with torch.inference_mode():
        maps = encoder(rgb_FCHW)
    return np.asarray(maps.mean(dim=(-1, -2)).flatten().double().numpy())


@dataclass(frozen=True, eq=False)
class ArtPredictor:
    """A trained network.

    Attributes:
        counts: whether it counts the parts itself; else it is told, as the paper's is.
        resolution: cells of marching cubes along a part; 0 makes no surfaces.
        samples: a ray, for images; 0 renders none.
        gated: whether the object is put together and driven in MuJoCo.
        perceptual: LPIPS, where its weights are at hand.
        blind: whether it is shown nothing, to see what it knows without.
    """

    art: Art
    config: Config
    counts: bool
    resolution: int
    samples: int
    gated: bool
    perceptual: Perceptual | None = None
    blind: bool = False

    def __call__(self, item: HeldOut) -> Guess:
        """Looks at the images that are shown."""
        parts = None if self.counts else len(item.layout)
        seen = blinded(item.shown.images) if self.blind else item.shown.images
        prediction = predict(self.art, self.config, seen, parts=parts)
        shaped = prediction.planes_BP6CHW is not None
        meshes = None
        if shaped and self.resolution:
            found = part_meshes(
                prediction.field(), prediction.articulation, resolution=self.resolution
            )
            meshes = surfaces(found)
        layout = layout_of(
            prediction.articulation, 0, name=item.name, category=item.category, meshes=meshes
        )
        layout = layout if prediction.limited else with_observed_limits(layout)
        images = self._images(prediction, item) if shaped and self.samples else {}
        held = None
        if self.gated:
            radius = float(item.shown.radius_B[0])
            held = prediction_gates(prediction, radius=radius, resolution=self.resolution)
        first = self.config.data.rest == "first"
        return Guess(layout, images, held, rest=0 if first else None)

    def _images(self, prediction: Prediction, item: HeldOut) -> Images:
        """Of views that were not shown, in the states that were and in those that were not.

        A state that was not shown is reached by the true motion, its sign turned with the axis.
        """
        everything = item.everything.to(prediction.type_logits_BP2.device)
        seen = item.shown.images.rgb_BTV3HW.shape[1:3]
        cameras = everything.images
        poses = cameras.camera_from_world_BTV44[:, :, seen[1] :]
        if not poses.shape[2]:
            return {}
        height, width = cameras.rgb_BTV3HW.shape[-2:]
        truth = everything.truth
        if self.config.data.rest == "first":
            truth = counted_from_first(truth)
        articulation = with_more_states(prediction.articulation, truth)
        made = pictures(
            prediction.field(),
            articulation,
            cameras.intrinsics_BTV33[:, :, seen[1] :],
            poses,
            height=height,
            width=width,
            inverse_beta=self.config.train.inverse_beta[1],
            samples=self.samples,
        )
        found: Images = {"images": [], "images.new_state": []}
        for t in range(poses.shape[1]):
            for v in range(poses.shape[2]):
                own = found["images" if t < seen[0] else "images.new_state"]
                true = everything.images
                own.append(
                    image_scores(
                        _rows(made.over(1.0)[0, t, v]),
                        _rows(true.rgb_BTV3HW[0, t, seen[1] + v]),
                        made.alpha_BTVHW[0, t, v].cpu().numpy() > 0.5,
                        true.alpha_BTVHW[0, t, seen[1] + v].cpu().numpy() > 0.5,
                        perceptual=self.perceptual,
                    )
                )
        return found


@dataclass(frozen=True, eq=False)
class FitPredictor:
    """A field and joints fitted to the object's own images, as PARIS does; it is told the number of
    parts and their types, and takes the first state for rest."""

    config: FitConfig

    def __call__(self, item: HeldOut) -> Guess:
        """Looks at the images that are shown."""
        stream = Stream(0, "evaluation", "fit", item.name)
        kinds = tuple(int(kind) for kind in item.layout.types)
        with torch.enable_grad():
            found = fit_object(
                item.shown.images, len(item.layout), self.config, stream, types=kinds
            )
        meshes = part_meshes(found.field, found.articulation, resolution=self.config.tight_cells)
        layout = layout_of(
            found.layout, 0, name=item.name, category=item.category, meshes=surfaces(meshes)
        )
        return Guess(with_observed_limits(layout), {}, rest=0)


def with_more_states(predicted: Articulation, true: Articulation) -> Articulation:
    """The prediction in the states that it was shown and, by the true motion, in the others."""
    slots, states = predicted.motion_BTP.shape[2], predicted.motion_BTP.shape[1]
    more = true.motion_BTP[:, states:, :slots]
    true_axes = dataclasses.replace(true, axis_BP3=true.axis_BP3[:, :slots])
    signed = more * flips(predicted, true_axes)[:, None]
    return dataclasses.replace(
        predicted, motion_BTP=torch.cat([predicted.motion_BTP, signed], dim=1)
    )


def counted_from_first(true: Articulation) -> Articulation:
    """Axes and motion of the truth as counted from its first state."""
    poses = world_from_rest(true)[:, 0]
    parents = true.parent_BP.clamp(min=0)[..., None, None].expand_as(poses)
    above = torch.gather(poses, 1, parents)[..., :3, :3]
    return dataclasses.replace(
        true,
        axis_BP3=(above @ true.axis_BP3[..., None])[..., 0],
        motion_BTP=true.motion_BTP - true.motion_BTP[:, :1],
    )


def surfaces(found: Sequence[ColoredMesh]) -> dict[int, TriMesh]:
    """Slot to its surface; slots whose surface has no triangle are left out."""
    meshes = {}
    for own in found:
        try:
            meshes[own.slot] = TriMesh(vertices=own.vertices, faces=own.faces)
        except GeometryError:
            continue
    return meshes


def _rows(image_3HW: torch.Tensor) -> Floats:
    """(H, W, 3) in [0, 1]."""
    return np.asarray(image_3HW.movedim(0, -1).double().cpu().numpy().clip(0.0, 1.0))
