"""One object fitted to its own images: the baseline that learns from no other."""
