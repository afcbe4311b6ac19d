"""Other pictures of a plot: a line per curve, one curve against another, and files."""
