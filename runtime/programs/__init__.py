"""A program that runs nodes: how it is started, hints about common mistakes, and how it ends."""
