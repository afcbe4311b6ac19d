"""What the launch pane collects about each process: CPU over time, warnings and errors, and the newest lines."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.console.model import LogRecord, LogState, ProcessInfo, ProcessState, Severity
from bot_console.tui.panes.launch.follow import CPU_SAMPLE_S, CPU_SAMPLES, MAX_LINES, MAX_RECORDS, Follower
from bot_console.tui.text.bars import strip

ZOO = ProcessInfo("1", "zoo.py-1", ProcessState.RUNNING, nodes=("/arm/left/zoo",), cpu=0.5)
EAR = ProcessInfo("2", "ear", ProcessState.RUNNING, nodes=("/arm",))


def follower_with(*lines: tuple[str, Severity]) -> Follower:
    follower = Follower()
    follower.update_processes((ZOO, EAR))
    read(follower, *lines)
    return follower


def read(follower: Follower, *lines: tuple[str, Severity]) -> None:
    records = [LogRecord(at, 0, severity, name, f"line {at}") for at, (name, severity) in enumerate(lines)]
    while follower.read(LogState(0, len(records)), records.__getitem__):
        pass


def test_equal_lines_one_after_another_are_one_with_their_count() -> None:
    follower = Follower()
    follower.update_processes((ZOO, EAR))
    texts = ("SAFE", "SAFE", "SAFE", "Turning", "SAFE")
    records = [LogRecord(at, at, Severity.INFO, "arm.left.zoo", text) for at, text in enumerate(texts)]
    follower.read(LogState(0, len(records)), records.__getitem__)
    found = [(each.record.text, each.record.stamp, each.count) for each in follower.of("1").lines]
    assert found == [("SAFE", 2, 3), ("Turning", 3, 1), ("SAFE", 4, 1)]


def test_lines_belong_to_the_process_of_their_logger_or_output() -> None:
    found = follower_with(
        ("arm.left.zoo", Severity.WARN), ("zoo.py-1", Severity.ERROR), ("arm.left.zoo.eyes", Severity.FATAL)
    )
    zoo, ear = found.of("1"), found.of("2")
    assert (zoo.warnings, zoo.errors, len(zoo.lines)) == (1, 2, 3)
    assert (ear.warnings, ear.errors, len(ear.lines)) == (0, 0, 0)
    assert found.key_of("arm.right") == "2" and found.key_of("army") == "" == found.key_of("rviz")


def test_errors_after_a_requested_end_are_not_counted_until_the_process_runs_again() -> None:
    follower = Follower()
    follower.update_processes((replace(ZOO, started=10, end_requested=20), EAR))
    stamped = [(15, "crash"), (20, "KeyboardInterrupt"), (21, "process has died"), (35, "again")]
    records = [LogRecord(at, stamp, Severity.ERROR, "zoo.py-1", text) for at, (stamp, text) in enumerate(stamped)]
    follower.read(LogState(0, 3), records.__getitem__)
    assert (follower.of("1").errors, len(follower.of("1").lines)) == (1, 3)
    follower.update_processes((replace(ZOO, started=30, end_requested=20), EAR))
    follower.read(LogState(0, 4), records.__getitem__)
    assert follower.of("1").errors == 2


def test_flood_is_read_in_pieces_and_only_the_newest_lines_are_kept() -> None:
    follower = Follower()
    follower.update_processes((ZOO, EAR))
    records = [LogRecord(at, 0, Severity.WARN, "arm", f"{at}") for at in range(3 * MAX_RECORDS)]
    state = LogState(0, len(records))
    assert follower.read(state, records.__getitem__)
    assert follower.of("2").warnings == MAX_RECORDS
    while follower.read(state, records.__getitem__):
        pass
    assert follower.of("2").warnings == len(records) and len(follower.of("2").lines) == MAX_LINES


def test_dropped_records_and_another_log_are_handled() -> None:
    follower = follower_with(("arm", Severity.WARN), ("arm", Severity.WARN))
    assert not follower.read(LogState(0, 1), lambda _: None)
    assert follower.read(LogState(5, 6), lambda at: LogRecord(at, 0, Severity.ERROR, "arm", ""))
    assert (follower.of("2").warnings, follower.of("2").errors) == (2, 1)


def test_cpu_usage_is_sampled_at_a_rate_and_drawn_as_bars() -> None:
    follower = follower_with()
    assert follower.sample((ZOO, EAR), 10.0) and not follower.sample((ZOO, EAR), 10.0 + CPU_SAMPLE_S / 2)
    for at in range(20):
        follower.sample((ZOO, EAR), 20.0 + at * CPU_SAMPLE_S)
    assert strip(follower.of("1").cpu, 1.0) == "▅" * CPU_SAMPLES
    assert strip(follower.of("2").cpu, 1.0) == "▁" * CPU_SAMPLES
    assert strip([-1.0, 5.0], 1.0) == "▁█" and strip([1.0], 0.0) == "▁"


def test_process_that_is_gone_is_forgotten_and_one_that_stays_is_not() -> None:
    follower = follower_with(("arm", Severity.WARN), ("zoo.py-1", Severity.WARN))
    follower.update_processes((EAR,))
    assert follower.of("2").warnings == 1 and follower.of("1").warnings == 0
