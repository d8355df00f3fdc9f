"""Image sets for surfaces, synthesised in numpy."""
