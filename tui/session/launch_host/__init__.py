"""The launcher in a separate process, and its proxy in the console.

`host.LaunchHost` serves a launcher to any number of consoles; `proxy.HostedLauncher` is the `Launcher` of each of them.
They exchange plain data, one JSON object per line (`channel`, `plain_data`), over a Unix socket.
"""
