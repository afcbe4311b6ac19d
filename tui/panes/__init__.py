"""The panes: each shows one part of a `ConsoleSnapshot`."""
