"""Apart: pieces of different parts that meet though the bodies do not, cut until they do not."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from artgen.core.mesh import Floats
from artgen.core.transform import inverted
from artgen.ingest.meshes.carve import (
    LOSS,
    Carved,
    Tool,
    carved,
    content,
    local_tool,
    meets,
    near,
    swept,
)
from artgen.ingest.meshes.chunks import Chunk, halves
from artgen.ingest.meshes.crossing import Surfaces
from artgen.ingest.meshes.meeting import SAME, Place, Pose, meetings

ROUNDS = 8
"""Times that all pieces are looked at."""
SLACK = 0.02
"""Of its hull: a piece with less slack is not halved for another part's sake."""
STEPS = 24
"""Steps for two pieces at one pose, at most."""
DEAR = 20.0
"""Pieces that giving up all of a chunk is worth."""
PIECES = 12
"""Times as many pieces as cuts are allowed that a part may fall into."""


@dataclass(frozen=True, kw_only=True)
class Pair:
    """Two places whose chunks are to be set apart."""

    first: Place
    second: Place


def set_apart(
    found: Mapping[str, Sequence[Chunk]],
    walls: Mapping[str, float],
    surfaces: Surfaces,
    poses: Sequence[Pose],
    *,
    most: int,
) -> dict[str, list[Chunk]]:
    """Part name to chunks whose pieces do not meet those of other parts at any of the poses, as far
    as bodies do not pass through each other there."""
    bench = _Bench(walls, {name: max(0, PIECES * most - len(own)) for name, own in found.items()})
    chunks = {name: list(own) for name, own in found.items()}
    for _ in range(ROUNDS):
        met = meetings({n: [chunk.mesh for chunk in own] for n, own in chunks.items()}, poses)
        bench.now = {(n, k): [chunk] for n, own in chunks.items() for k, chunk in enumerate(own)}
        changed = [
            bench.settle(first, second, _free(surfaces, first[0], second[0], ways))
            for (first, second), ways in met.items()
        ]
        if not any(changed):
            break
        chunks = {
            name: [chunk for k in range(len(own)) for chunk in bench.now[name, k]]
            for name, own in chunks.items()
        }
    return chunks


class _Bench:
    """The chunks that pieces have fallen into, by place, and what is known to be in vain."""

    def __init__(self, walls: Mapping[str, float], left: dict[str, int]) -> None:
        self.walls, self.left = walls, left
        self.now: dict[Place, list[Chunk]] = {}
        self._vain: dict[tuple[int, int, bytes], tuple[Chunk, Chunk]] = {}
        """By the ids of two chunks, which live as long as they are named here, and their pose."""

    def settle(self, first: Place, second: Place, ways: Sequence[Floats]) -> bool:
        """Cut the pieces at two places so that they do not meet at any of the (4, 4) poses
        `first_from_second`; whether anything was cut."""
        pair = Pair(first=first, second=second)
        one, other = self.now[first], self.now[second]
        if len(ways) > 1 and len(one) == len(other) == 1:
            tools = swept(other[0], ways), swept(one[0], [inverted(way) for way in ways])
            if self._cut(pair, one[0], other[0], tools):
                return True
        return any([self._settle_at(pair, way) for way in ways])

    def _settle_at(self, pair: Pair, way: Floats) -> bool:
        """Cut until no chunks at two places meet at one pose; whether anything was cut."""
        waiting = [(x, y) for x in self.now[pair.first] for y in self.now[pair.second]]
        steps = 0
        while waiting and steps < STEPS:
            x, y = waiting.pop()
            if x not in self.now[pair.first] or y not in self.now[pair.second]:
                continue
            new = self._step(pair, x, y, way)
            steps += bool(new)
            if x not in self.now[pair.first]:
                waiting += [(piece, own) for piece in new for own in self.now[pair.second]]
            else:
                waiting += [(own, piece) for own in self.now[pair.first] for piece in new]
        return steps > 0

    def _step(self, pair: Pair, x: Chunk, y: Chunk, way: Floats) -> Sequence[Chunk]:
        """One step towards two chunks that do not meet at a pose: what one of them fell into."""
        key = id(x), id(y), way.tobytes()
        if key in self._vain or not near(x, y, way):
            return ()
        tool = swept(y, [way])
        if tool is None or not meets(x, tool):
            return ()
        new: Sequence[Chunk] = ()
        if not _crossing(x, y, way):
            back = inverted(way)
            new = (
                self._cut(pair, x, y, (tool, swept(x, [back])))
                or self._cut(pair, x, y, (local_tool(y, way, x), local_tool(x, back, y)))
                or self._halve(pair, x, y)
            )
        if not new:
            self._vain[key] = x, y
        return new

    def _cut(
        self, pair: Pair, x: Chunk, y: Chunk, tools: tuple[Tool | None, Tool | None]
    ) -> Sequence[Chunk]:
        """Cut x by the first tool or y by the second, whichever costs less."""
        options = []
        for place, chunk, tool in ((pair.first, x, tools[0]), (pair.second, y, tools[1])):
            if tool is None or not meets(chunk, tool):
                continue
            new = carved(chunk, tool, self.walls[place[0]])
            if new is not None and len(new.chunks) - 1 <= self.left[place[0]]:
                options.append((_cost(chunk, new), place, chunk, new.chunks))
        if not options:
            return ()
        _, place, chunk, chunks = min(options, key=lambda option: option[0])
        return self._replaced(place, chunk, chunks)

    def _halve(self, pair: Pair, x: Chunk, y: Chunk) -> Sequence[Chunk]:
        """Halve the chunk with more slack, if either has enough."""
        both = sorted([(pair.first, x), (pair.second, y)], key=lambda entry: -entry[1].slack)
        for place, chunk in both:
            if chunk.slack > SLACK * chunk.hull.volume() and self.left[place[0]] > 0:
                new = tuple(halves(chunk, self.walls[place[0]]))
                if len(new) > 1:
                    return self._replaced(place, chunk, new)
        return ()

    def _replaced(self, place: Place, old: Chunk, new: Sequence[Chunk]) -> Sequence[Chunk]:
        self.left[place[0]] -= len(new) - 1
        self.now[place] = [chunk for chunk in self.now[place] if chunk is not old] + list(new)
        return new


def _free(surfaces: Surfaces, first: str, second: str, ways: Sequence[Floats]) -> list[Floats]:
    """The poses at which two parts do not pass through each other, and rest."""
    return [
        way
        for way in ways
        if np.allclose(way, np.eye(4), rtol=0.0, atol=SAME)
        or not surfaces.cross(first, second, way)
    ]


def _cost(chunk: Chunk, new: Carved) -> float:
    """Pieces, and what is given up of the body."""
    return len(new.chunks) + DEAR * new.lost / max(content(chunk), 1e-300)


def _crossing(x: Chunk, y: Chunk, way: Floats) -> bool:
    """Whether two bodies pass through each other by more than a film; open ones do not say."""
    if x.solid is None or y.solid is None:
        return False
    shared = x.solid ^ y.solid.transform(way[:3])
    return 2.0 * shared.volume() > LOSS * max(shared.surface_area(), 1e-300)
