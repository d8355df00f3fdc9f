"""What a network is, what its losses weigh and what a run is made of: frozen, torch-free, JSON.

Every default is the paper's reading; where the paper is silent, the attribute says so.
"""

import dataclasses
from dataclasses import dataclass
from typing import Literal

from artgen.core.errors import ModelError
from artgen.core.jsonio import canonical_json
from model.config_json import LATER, decoded
from model.data.config import DataConfig
from model.training.schedule import TrainConfig

Size = Literal["nano", "s", "paper"]
Direction = Literal["image_from_part", "part_from_image", "both"]
SelfScope = Literal["joint", "alternate"]
SlotTokens = Literal["planes", "one"]
SlotEmbedding = Literal["separate", "shared"]
SlotVector = Literal["token", "mean"]
MotionHead = Literal["vector", "state_tokens"]
RayCode = Literal["patch", "pixel"]
Upsampler = Literal["linear", "transposed"]
SphereBias = Literal["paper", "normalized", "smallest_side"]


@dataclass(frozen=True, kw_only=True)
class ImageTokens:
    """How images become tokens.

    Attributes:
        image_px: side of the square images. The paper does not state it.
        patch_px: side of a patch. Not stated.
        alpha: whether the mask is a fourth channel beside the color. Not stated; the paper blends
            the background away.
        rays: Pluecker coordinates (direction, origin x direction) of each patch's middle, or of
            every pixel. Not stated.
        ray_octaves: how many octaves of sines and cosines, from a wave of 4 on, stand beside each
            Pluecker coordinate, so that attention can tell neighboring rays apart; 0 is the paper.
        states: rows of the table of learned state vectors, the most states an object can have.
        state_dim: length of those vectors.
        encoder: who supplies semantics: `none`, `conv`, `efflite0`, `dinov2:FOLDER` (the paper's)
            or `timm:ARCHITECTURE:FILE`.
        frozen: whether the encoder keeps its weights; `conv` is always learned.
        blind: whether colors and masks are withheld, so that cameras and the number of parts are
            all that is known: the baseline that tells what images are worth.
    """

    image_px: int = 256
    patch_px: int = 8
    alpha: bool = False
    rays: RayCode = "patch"
    states: int = 2
    state_dim: int = 64
    encoder: str = "none"
    frozen: bool = True
    blind: bool = dataclasses.field(default=False, metadata=LATER)
    ray_octaves: int = dataclasses.field(default=0, metadata=LATER)

    def __post_init__(self) -> None:
        if self.ray_octaves < 0:
            raise ModelError(f"images: ray_octaves is {self.ray_octaves}; expected 0 or more")
        if self.image_px % self.patch_px:
            raise ModelError(
                f"images of {self.image_px} px do not divide into patches of {self.patch_px} px; "
                "choose a multiple"
            )


@dataclass(frozen=True, kw_only=True)
class PlaneConfig:
    """The hexa-plane of a part, between the trunk and the field.

    Attributes:
        grid: rows and columns of a plane as the trunk sees it.
        scale: how many rows of the upsampled plane come of one.
        channels: features of a point on an upsampled plane. Not stated.
        upsampler: `linear` unfolds each token to a patch of the plane; `transposed` doubles by
            transposed convolutions. Not stated.
        tokens: `planes` gives every place of the six planes a token of its own; `one` blows a
            slot's single token up. Not stated; only the first explains the paper's figures.
    """

    grid: int = 24
    scale: int = 8
    channels: int = 32
    upsampler: Upsampler = "linear"
    tokens: SlotTokens = "planes"

    def __post_init__(self) -> None:
        if self.upsampler == "transposed" and self.scale & (self.scale - 1):
            raise ModelError(
                f"transposed convolutions double; a scale of {self.scale} is no power of two"
            )


