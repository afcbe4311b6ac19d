"""Commands that a person types: the command line, its own verbs, the palette."""
