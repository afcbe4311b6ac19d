"""The verbs of `bot-console bag`: their arguments, and what they do."""
