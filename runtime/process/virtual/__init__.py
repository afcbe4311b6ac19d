"""What each node process has for itself of what the interpreter has once: wraps of public calls."""
