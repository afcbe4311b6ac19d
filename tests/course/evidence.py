"""The tests that show rows about the console's screens: most of chapter 4 by keyboard, with the page's own nodes.

The check of the row verifies that the test exists and runs for each change; `count_rows.py`, at the end of the checks,
verifies that it ran and passed.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LATER = re.compile(r"mark\.soak\b")
"""The mark of tests that do not count for rows, since they do not run for each change."""
CHAPTER, PARAMETERS = "tests/pilot/stories/test_chapter_4.py", "tests/pilot/panes/test_parameters_pane.py"
LOGS, PLOT = "tests/pilot/panes/test_logs_pane.py", "tests/pilot/panes/test_plot_pane.py"
TUNED = f"{CHAPTER}::test_step_1_the_speed_is_tuned_while_the_robot_runs"
TYPES = f"{CHAPTER}::test_types_and_limits_are_shown"
FIELDS = f"{CHAPTER}::test_step_1_a_text_field_and_a_checkbox"
SINE = f"{CHAPTER}::test_step_2_a_sine_wave_is_plotted"
WAITS = f"{CHAPTER}::test_rqt_plot_lines_of_the_page_wait_for_unpublished_topics"
ARROWS = f"{CHAPTER}::test_step_3_nodes_topics_and_arrows"
ERRORS = f"{CHAPTER}::test_step_4_an_error_is_found_among_warnings"
DASHBOARD = f"{CHAPTER}::test_step_5_a_dashboard_is_built_saved_and_loaded"
WORKFLOW = f"{CHAPTER}::test_workflow_shows_all_panes_side_by_side"
STEERED = f"{CHAPTER}::test_the_robot_is_steered_by_key"
MENU = f"{CHAPTER}::test_each_plug_in_of_the_menu_is_a_pane_and_messages_are_published"
OWN_PLUGIN = f"{CHAPTER}::test_own_plug_in_starts_and_stops_the_robot"
SLIDER = f"{PARAMETERS}::test_wide_row_shows_slider_and_description"
OPENING, SECOND_TERMINAL = "tests/pilot/screen/test_opening.py", "tests/acceptance/console/test_second_terminal.py"

_SHOWN: tuple[tuple[str, Iterable[int]], ...] = (
    (TUNED, (134, 135, 136, *range(140, 144), 192, 193, 195, 283, 284, 325, 348, 388)),
    (FIELDS, (138, 139)),
    (SLIDER, (137,)),  # As printed, the robot declares no range (N15).
    (SINE, (146, 147, 148, 149, 151, 152, 153, 328)),
    (f"{PLOT}::test_the_window_grows_and_shrinks_and_limits_can_be_given", (150,)),
    (ARROWS, (*range(154, 164), 200, 201, 327, 378)),
    (ERRORS, (*range(164, 171), *range(172, 176), *range(202, 206), 326)),
    (DASHBOARD, (*range(176, 185), 211, 217)),
    (WORKFLOW, (*range(186, 192), 197)),
    (TYPES, (194,)),
    (f"{PARAMETERS}::test_the_command_is_shown_and_copied_and_values_are_saved", (196,)),
    (WAITS, (198, 199)),
    (f"{LOGS}::test_rules_hide_and_highlight_lines", (206,)),
    (f"{LOGS}::test_next_error_is_shown_in_full_copied_and_saved", (207,)),
    (STEERED, (208, 209, 210)),
    (MENU, range(212, 217)),
    (OWN_PLUGIN, (*range(218, 222), 353, 390)),
    ("tests/unit/nodes/test_presets.py::test_modes_of_the_course_robot_are_presets", (350,)),
    ("tests/pilot/panes/test_history_pane.py::test_changes_are_listed_newest_first_with_source_and_reason", (352,)),
    (f"{SECOND_TERMINAL}::test_verbs_in_a_second_terminal_reach_the_robot", (386,)),
    (f"{SECOND_TERMINAL}::test_second_console_asks_to_attach_and_leaves_the_robot_running", (387,)),
    (
        "tests/pilot/screen/test_opening.py::test_rqt_plot_line_replaces_curves_and_waits_for_missing_topics",
        (389,),
    ),
)
SHOWN: dict[int, str] = {number: test for test, numbers in _SHOWN for number in numbers}
"""The ids of tests, as pytest writes them, by row number."""


def has_test(test: str) -> bool:
    """Whether a file contains the test of that id, neither left to the soak run nor always skipped."""
    path, _, name = test.partition("::")
    return name in _tests(ROOT / path)


@lru_cache
def _tests(path: Path) -> frozenset[str]:
    body = ast.parse(path.read_text("utf-8")).body
    marks = [
        each.value for each in body if isinstance(each, ast.Assign) and ast.unparse(each.targets[0]) == "pytestmark"
    ]
    if any(map(_is_later, marks)):
        return frozenset()
    functions = [each for each in body if isinstance(each, ast.FunctionDef)]
    return frozenset(each.name for each in functions if not any(map(_is_left_out, each.decorator_list)))


def _is_left_out(decorator: ast.expr) -> bool:
    return "skip" in ast.unparse(decorator) or _is_later(decorator)


def _is_later(mark: ast.expr) -> bool:
    """Whether a mark leaves a whole test to the soak run; a mark on one parameter does not affect the others."""
    text = ast.unparse(mark)
    return "parametrize" not in text and LATER.search(text) is not None
