"""Files of the user and of servers that the runtime reads, and its log files."""
