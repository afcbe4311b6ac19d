"""Tuning: searches for the parameter values with which simulator runs score best.

Pure, except for the journal's file.
"""
