"""The commands of `bot-console`, one file each; `doctor`, `lint` and `attach` have folders of their own."""
