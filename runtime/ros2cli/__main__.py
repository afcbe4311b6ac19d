"""`python -m ros2cli`."""

import sys

from ros2cli.command_line import main

sys.exit(main())
