"""ArticulatedObject to files: GLB, OBJ, URDF, MJCF, USD, bundle; and back to kinematics."""
