"""Questions to the user, each with a callback for its answer."""
