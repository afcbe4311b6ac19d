"""A console session: what it reaches or starts, and how both end. See `composition.py`."""
