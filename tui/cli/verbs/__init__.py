"""What follows `bot-console` on a command line, a file each; `doctor`, `lint` and `attach` have rooms of their own."""
