"""The entry point of the process `bot-console`."""

signal = __import__("_signal")  # `signal` imports other modules, which would take longer than all of this


def program() -> None:
    """Import the command line and run it; Ctrl-C during the imports ends the process silently, as it ends `cat`.

    A `KeyboardInterrupt` would be printed or lost, depending on the module being imported at that moment.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # otherwise it is ignored, as for background jobs
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from bot_console.tui.cli.main import program as run

    run()
