"""Scores of reconstructions, of ours and of any other system, from the layouts they claim."""
