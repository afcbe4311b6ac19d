"""Files that the console writes, and where they are kept."""
