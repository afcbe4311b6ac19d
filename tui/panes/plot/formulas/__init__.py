"""Curves worked out of others: expressions, what they can do, and what is suggested while one is typed."""
