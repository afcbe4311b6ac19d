"""The launcher in a process of its own, and its proxy in the console.

`host.LaunchHost` serves a launcher to any number of consoles; `proxy.HostedLauncher` is the `Launcher` of each of them.
What
they exchange is plain data, one JSON object per line (`channel`, `plain`), over a Unix socket.
"""
