import pytest

from artgen.core.errors import ModelError
from model.data.config import DataConfig


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"batch": 0}, "at least 1"),
        ({"rays": -1}, "at least 0"),
        ({"rays": 100, "patch_px": 16}, "whole patches of 256"),
        ({"target_px": 8, "patch_px": 16, "rays": 256}, "must fit into images of 8 px"),
        ({"targets_from": "inputs", "views": 1, "target_views": 2}, "2 target views of 1 inputs"),
        ({"fov_deg": (0.0, 40.0)}, "fov_deg 0.0..40.0"),
        ({"elevation_deg": (50.0, 40.0)}, "must ascend"),
        ({"pose_noise": -0.1}, "pose_noise -0.1 must be at least 0"),
        ({"fill": 0.0}, r"fill 0.0 in \(0, 1\]"),
        ({"mask_share": 1.5}, r"mask_share 1.5 must lie in \[0, 1\]"),
    ],
)
def test_settings_that_cannot_be_are_refused(changes, message):
    with pytest.raises(ModelError, match=message):
        DataConfig(**changes)
