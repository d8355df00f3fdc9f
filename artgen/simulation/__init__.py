"""Simulating only the effects that a scene calls for, and what accuracy costs in time."""
