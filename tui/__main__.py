"""`python -m bot_console.tui`: the same as `bot-console`."""

import sys

from bot_console.tui.cli import main

sys.exit(main())
