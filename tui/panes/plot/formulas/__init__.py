"""Curves computed from others: expressions, their functions, and suggestions while one is typed."""
