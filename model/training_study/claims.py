"""What is claimed of the training, by the paper or by us, and the arms that would show it."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Kind = Literal["boxes", "shapes"]
Expected = Literal["worse", "better", "open"]

BOXES = ("model.planes=null", "data.rays=0")
"""Settings of runs that learn boxes and joints alone."""


@dataclass(frozen=True, kw_only=True)
class Arm:
    """A way to train.

    Attributes:
        kind: `boxes` learns boxes and joints alone, `shapes` renders as well.
        settings: what it changes of the usual run of its kind, as `artgen train --set` takes them.
        static: share of the updates that are spent on static pre-training first.
    """

    name: str
    kind: Kind
    settings: tuple[str, ...] = ()
    static: float = 0.0


ARMS: Mapping[str, Arm] = {
    arm.name: arm
    for arm in (
        Arm(name="boxes", kind="boxes"),
        Arm(name="blind", kind="boxes", settings=("model.images.blind=true",)),
        Arm(name="shuffled", kind="boxes", settings=("data.part_order=shuffled",)),
        Arm(name="first_rest", kind="boxes", settings=("data.rest=first",)),
        Arm(name="one_view", kind="boxes", settings=("data.views=1",)),
        Arm(name="four_views", kind="boxes", settings=("data.views=4",)),
        Arm(
            name="image_from_part",
            kind="boxes",
            settings=("model.trunk.direction=image_from_part",),
        ),
        Arm(name="both_ways", kind="boxes", settings=("model.trunk.direction=both",)),
        Arm(name="shapes", kind="shapes"),
        Arm(
            name="composite",
            kind="shapes",
            settings=(
                *("weights.part_rgb=0", "weights.part_mask=0", "weights.part_perceptual=0"),
                *("weights.rgb=1", "weights.mask=1"),
            ),
        ),
        Arm(name="pretrained", kind="shapes", static=0.25),
        Arm(name="shapes_first_rest", kind="shapes", settings=("data.rest=first",)),
    )
}
"""All ways to train, by name; `boxes` and `shapes` are the usual runs."""


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """An arm held against another.

    Attributes:
        expected: what the claim says of the arm; `open` where nobody claims anything.
    """

    arm: str
    against: str
    expected: Expected


@dataclass(frozen=True, kw_only=True)
class Claim:
    """One claim.

    Attributes:
        title: as a heading.
        said: what the paper states.
        metrics: by which it is judged, chosen before any run; the first decides.
        note: what a reader must know of the comparison.
    """

    name: str
    title: str
    said: str
    comparisons: tuple[Comparison, ...]
    metrics: tuple[str, ...]
    note: str = ""


DGIOU = "singapo.honest.nearest.rs_dgiou"
DCDIST = "singapo.honest.nearest.rs_dcdist"
CENTER = "states.nearest.center"
TYPE = "joints.nearest.type_right"
AXIS = "joints.nearest.axis_deg"
LINE = "joints.nearest.line"
STATE = "joints.nearest.state_share"
MASK = "images.mask_iou"
PSNR = "images.psnr"
PART_MASK = "masks.nearest.moving"

NAMES: Mapping[str, str] = {
    DGIOU: "dgIoU",
    DCDIST: "dcDist, radii",
    CENTER: "centers in the states, radii",
    TYPE: "joint type right",
    AXIS: "axis, deg",
    LINE: "axis line, radii",
    STATE: "states, share of the range",
    MASK: "mask IoU",
    PSNR: "PSNR, dB",
    PART_MASK: "mask IoU of moving parts",
}
"""What pages call the metrics of a study."""

LAYOUT = (DGIOU, DCDIST, CENTER, TYPE, AXIS, LINE, STATE)
IMAGES = (MASK, PSNR, PART_MASK)
FREE_OF_FRAMES = (CENTER, TYPE, AXIS)

CLAIMS: tuple[Claim, ...] = (
    Claim(
        name="order",
        title="Parts have a canonical order",
        said="without it dgIoU rises from 0.665 to 1.118, dcDist from 0.082 to 0.208, and PSNR "
        "falls from 27.5 to 22.6 dB: the worst of all ablations",
        comparisons=(Comparison(arm="shuffled", against="boxes", expected="worse"),),
        metrics=LAYOUT,
        note="Parts are matched by nearness, so that a network that learned no order is not "
        "punished for slots; each object's order is arbitrary but always the same.",
    ),
    Claim(
        name="rest",
        title="Rest is closed",
        said="without a defined rest state dgIoU rises from 0.665 to 0.878, dcDist from 0.082 to "
        "0.113, and PSNR falls from 27.5 to 23.6 dB",
        comparisons=(
            Comparison(arm="first_rest", against="boxes", expected="worse"),
            Comparison(arm="shapes_first_rest", against="shapes", expected="worse"),
        ),
        metrics=(*FREE_OF_FRAMES, MASK, PSNR),
        note="Boxes at rest are other boxes in the two arms, so only what does not depend on the "
        "frame is compared: where the parts' centers are in the states that are shown, types, "
        "axes, and images.",
    ),
    Claim(
        name="part_loss",
        title="The loss sees every part alone",
        said="with the composite image alone PSNR falls from 27.5 to 24.5 dB, while dgIoU (0.665 "
        "to 0.681) and dcDist (0.082 to 0.075) hardly move",
        comparisons=(Comparison(arm="composite", against="shapes", expected="worse"),),
        metrics=(PSNR, MASK, PART_MASK, *LAYOUT),
    ),
    Claim(
        name="pretraining",
        title="Training begins with static objects",
        said="without static pre-training PSNR falls from 28.7 to 27.5 dB, dgIoU rises from 0.629 "
        "to 0.665, dcDist from 0.062 to 0.082",
        comparisons=(Comparison(arm="pretrained", against="shapes", expected="better"),),
        metrics=(DGIOU, DCDIST, PSNR, MASK, CENTER, TYPE, AXIS, LINE, STATE),
        note="Both arms make as many updates in all; the paper's pre-training came on top.",
    ),
    Claim(
        name="views",
        title="More views are better",
        said="one view instead of four: PSNR 26.0 instead of 28.7 dB, dgIoU 0.731 instead of "
        "0.629, dcDist 0.086 instead of 0.062",
        comparisons=(
            Comparison(arm="one_view", against="boxes", expected="worse"),
            Comparison(arm="four_views", against="boxes", expected="better"),
        ),
        metrics=LAYOUT,
        note="The usual run sees two views of each state.",
    ),
    Claim(
        name="direction",
        title="Image tokens read part tokens",
        said="the paper's cross-attention lets image tokens ask; it reports no other direction",
        comparisons=(
            Comparison(arm="image_from_part", against="boxes", expected="open"),
            Comparison(arm="both_ways", against="boxes", expected="open"),
        ),
        metrics=LAYOUT,
        note="In the usual run of this study part tokens ask. With both directions the trunk has "
        "more weights.",
    ),
    Claim(
        name="images",
        title="Images are used",
        said="nothing; this is the control: the same network, trained without a pixel",
        comparisons=(Comparison(arm="blind", against="boxes", expected="worse"),),
        metrics=LAYOUT,
        note="The blind network is told cameras and the number of parts, as all are. Cameras frame "
        "the object, so they tell something of its size.",
    ),
)
