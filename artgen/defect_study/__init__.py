"""`artgen study defects`: which planted defects are caught, by us and by other checkers."""
