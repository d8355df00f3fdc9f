"""Axes, units and constants of the whole house; the only place for them.

Meters, radians, kilograms. Right-handed object frame: z up, the object's front faces -y, the object
stands on z = 0 and is centered in x and y. Seen from the front, left is -x. Cameras use OpenCV axes
(x right, y down, z forward) and pixel centers at +0.5.
"""

import numpy as np

GRAVITY = 9.81
"""m/s2, along -z."""

ART_SLOTS = 8
"""Parts that one ART sample can hold, base included (ART, supplement, P_0)."""

VERTEX_DECIMALS = 7
"""Finished vertices are rounded to 1e-7 m, so that every text format prints them exactly and short.
"""
UV_DECIMALS = 6
ATLAS_DECIMALS = 5
"""A hundredth of a texel at 1024 px."""
NORMAL_DECIMALS = 3
"""0.03 degrees."""

Y_UP_FROM_Z_UP = np.array(
    [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, -1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]]
)
"""Our front -y becomes glTF's front +z; our up z becomes y."""
Y_UP_FROM_Z_UP.setflags(write=False)
