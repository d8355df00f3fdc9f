"""Foreign objects in: PartNet-Mobility folders, URDF files and static meshes become bundles."""
