"""Command lines that go on below the panes."""
