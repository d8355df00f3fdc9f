"""A small library of our own furniture, edges sharp, built once a session; and objects from it."""

from collections.abc import Callable
from dataclasses import replace

import pytest

from artgen.assembly.assemble import Assembled
from artgen.assembly.build import sharp
from artgen.assembly.case import Case, case_of
from artgen.assembly.choice import Market
from artgen.assembly.harvest import embedded, made_source
from artgen.assembly.library import Library, write_library
from artgen.assembly.run import TEMPLATES, new_object
from artgen.export import write_bundle
from artgen.textures.library import TextureLibrary
from tests.made import finished

COUNTS = {"storage_furniture": 9, "cabinet": 9}
TRIES = 24


@pytest.fixture(scope="session")
def made_sources():
    return [made_source(made, sharp) for made in embedded(COUNTS)]


@pytest.fixture(scope="session")
def library(tmp_path_factory, made_sources):
    """All of one family of splits, so that few sources suffice."""
    folder = tmp_path_factory.mktemp("library")
    write_library(folder, [replace(s, family="cabinet_6_000000") for s in made_sources], recipe={})
    return Library(folder)


@pytest.fixture(scope="session")
def market(library):
    return Market(library, TEMPLATES["storage_furniture"])


@pytest.fixture(scope="session")
def cases(market):
    """Objects 0, 1, 2 ... that were assembled."""
    found = [new_object(market, "storage_furniture", 1, index) for index in range(TRIES)]
    return [case_of(new, market.library) for new in found if isinstance(new, Assembled)]


@pytest.fixture(scope="session")
def case_with(cases) -> Callable[[Callable[[Case], bool]], Case]:
    """The first case of which something is true."""
    return lambda wanted: next(case for case in cases if wanted(case))


@pytest.fixture(scope="session")
def bundle(tmp_path_factory, blender):
    """One of our cabinets, written with its GLB."""
    folder = tmp_path_factory.mktemp("bundle")
    library = TextureLibrary(tmp_path_factory.mktemp("textures"))
    write_bundle(finished("cabinet", 0), folder, library=library, worker=blender, thumbnail=b"none")
    return folder
