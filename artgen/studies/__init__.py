"""Studies: what accuracy costs in time, measured, as a table, a plot and a page."""
