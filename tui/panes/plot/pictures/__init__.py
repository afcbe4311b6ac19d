"""Pictures of a plot beside the framed one: a line for each curve, one curve against another, and files."""
