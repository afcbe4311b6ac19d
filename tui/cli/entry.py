"""The entry point of the process `bot-console`."""

signal = __import__("_signal")  # `signal` imports other modules, which takes longer than all that is done here


def program() -> None:
    """Import the command line and run it; a Ctrl-C during the imports ends the process as it ends `cat`, silently.

    A `KeyboardInterrupt` would be printed, or lost, by whatever is being imported at that moment.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # otherwise ignored, as in the background
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from bot_console.tui.cli.main import program as run

    run()
