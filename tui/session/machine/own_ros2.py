"""Runs our `ros2` on the machine's `rclpy`: `python -m` this module `topic list`."""

from __future__ import annotations

import sys

from bot_console.tui.session.machine.console_needs import provide_missing, provide_prefixes


def main() -> int:
    """Run the command line of this process."""
    provide_missing()
    from ros2cli.command_line import main as run

    return run(sys.argv[1:], provide_prefixes())


if __name__ == "__main__":
    sys.exit(main())
