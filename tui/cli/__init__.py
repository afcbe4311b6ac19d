"""The command `bot-console`: the one place that knows the console and the runtime."""
