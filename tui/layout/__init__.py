"""How panes share the screen: a tree of splits, what it comes to in cells, and the layouts that have names."""
