"""Cases: an assembled object beside all that it was made from, for what must hold of it."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from artgen.articulation.types import Joint
from artgen.assembly.assemble import Assembled
from artgen.assembly.library import Library
from artgen.assembly.piece import Piece
from artgen.assembly.source import Member, Source
from artgen.core.mesh import Floats


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """An object beside its template and the sources of its parts, by id.

    Attributes:
        body_splits, handle_splits: shape to the one split that offers it.
    """

    new: Assembled
    template: Source
    sources: Mapping[str, Source]
    body_splits: Mapping[str, str]
    handle_splits: Mapping[str, str]

    @property
    def shift(self) -> Floats:
        """(3,) from the template's frame to the object's: the base is the same in both."""
        base = self.new.parts[0][2]
        return np.asarray(base.bounds[0] - self.template.base.bounds[0])

    @property
    def diagonal(self) -> float:
        """Of the object at rest, m."""
        boxes = np.array([piece.bounds for _, _, piece in self.new.parts])
        return float(np.linalg.norm(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0)))

    @property
    def filled(self) -> Iterator[tuple[Member, Joint, Piece]]:
        """Each filled part: the template's, its joint in the object, its fitted body."""
        joints = {joint.child: joint for joint in self.new.joints}
        for member in self.template.members:
            if member.name in self.new.seams:
                body = self.new.layer(member.name, "body")
                if body is not None:
                    yield member, joints[member.name], body

    @property
    def pieces(self) -> Iterator[tuple[str, str]]:
        """What has a source: name of a part and which of its pieces, told by its bodies."""
        kinds = {member.name: member.kind for member in self.template.members}
        for name, label, _ in self.new.parts:
            if name not in self.new.seams:
                yield name, "base" if label == "base" else "part"
                continue
            layers = (kinds[name], "handle", "works")
            for piece, count in zip(layers, self.new.seams[name], strict=True):
                if count:
                    yield name, piece


def case_of(new: Assembled, library: Library) -> Case:
    """An object with the sources that it names."""
    ids = {str(entry["source"]) for entry in new.sources} | {new.template}
    return Case(
        new=new,
        template=library.source(new.template),
        sources={id: library.source(id) for id in ids},
        body_splits=library.body_splits,
        handle_splits=library.handle_splits,
    )
