"""Playing bags: which topics are published, and when."""
