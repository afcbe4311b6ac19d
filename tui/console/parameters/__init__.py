"""Parameters of all nodes: what they are, how they are set, saved and put back."""
