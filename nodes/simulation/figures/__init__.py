"""The figures reported about a run."""
