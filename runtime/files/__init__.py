"""Files that the runtime reads, from the user and from servers, and its log files."""
