"""`artgen study simulate`: what accuracy of simulation costs in time."""
