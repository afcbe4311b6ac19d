"""Log records of all nodes: kept, searched, told apart."""
