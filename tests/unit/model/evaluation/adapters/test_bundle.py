"""A bundle that was written is the layout of its object."""

from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import ExportError
from model.evaluation.adapters.bundle import layout_of_bundle
from model.evaluation.adapters.formats import places
from tests.made import finished
from tests.unit.validate.cabinet import write_quick_bundle


def test_parts_and_joints_are_those_of_the_object(tmp_path: Path) -> None:
    made = finished("laptop", 0)
    write_quick_bundle(made, tmp_path / "laptop" / "000000")
    layout = layout_of_bundle(tmp_path / "laptop" / "000000")
    assert layout.name == made.asset_id
    assert layout.category == "laptop"
    assert layout.labels == tuple(part.label for part in made.parts)
    for k, part in enumerate(made.parts):
        assert np.array_equal(layout.boxes[k], part.mesh.bounds)
        mesh = layout.meshes[k]
        assert mesh is not None
        assert len(mesh.faces) == len(part.mesh.faces)
        joint = made.joint_of(part.name)
        if joint is not None and joint.limit is not None:
            assert layout.axes[k].tolist() == list(joint.axis)
            assert layout.limits[k].tolist() == [joint.limit.lower, joint.limit.upper]
    # Its folder is called 000000; its name is its asset id.
    assert list(places(tmp_path)) == [made.asset_id]


def test_another_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(ExportError, match="is .* an asset"):
        layout_of_bundle(tmp_path)
