"""What a session takes from the runtime: its domain, workspace, processes and log files."""
