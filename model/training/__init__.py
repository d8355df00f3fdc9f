"""Recipes, schedule, losses, the loop, checkpoints and the file that ships."""
