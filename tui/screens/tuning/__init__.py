"""The screen of a tuning in progress, and how it is opened."""
