"""Benchmarks: figures for the docs, measured on the machine at hand; never part of the tests."""
