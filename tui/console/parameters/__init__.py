"""The parameters of all nodes: reads, sets, saves and restores them."""
