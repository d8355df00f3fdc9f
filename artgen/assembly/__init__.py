"""New objects from old ones: templates whose fronts and handles come from donors."""
