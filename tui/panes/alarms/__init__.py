"""The alarms pane."""
