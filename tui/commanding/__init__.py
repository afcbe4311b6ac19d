"""What a person asks for in words: the command line, its own verbs, the palette."""
