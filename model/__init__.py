"""The ART application: the only package that imports torch."""
