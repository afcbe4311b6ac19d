"""A flow chart drawn as text: boxes as stairs, and one line with words on it for each pair of boxes."""
