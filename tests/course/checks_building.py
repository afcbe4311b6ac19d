"""Building the workspace where the page says `colcon build`: changes of a source take effect at once."""

from __future__ import annotations

from course.page import Page, logs, make_workspace
from course.rows import Row
from course.table import row


@row(83, 260, 270, 363, 369)
def check_changed_source_takes_effect(page: Page, row: Row) -> None:
    """A missing package is reported as colcon reports it."""
    workspace = make_workspace(page.scratch)
    page.work_on(workspace)
    words = row.command.rpartition("&& ")[2].split()
    assert words[:2] == ["colcon", "build"]
    assert set(words[3:]) <= set(page.ask("ros2 pkg list").stdout.split())
    source = workspace / "src" / "my_package" / "my_package" / "simple_robot_step1.py"
    printed = source.read_text("utf-8")
    assert "('speed', 1.0)" in printed
    for speed in ("1.0", "1.75"):
        source.write_text(printed.replace("('speed', 1.0)", f"('speed', {speed})"), "utf-8")
        built = page.bot_console(*words)
        assert (built.exit, built.stderr, built.stdout.startswith("Nothing has to be built")) == (0, "", True)
        robot = page.start("ros2 run my_package simple_robot_step1")
        assert ("INFO", "simple_robot", f"Robot initialized with speed: {speed} m/s") in logs(robot)
        page.stop(robot)
    refused = page.bot_console("colcon", "build", "--packages-select", "my_pakage")
    assert refused.stderr == "ignoring unknown package 'my_pakage' in --packages-select\n"
