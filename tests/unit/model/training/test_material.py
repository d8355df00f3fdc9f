"""What is learned from: shares of what is mixed, and what a model card says of it."""

from pathlib import Path
from typing import Any

import pytest

from artgen.core.errors import ModelError, UsageError
from artgen.dataset.members import encoded
from artgen.dataset.shard import write_shard
from model.data.library import library_made, packed, read_library, write_library
from model.data.loader import batches
from model.data.make import Request
from model.data.mixed import BLOCK
from model.training.material import Material, opened, stated_origin
from tests.unit.dataset.scenes import made_sample
from tests.unit.model.data.small import CONFIG, soup


@pytest.fixture
def both(tmp_path: Path) -> tuple[Path, Path]:
    """A library of three cabinets, and a folder with a shard of one laptop."""
    library, shards = tmp_path / "library.npz", tmp_path / "shards"
    write_library(library, packed([soup("cabinet", k) for k in range(3)]))
    sample = made_sample("laptop_000000", states=2, views=3, parts=2, height=12, width=15)
    write_shard(shards / "train-000000.tar", [encoded(sample)])
    return library, shards


@pytest.mark.parametrize("scenes", [None, 1, 5])
@pytest.mark.parametrize(("share", "count"), [(None, 25), (0.1, 10), (0.01, 1), (0.99, 99)])
def test_shards_come_in_the_share_that_is_asked_for(
    both: tuple[Path, Path], tmp_path: Path, scenes: int | None, share: float | None, count: int
) -> None:
    """`artgen train` had no option for it, and scenes that are kept forgot all shares."""
    library, shards = both
    material = Material(
        library=library, shards=(shards,), split=None, scenes=scenes, shard_share=share
    )
    source = opened(material, tmp_path, CONFIG)
    assert len(source) == 4 * (scenes or 1)
    row = source.order(3)
    places = [row.at(place) for place in range(BLOCK)]
    assert sum(place < (scenes or 1) for place in places) == count


def test_kept_scenes_of_both_come_as_batches(both: tuple[Path, Path], tmp_path: Path) -> None:
    library, shards = both
    material = Material(library=library, shards=(shards,), split=None, scenes=2, shard_share=0.5)
    supply = batches(opened(material, tmp_path, CONFIG), CONFIG)
    shown = {name for _ in range(4) for name in next(supply).asset_ids}
    assert shown == {"laptop_000000", *(f"cabinet_{k:06d}" for k in range(3))}


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"library": Path("a.npz")}, "name both"),
        ({"shards": (Path("a"),)}, "name both"),
        ({"library": Path("a.npz"), "shards": (Path("a"),), "shard_share": 1.0}, "0.01 to 0.99"),
        ({"library": Path("a.npz"), "shards": (Path("a"),), "shard_share": 0.001}, "0.01 to 0.99"),
    ],
)
def test_impossible_shares_are_told(settings: dict[str, Any], said: str) -> None:
    with pytest.raises(UsageError, match=f"--shard-share .*{said}"):
        Material(**{"shard_share": 0.2, **settings})


def test_a_card_states_what_the_library_was_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "library.npz"
    made = {"counts": {"laptop": 1}, "seed": 23}
    library = packed([soup("laptop")])
    write_library(path, type(library)(**{**vars(library), "made": made}))
    assert stated_origin(Material(library=path), 0) == made == read_library(path).made


def test_without_a_library_it_is_the_request() -> None:
    material = Material(categories=("laptop",), objects=3)
    request: Request = material.request(7)
    assert stated_origin(material, 7) == request.made
    assert stated_origin(Material(shards=(Path("shards"),)), 7) == {}


def test_what_is_no_library_has_no_origin(tmp_path: Path) -> None:
    path = tmp_path / "library.npz"
    path.write_bytes(b"PK")
    with pytest.raises(ModelError, match="is no library"):
        library_made(path)
