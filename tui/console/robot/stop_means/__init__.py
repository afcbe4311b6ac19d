"""How a robot without the emergency stop of `docs/safety.md` is stopped: by its own means, if they are configured."""
