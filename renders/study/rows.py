"""From pictures to rows: what every setting costs, and how far it is from the reference."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from statistics import mean

from artgen.imaging import Singles
from artgen.render_job import DenoiseQuality, Prefilter
from renders.study.measures import Error, decibels, pooled_error, without_noise
from renders.study.pictures import Pictures, Target, mean_image
from renders.study.settings import Setting

KINDS = ("composite", "part")


@dataclass(frozen=True, kw_only=True)
class Row:
    """A setting, measured on the composites or on the parts alone of one scene at one size.

    Attributes:
        psnr_db, foreground_psnr_db: of sRGB over white, over all or over covered pixels; the
            reference's noise is taken off.
        flip: mean; the reference's noise is in it.
        cpu_s, wall_s: an image, warm.
        reference_psnr_db: of the reference itself; no better PSNR is ever stated.
    """

    scene: str
    kind: str
    size_px: int
    samples: int
    denoise: bool
    prefilter: Prefilter
    denoise_quality: DenoiseQuality
    adaptive: float
    bounces: int | None
    psnr_db: float
    foreground_psnr_db: float
    flip: float
    cpu_s: float
    wall_s: float
    reference_psnr_db: float

    @property
    def setting(self) -> Setting:
        """What was measured."""
        return Setting(
            samples=self.samples,
            denoise=self.denoise,
            prefilter=self.prefilter,
            denoise_quality=self.denoise_quality,
            adaptive=self.adaptive,
            bounces=self.bounces,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Truth:
    """The reference of a target: its images, and the errors of its own that halves tell."""

    images: tuple[Singles, ...]
    noise: dict[str, Error]


def truth(seen: Target, pictures: Sequence[Pictures]) -> Truth:
    """The mean of pictures; half the distance of the means of two halves is its noise."""
    count = len(seen.shots)
    halves = [
        [mean_image(half, k) for k in range(count)] for half in (pictures[::2], pictures[1::2])
    ]
    noise = {}
    for kind in KINDS:
        k = chosen(seen, kind)
        apart = pooled_error(halves[0][k], halves[1][k], seen.shots[k], seen.size)
        noise[kind] = Error(
            square=apart.square / 4.0, foreground=apart.foreground / 4.0, flip=apart.flip / 2.0
        )
    return Truth(images=tuple(mean_image(pictures, k) for k in range(count)), noise=noise)


def chosen(seen: Target, kind: str) -> slice:
    """Which of a target's shots are composites, or parts."""
    return slice(0, seen.composites) if kind == "composite" else slice(seen.composites, None)


def rows(seen: Target, setting: Setting, pictures: Pictures, true: Truth) -> list[Row]:
    """One for the composites, one for the parts."""
    found = []
    for kind in KINDS:
        k, noise = chosen(seen, kind), true.noise[kind]
        off = pooled_error(pictures.images[k], true.images[k], seen.shots[k], seen.size)
        found.append(
            Row(
                scene=seen.scene,
                kind=kind,
                size_px=seen.size,
                **asdict(setting),
                psnr_db=decibels(without_noise(off.square, noise.square)),
                foreground_psnr_db=decibels(without_noise(off.foreground, noise.foreground)),
                flip=off.flip,
                cpu_s=mean(pictures.cpu_s[k]),
                wall_s=mean(pictures.wall_s[k]),
                reference_psnr_db=decibels(noise.square),
            )
        )
    return found
