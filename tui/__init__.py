"""The console: rqt for the terminal."""
