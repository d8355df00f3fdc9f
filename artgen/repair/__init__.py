"""Mended copies of foreign URDF assets, with a list of every change."""
