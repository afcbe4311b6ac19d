"""Message packages found while a program runs: in folders, among the bundled ones, or sent by a node."""
