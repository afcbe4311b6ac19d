"""The launcher in a separate process, and its proxy in the console.

`host.LaunchHost` serves a launcher to any number of consoles, each of which uses it through a `proxy.HostedLauncher`.
They exchange plain data, one JSON object per line (`channel`, `plain_data`), over a Unix socket.
"""
