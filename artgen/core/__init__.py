"""Ground floor: arrays, frames, random streams, errors, JSON; numpy and the standard library
alone."""
