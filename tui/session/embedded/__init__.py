"""What a session uses of the runtime: its domain, workspace, processes and log files."""
