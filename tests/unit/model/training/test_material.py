"""What a model card says of the objects that were learned from."""

from pathlib import Path

import pytest

from artgen.core.errors import ModelError
from model.data.library import library_made, packed, read_library, write_library
from model.data.make import Request
from model.training.material import Material, stated_origin
from tests.unit.model.data.small import soup


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
