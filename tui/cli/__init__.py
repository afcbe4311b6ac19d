"""The `bot-console` command: the only part that imports both the console and the runtime."""
