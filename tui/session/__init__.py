"""Console sessions: what a console reaches or starts, and how both end. See `composition.py`."""
