"""The vocabulary of part roles: what a `DraftPart.label` may say, and what such a part does."""

from collections.abc import Mapping
from dataclasses import dataclass

from artgen.core.errors import KinematicError, did_you_mean

Span = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Role:
    """What a word in the vocabulary stands for.

    Attributes:
        meaning: one line for the documentation.
        turning: least and most friction of a hinge that moves such a part, N m.
        sliding: least and most friction of a slide that moves such a part, N.
        closes: rest is its closed end: it shuts an opening or is stowed in the object, so it can
            be pushed no further in, and q > 0 takes it out.
        edged: a hinge lies on an edge of it; else it may turn about its middle or an arm.
    """

    meaning: str
    turning: Span = (0.0, 5.0)
    sliding: Span = (0.0, 50.0)
    closes: bool = False
    edged: bool = False


DOOR: Span = (0.5, 5.0)
"""N m; what people find neither loose nor stuck."""
DRAWER: Span = (5.0, 50.0)
"""N; likewise."""

ROLES: Mapping[str, Role] = {
    "base": Role(meaning="the fixed part that all others hang on; always the first"),
    # What closes an opening.
    "door": Role(
        meaning="closes an opening in a face; turns about an edge or slides",
        turning=DOOR, sliding=DRAWER, closes=True, edged=True,
    ),
    "lid": Role(
        meaning="covers an opening from above, or another half of the object",
        turning=(0.02, 5.0), sliding=(0.5, 50.0), closes=True, edged=True,
    ),
    "flap": Role(
        meaning="a light panel that folds about a crease or a small hinge",
        turning=(0.005, 1.0), closes=True, edged=True,
    ),
    "cover": Role(
        meaning="hides a compartment: battery, paper, detergent, dust",
        turning=(0.01, 5.0), sliding=(0.5, 50.0), closes=True, edged=True,
    ),
    "sash": Role(
        meaning="the glazed frame of a window that turns, tilts or slides",
        turning=DOOR, sliding=DRAWER, closes=True, edged=True,
    ),
    # What slides out and holds things.
    "drawer": Role(meaning="an open box behind a front, slides out", sliding=DRAWER, closes=True),
    "rack": Role(meaning="a basket or grid of wire that slides out", sliding=DRAWER, closes=True),
    "tray": Role(meaning="a shallow pan that slides out", sliding=(1.0, 50.0), closes=True),
    "shelf": Role(meaning="a plate that slides out", sliding=DRAWER, closes=True),
    "bin": Role(meaning="a container that is taken out", sliding=(1.0, 50.0), closes=True),
    "basket": Role(meaning="a container of wire or mesh", sliding=(1.0, 50.0), closes=True),
    "jug": Role(meaning="holds a liquid; lifted off the base it stands on", sliding=(0.2, 50.0),
                closes=True),
    # What a hand takes hold of.
    "handle": Role(
        meaning="carries or moves the whole object: bails, folding and telescopic handles",
        turning=(0.005, 2.0), sliding=(1.0, 50.0),
    ),
    "lever": Role(meaning="turned or pressed to work something", turning=(0.02, 5.0),
                  sliding=(1.0, 50.0)),
    "latch": Role(meaning="holds a door or lid shut", turning=(0.01, 2.0), sliding=(0.5, 30.0)),
    "knob": Role(meaning="turned between fingers to set something", turning=(0.005, 0.5),
                 sliding=(0.2, 15.0)),
    "dial": Role(meaning="a graduated disc that is turned", turning=(0.002, 0.5)),
    "button": Role(meaning="pressed by a finger", turning=(0.001, 0.5), sliding=(0.2, 15.0)),
    "pedal": Role(meaning="pressed by a foot", turning=(0.1, 20.0)),
    # What turns by itself or carries something that turns.
    "turntable": Role(meaning="a plate that turns with what lies on it", turning=(0.001, 0.5)),
    "drum": Role(meaning="a hollow cylinder that turns", turning=(0.01, 2.0)),
    "spray_arm": Role(meaning="an arm that water turns", turning=(0.001, 0.5)),
    "wheel": Role(meaning="rolls", turning=(0.0, 0.5)),
    "caster": Role(meaning="a fork that swivels above its wheel", turning=(0.0, 1.0)),
    # Links of furniture and tools.
    "seat": Role(meaning="carries a person", turning=(0.05, 20.0), sliding=(5.0, 500.0)),
    "backrest": Role(meaning="a person leans on it", turning=(0.5, 60.0), sliding=(5.0, 100.0)),
    "armrest": Role(meaning="an arm lies on it", turning=(0.1, 20.0), sliding=(5.0, 100.0)),
    "headrest": Role(meaning="a head leans on it", turning=(0.1, 20.0), sliding=(3.0, 60.0)),
    "column": Role(meaning="a post that lengthens or turns", turning=(0.05, 20.0),
                   sliding=(5.0, 500.0)),
    "leg": Role(meaning="carries the object and folds", turning=(0.05, 20.0), sliding=(1.0, 100.0)),
    "arm": Role(meaning="a link between two joints", turning=(0.005, 20.0), sliding=(1.0, 100.0)),
    "head": Role(meaning="the end of a chain: a lampshade, a spray head", turning=(0.005, 5.0),
                 sliding=(1.0, 50.0)),
    "spout": Role(meaning="water leaves it; turns or is pulled out", turning=(0.02, 5.0),
                  sliding=(1.0, 50.0)),
    "blade": Role(meaning="cuts or strikes against another", turning=(0.005, 2.0),
                  sliding=(0.5, 30.0)),
    "carriage": Role(meaning="runs along a rail inside: a printer's ink cartridges",
                     sliding=(0.2, 20.0)),
    "pusher": Role(meaning="moves what is inside: a toaster's bread lift, a stapler's follower",
                   sliding=(0.5, 30.0)),
    # What a source does not name.
    "part": Role(meaning="moves; what it is for is not known", turning=(0.0, 100.0),
                 sliding=(0.0, 1000.0)),
}  # fmt: skip
"""Word to role; `docs/conventions.md` prints this table."""


def roles_table() -> str:
    """The vocabulary as a table of Markdown."""
    rows = [
        "| role | what it is | turning, N m | sliding, N | closes | edge |",
        "|---|---|---|---|---|---|",
    ]
    for word, role in ROLES.items():
        spans = (f"{low:g} to {high:g}" for low, high in (role.turning, role.sliding))
        flags = ("yes" if flag else "" for flag in (role.closes, role.edged))
        rows.append("| " + " | ".join((f"`{word}`", role.meaning, *spans, *flags)) + " |")
    return "\n".join(rows)


def role_of(label: str) -> Role:
    """The role that a label names.

    Raises:
        KinematicError: the word is not in the vocabulary.
    """
    if label not in ROLES:
        raise KinematicError(
            f"{label!r} is no role of a part{did_you_mean(label, list(ROLES))}; "
            f"known: {', '.join(ROLES)}"
        )
    return ROLES[label]
