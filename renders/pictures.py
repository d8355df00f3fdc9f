"""Pictures: what a backend made of a plan."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from artgen.imaging import Singles


@dataclass(frozen=True, kw_only=True)
class Pictures:
    """What a backend made of a plan.

    Attributes:
        images: for each shot of the plan (h, w, 4) float32 of its window, linear RGB premultiplied
            by alpha.
        cpu: CPU seconds by stage.
        effects: of light transport, as `Transport.described` states them.
    """

    images: Sequence[Singles]
    cpu: Mapping[str, float]
    effects: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
