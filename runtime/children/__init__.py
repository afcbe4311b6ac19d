"""The processes that a program starts: their environment, and the fork server that starts them quickly."""
