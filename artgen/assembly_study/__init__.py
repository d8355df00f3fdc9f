"""What `artgen assemble` makes: how many distinct objects, how evenly from donors, how textured."""
