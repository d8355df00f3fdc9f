"""ForeignObject: what any source says of an articulated object, before it is one of ours."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from artgen.articulation.types import JointType, Vector
from artgen.core.mesh import Floats
from artgen.ingest.meshes.soup import Soup


@dataclass(frozen=True, kw_only=True, eq=False)
class ForeignShape:
    """One visible mesh of a part.

    Attributes:
        leaf: what the source calls it: handle, drawer_front; the part's own name where it says
            nothing.
        label: file or element, for messages.
        read: its triangles in the source's frame as drawn; raises ArtgenError or OSError.
    """

    leaf: str
    label: str
    read: Callable[[], Soup]


@dataclass(frozen=True, kw_only=True, eq=False)
class ForeignPart:
    """What moves as one: meshes, the source's word for it, and its mass where one is stated, kg."""

    name: str
    word: str
    shapes: tuple[ForeignShape, ...]
    mass: float | None = None


@dataclass(frozen=True, kw_only=True)
class ForeignJoint:
    """A joint in the source's units and frame, with all parts as drawn (q = 0).

    Attributes:
        axis: unit direction, as the source states it.
        origin: a point on the axis.
        start: q of the pose that the source calls the start, rad or units; None if it names none.
        lower: least q, rad or units; None where the joint has no stops, and so is `upper`.
        turns: a slider that also turns, which our joints cannot say.
        rest: q that the user says is closed; None leaves it to be found.
        number: how the source numbers the moved part, for messages and the user's table.
    """

    name: str
    type: JointType
    parent: str
    child: str
    axis: Vector
    origin: Vector
    lower: float | None
    upper: float | None
    start: float | None = None
    turns: bool = False
    rest: float | None = None
    number: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class ForeignObject:
    """Parts as drawn, and the tree of joints between them; the first part is the base.

    Attributes:
        dataset: which kind of source: partnet-mobility, urdf, static.
        id: of the object within it, as users name it: a folder's, a robot's, a file's.
        anno_id: number of the annotation, where the source has one beside the id.
        category: the source's word, or "".
        digest: hash of the files that were read for it.
        object_from_source: (3, 3) turn to z up, front -y.
        doubts: what the reader mended, left out or found odd.
        meters_per_unit: where the source states it.
        note: what a folder that we wrote ourselves says of itself.
    """

    dataset: str
    id: str
    category: str
    digest: str
    parts: tuple[ForeignPart, ...]
    joints: tuple[ForeignJoint, ...]
    object_from_source: Floats
    doubts: tuple[str, ...] = ()
    meters_per_unit: float | None = None
    anno_id: str | None = None
    note: Mapping[str, object] = field(default_factory=dict)

    @property
    def family(self) -> str:
        """What it shares with all that is made from it, so that splits never part them: of what
        we exported, that of the original."""
        stated = self.note.get("family")
        return stated if isinstance(stated, str) else f"{self.dataset}:{self.id}"
