"""One program that runs nodes: how it is run, hints about common mistakes, and how it ends."""
