"""`python -m ros2cli`."""

import sys

from bot_console.runtime.terse import told
from ros2cli.command_line import main

sys.exit(told(main))
