"""A directed graph drawn as text: boxes, chips and orthogonal arrows, laid out in columns from left to right."""
