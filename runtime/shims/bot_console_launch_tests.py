"""The plug-ins of `launch_testing` and `launch_pytest`, which pytest finds in a shell or environment that was set up.

They are imported when a test file that names one of these packages is collected: other tests are none of our business.
"""

import pytest

PLUGINS = {"launch_testing": "launch_testing.pytest.plugin", "launch_pytest": "launch_pytest.plugin"}


def pytest_addoption(parser):
    """Add the option of launch tests."""
    parser.addoption("--launch-args", action="append", nargs="*", default=[], help="One or more Launch test arguments")


def _add_plugins(file_path, parent):
    """Add the plug-ins that a file needs, before it is collected."""
    if file_path.suffix != ".py":
        return
    text = file_path.read_text(encoding="utf-8", errors="replace")
    manager = parent.config.pluginmanager
    missing = [plugin for name, plugin in PLUGINS.items() if name in text and not manager.hasplugin(plugin)]
    if missing and _is_embedded():
        for each in missing:
            manager.import_plugin(each)


def _is_embedded():
    try:
        __import__("bot_console_shims").choose_embedded(__name__)
    except ImportError:  # a real ROS 2, which brings its own, or another Python: importing the test file says so
        return False
    return True


if hasattr(pytest, "version_tuple"):  # pytest 7 or newer: the arguments of the hook had other names before
    pytest_collect_file = pytest.hookimpl(tryfirst=True)(_add_plugins)
