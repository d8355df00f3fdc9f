"""PartNet-Mobility's layout: the values of its files, the rule of its URDF, and writing them."""
