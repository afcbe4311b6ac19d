"""The arguments and implementations of the verbs of `bot-console bag`."""
