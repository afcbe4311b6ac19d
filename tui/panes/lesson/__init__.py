"""The lesson pane: the step of a course that is being worked through."""