@dataclass(frozen=True, kw_only=True)
class FieldConfig:
    """How features of the planes become distance and color.

    Attributes:
        hidden: width of both small networks. Not stated.
        layers: hidden layers of each. Not stated.
        bias: the sphere that a part starts as: `paper` |x| - 0.1 in radii about the box's middle;
            `normalized` |x| - 0.5 in coordinates of the box; `smallest_side` the latter times the
            smallest half side, so that values stay lengths.
        octant_blend: half width, in coordinates of the box, over which the two planes of a pair
            mix; 0 switches hard, as the paper does.
    """

    hidden: int = 64
    layers: int = 2
    bias: SphereBias = "paper"
    octant_blend: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Trunk:
    """The transformer.

    Attributes:
        width: channels of a token.
        blocks: how many blocks.
        pattern: X cross-attention, S self-attention; repeated over the blocks.
        heads: of every attention.
        mlp_ratio: hidden width of a block's network over `width`. Not stated.
        direction: who asks in cross-attention: the image tokens (the paper), the part tokens, or
            each the other.
        scope: `joint` lets self-attention see all tokens; `alternate` lets every second one, but
            never the last, see within a part, and within an image, alone.
        shared_mlp: whether both streams share the network after self-attention. Not stated.
        qk_norm: whether queries and keys are normalized. Not stated.
        recompute: whether blocks are computed again in the backward pass, to save memory.
    """

    width: int = 256
    blocks: int = 32
    pattern: str = "XXXS"
    heads: int = 16
    mlp_ratio: float = 4.0
    direction: Direction = "image_from_part"
    scope: SelfScope = "joint"
    shared_mlp: bool = False
    qk_norm: bool = True
    recompute: bool = False

    def __post_init__(self) -> None:
        if not self.pattern or set(self.pattern) - {"X", "S"}:
            raise ModelError(f"trunk: pattern {self.pattern!r} must consist of X and S")
        if self.width % self.heads:
            raise ModelError(f"trunk: {self.heads} heads do not divide a width of {self.width}")
        layout = self.layout
        if self.direction == "image_from_part" and "X" in layout[layout.rfind("S") + 1 :]:
            raise ModelError(
                f"trunk: blocks {layout} end in cross-attention that no part reads any more; let "
                "the last X be followed by an S, or let parts ask"
            )

    @property
    def layout(self) -> str:
        """A letter for each block: X cross-, S joint self-attention, W self-attention within."""
        tiled = (self.pattern * self.blocks)[: self.blocks]
        if self.scope == "joint":
            return tiled
        first, *selves = tiled.split("S")
        joint_last = ["SW"[(len(selves) - 1 - k) % 2] for k in range(len(selves))]
        return first + "".join(s + x for s, x in zip(joint_last, selves, strict=True))


@dataclass(frozen=True, kw_only=True)
class ModelConfig:
    """The network.

    Attributes:
        slots: the most parts an object can have, base included.
        slot_embedding: `separate` learns every token of every slot; `shared` learns one set and a
            vector for each slot's number. Not stated.
        slot_vector: what a slot's articulation is read from: a `token` of its own, or the `mean` of
            its plane tokens. Not stated.
        planes: None for articulation alone.
        motion: `vector` reads the motion of all states from a slot's vector; `state_tokens` gives
            each slot one more token for every state.
        limits: whether joint limits are predicted; beyond the paper.
        tree: whether the parent of each part is predicted; beyond the paper.
        count: whether the number of parts is predicted; beyond the paper.
    """

    images: ImageTokens = dataclasses.field(default_factory=ImageTokens)
    trunk: Trunk = dataclasses.field(default_factory=Trunk)
    planes: PlaneConfig | None = dataclasses.field(default_factory=PlaneConfig)
    field: FieldConfig = dataclasses.field(default_factory=FieldConfig)
    slots: int = 8
    slot_embedding: SlotEmbedding = "separate"
    slot_vector: SlotVector = "token"
    motion: MotionHead = "vector"
    limits: bool = False
    tree: bool = False
    count: bool = False


