"""`artgen study render`: what accuracy of images costs in time."""
