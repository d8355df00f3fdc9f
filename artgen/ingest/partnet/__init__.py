"""PartNet-Mobility folders: their files as values, checked, and as a ForeignObject."""
