"""The launcher in a process of its own, and its stand-in in the console.

`host.LaunchHost` serves a launcher to any number of consoles; `proxy.HostedLauncher` is the `Launcher` of each of them.
What goes between them is plain data, one JSON object a line (`channel`, `plain`), over a Unix socket.
"""
