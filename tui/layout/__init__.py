"""How panes share the screen: a tree of splits, its size in cells, and named layouts."""
