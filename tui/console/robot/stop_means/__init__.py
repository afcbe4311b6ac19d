"""The configured means of stopping a robot that lacks the emergency stop of `docs/safety.md`."""
