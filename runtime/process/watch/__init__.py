"""What watches over threads: one that computes without end, one that hangs, and what the system tells of them."""
