"""`python -m ros2cli`."""

import sys

from bot_console.runtime.programs.exit_messages import run_and_report
from ros2cli.command_line import main

sys.exit(run_and_report(main))
