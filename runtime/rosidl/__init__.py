"""Message, service and action classes: generated at build time for the standard packages, at run time for a user's."""
