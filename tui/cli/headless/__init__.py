"""Runs the system without a screen."""
