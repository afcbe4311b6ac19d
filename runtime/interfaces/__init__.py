"""Message packages that are found while a program runs: in folders, among the included, or received from a node."""
