"""A run of the console: what stands beside the app while it runs."""
