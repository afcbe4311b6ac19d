"""Log records of all nodes: stored, searched, classified."""
