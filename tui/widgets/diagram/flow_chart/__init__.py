"""A flow chart drawn as text: boxes arranged as stairs, and one labelled line for each pair of linked boxes."""
