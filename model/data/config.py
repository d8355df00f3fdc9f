"""DataConfig: what a training item is; torch-free, so that recipes and `--help` stay light."""

from dataclasses import dataclass, field
from typing import Literal

from artgen.core.conventions import ART_SLOTS
from artgen.core.errors import ModelError
from model.config_json import LATER

Motion = Literal["states", "one", "rest"]
Background = Literal["random", "white", "gray", "black"]
TargetViews = Literal["inputs", "others"]
PartOrder = Literal["canonical", "shuffled"]
Rest = Literal["closed", "first"]
Range = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class DataConfig:
    """What a batch holds.

    Attributes:
        seed: root of the order of items and of every draw.
        batch: items of all ranks together; a global cursor advances by it.
        slots: P; objects with more parts are counted and left out.
        states: T.
        views: V images of each state that the network sees.
        motion: `states` draws T states of their own, `one` shows a single drawn state T times,
            `rest` shows all parts at rest: the two kinds of static pre-training.
        input_px: width and height of the network's images.
        render_px: width and height of ray-cast images before the square crop.
        target_px: width and height of the cropped images that rays go through.
        target_views: images a state that rays are drawn from.
        targets_from: `inputs` takes the views that the network sees, `others` new ones, where the
            source has any.
        rays: supervised rays an item; 0 learns articulation alone.
        patch_px: 0 draws single rays; else rays are whole patches of this width and height, as
            perceptual losses need them, and `rays` must be a multiple of their area.
        mask_share: share of rays (or of middles of patches) drawn in a part's mask, dilated; the
            others are drawn in the box around that mask.
        dilation_px: by which masks and boxes grow before rays are drawn in them.
        background: color behind the network's images; `random` draws one an item.
        same_cameras: whether all states are seen by the same cameras.
        fov_deg: range of the field of view of ray-cast images.
        elevation_deg: range of the height of their cameras over the horizon.
        azimuth_deg: largest angle between their cameras and the front; 180 is all around.
        fill: share of a ray-cast image that the object fills, before the crop.
        pose_noise_deg: deviation of a turn about each camera's axes between the poses that are
            true and those that the network is told; rays stay true.
        pose_noise: deviation of a shift along each axis, radii.
        workers: processes that prepare items, one a core at most; the batches are the same at any
            number. A GPU waits where there are none.
        part_order: `canonical` is the paper's; `shuffled` gives the movable parts of each object
            slots in an arbitrary order, always the same one: its ablation.
        rest: `closed` counts boxes, axes and motion from all parts closed, as the paper; `first`
            from the first state that is shown: its ablation. Needs shapes, which shards lack.
    """

    seed: int = 0
    batch: int = 32
    slots: int = ART_SLOTS
    states: int = 2
    views: int = 4
    motion: Motion = "states"
    input_px: int = 128
    render_px: int = 160
    target_px: int = 128
    target_views: int = 1
    targets_from: TargetViews = "others"
    rays: int = 1024
    patch_px: int = 0
    mask_share: float = 0.5
    dilation_px: int = 2
    background: Background = "random"
    same_cameras: bool = True
    fov_deg: Range = (25.0, 50.0)
    elevation_deg: Range = (-10.0, 60.0)
    azimuth_deg: float = 180.0
    fill: float = 0.9
    pose_noise_deg: float = 0.0
    pose_noise: float = 0.0
    workers: int = 0
    part_order: PartOrder = field(default="canonical", metadata=LATER)
    rest: Rest = field(default="closed", metadata=LATER)

    def __post_init__(self) -> None:
        counts = (self.batch, self.slots, self.states, self.views, self.target_views)
        sizes = (self.input_px, self.render_px, self.target_px)
        if min(*counts, *sizes) < 1 or min(self.rays, self.patch_px, self.workers, self.seed) < 0:
            raise ModelError(
                f"data: batch, slots, states, views and target_views are {counts}, sizes {sizes} "
                f"px, each at least 1; rays {self.rays}, patch_px {self.patch_px}, workers "
                f"{self.workers} and seed {self.seed} at least 0"
            )
        if self.patch_px and (self.patch_px > self.target_px or self.rays % self.patch_px**2):
            raise ModelError(
                f"data: patches of {self.patch_px} px must fit into images of {self.target_px} px, "
                f"and {self.rays} rays must be whole patches of {self.patch_px**2}"
            )
        if self.targets_from == "inputs" and self.target_views > self.views:
            raise ModelError(
                f"data: {self.target_views} target views of {self.views} inputs; ask for fewer, or "
                "take them from the others"
            )
        self._check_ranges()

    def _check_ranges(self) -> None:
        for name in ("fov_deg", "elevation_deg"):
            low, high = getattr(self, name)
            if not -90.0 < low <= high < 90.0 or (name == "fov_deg" and low <= 0.0):
                raise ModelError(f"data: {name} {low}..{high} must ascend within 90 degrees")
        if min(self.pose_noise_deg, self.pose_noise) < 0.0:
            raise ModelError(
                f"data: pose_noise_deg {self.pose_noise_deg} and pose_noise {self.pose_noise} must "
                "be at least 0"
            )
        if not (0.0 <= self.mask_share <= 1.0 and 0.0 < self.fill <= 1.0):
            raise ModelError(
                f"data: mask_share {self.mask_share} must lie in [0, 1], fill {self.fill} in (0, 1]"
            )
