"""Tuning: the values of parameters for which runs of the simulator score best. Pure, but for the journal's file."""
