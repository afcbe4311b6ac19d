"""The console's launcher: processes, over the public launch API."""
