"""What the exporters really write passes, GLB by Blender and USD included."""

from pathlib import Path

import pytest

from artgen.export import write_bundle
from artgen.textures.library import TextureLibrary
from artgen.validate import validate_bundle
from artgen.worker import BlenderWorker
from tests.unit.validate.cabinet import cupboard


@pytest.mark.blender
def test_a_bundle_of_all_exporters_has_no_finding(tmp_path: Path, blender: BlenderWorker) -> None:
    folder = tmp_path / "bundle"
    folder.mkdir()
    library = TextureLibrary(tmp_path / "textures")
    write_bundle(cupboard(), folder, library=library, worker=blender, thumbnail=b"png")
    assert [str(finding) for finding in validate_bundle(folder).findings] == []
