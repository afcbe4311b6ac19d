"""What a robot shows of itself: its diagnostics and its cameras."""
