"""Message, service and action classes: generated at build time for standard packages, at run time for users'."""
