"""A console session: what runs alongside the app."""