@dataclass(frozen=True, kw_only=True)
class LossWeights:
    """What each term counts in the sum, and how ambiguous ones are read; 0 leaves a term out.

    The paper states no weight. Lengths are in radii. Motions are small numbers (a quarter turn is
    0.25, a drawer's travel some 0.15), so their square needs a large weight to be learned.

    Attributes:
        center: squared distance of box centers.
        size: squared difference of box sizes.
        overlap: 1 - generalized IoU of boxes; beyond the paper: squared lengths hardly see small
            parts, of which this asks as much as of large ones.
        type: cross-entropy of revolute and prismatic, movable parts.
        axis: squared difference of unit axes, movable parts.
        origin: squared distance of axis points, revolute parts.
        motion: squared difference of motions, movable parts; see `motion_as`.
        limits: squared difference of limits, movable parts.
        range: 1 - generalized IoU of ranges, movable parts: squares hardly see a button's way.
        parent: cross-entropy of parents.
        count: cross-entropy of the number of parts.
        part_rgb: squared difference of colors, each part seen alone.
        part_mask: squared difference of coverage, each part seen alone.
        part_perceptual: distance of image features, each part seen alone.
        rgb: squared difference of colors of the whole object; the paper's loss is per part.
        mask: squared difference of coverage of the whole object.
        distance: absolute difference of distances to the first surface; beyond the paper.
        origin_to: `point` holds origins to the axis point nearest the box's middle; `line` to any
            point of the true axis.
        motion_as: `numbers` compares motions as they are, `paths` the ways that corners of a part's
            box go, in radii: a dial that nobody sees turn then counts less than a door.
        axis_sign: `data` learns that positive motion opens; `free` lets axis and motion flip.
        unmoved: joints whose motion varies less over the states do not teach axis and origin.
    """

    center: float = 10.0
    size: float = 10.0
    type: float = 0.3
    axis: float = 1.0
    origin: float = 10.0
    motion: float = 100.0
    limits: float = 10.0
    parent: float = 0.3
    count: float = 0.3
    part_rgb: float = 1.0
    part_mask: float = 1.0
    part_perceptual: float = 0.5
    rgb: float = 0.0
    mask: float = 0.0
    distance: float = 0.0
    origin_to: Literal["point", "line"] = "point"
    axis_sign: Literal["data", "free"] = "data"
    unmoved: float = 0.0
    overlap: float = dataclasses.field(default=0.0, metadata=LATER)
    motion_as: Literal["numbers", "paths"] = dataclasses.field(default="numbers", metadata=LATER)
    range: float = dataclasses.field(default=0.0, metadata=LATER)


@dataclass(frozen=True, kw_only=True)
class Config:
    """A run: `recipe` at `size`, with every choice spelled out.

    Attributes:
        recipe: name of the recipe that this began as.
        size: name of the size that this began as.
    """

    recipe: str
    size: Size
    model: ModelConfig = dataclasses.field(default_factory=ModelConfig)
    data: DataConfig = dataclasses.field(default_factory=lambda: DataConfig(input_px=256))
    weights: LossWeights = dataclasses.field(default_factory=LossWeights)
    train: TrainConfig = dataclasses.field(default_factory=TrainConfig)

    def __post_init__(self) -> None:
        images, data = self.model.images, self.data
        if data.input_px != images.image_px:
            raise ModelError(
                f"data.input_px is {data.input_px}, model.images.image_px {images.image_px}; make "
                "them equal"
            )
        if data.states > images.states or data.slots > self.model.slots:
            raise ModelError(
                f"data has {data.states} states and {data.slots} parts; the network's tables hold "
                f"{images.states} (model.images.states) and {self.model.slots} (model.slots)"
            )

    def to_json(self) -> str:
        """Canonical JSON of the run."""
        return canonical_json(self)

    @classmethod
    def from_json(cls, text: str) -> "Config":
        """The run that `to_json` wrote.

        Raises:
            ModelError: a key is unknown, missing or of another type.
        """
        return decoded(cls, text)
