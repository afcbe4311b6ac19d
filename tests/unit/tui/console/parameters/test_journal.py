"""The journal numbers changes, and undo and redo mirror each other."""

from bot_console.tui.console.model import ChangeSource
from bot_console.tui.console.parameters.journal import Journal, Move, Step


def test_entries_are_numbered_and_bounded() -> None:
    journal = Journal(2)
    for number in range(3):
        journal.record(number, "/n", "p", (number, number + 1), ChangeSource.OTHER, "no" if number == 2 else "")
    assert [each.seq for each in journal.after(0)] == [1, 2]
    assert [each.accepted for each in journal.after(1)] == [True, False]
    assert (journal.state.first, journal.state.end) == (1, 3)


def test_undo_and_redo_mirror_each_other() -> None:
    journal = Journal()
    step = Step((Move("/n", {"p": 1}, {"p": 2}),))
    journal.did(step, ChangeSource.EDIT)
    assert journal.state.undoes
    assert journal.take_undo() is step
    journal.did(step, ChangeSource.UNDO)
    assert (bool(journal.state.undoes), bool(journal.state.redoes)) == (False, True)
    assert journal.take_redo() is step
    journal.did(step, ChangeSource.REDO)
    assert (bool(journal.state.undoes), bool(journal.state.redoes)) == (True, False)
    assert journal.take_redo() is None


def test_a_new_edit_discards_redoable_steps() -> None:
    journal = Journal()
    journal.did(Step((Move("/n", {"p": 1}, {"p": 2}),)), ChangeSource.EDIT)
    undone = journal.take_undo()
    assert undone is not None
    journal.did(undone, ChangeSource.UNDO)
    journal.did(Step((Move("/n", {"q": 1}, {"q": 2}),)), ChangeSource.EDIT)
    assert not journal.state.redoes


def test_a_refused_undo_is_put_back() -> None:
    journal = Journal()
    journal.did(Step((Move("/n", {"p": 1}, {"p": 2}),)), ChangeSource.EDIT)
    step = journal.take_undo()
    assert step is not None
    journal.put_back(step, ChangeSource.UNDO)
    assert journal.state.undoes


def test_a_value_restored_by_a_restart_is_neither_undoable_nor_unsaved() -> None:
    journal = Journal()
    journal.did(Step((Move("/n", {"p": 1}, {"p": 2}),)), ChangeSource.EDIT)
    both = (Move("/n", {"p": 2, "q": 1}, {"p": 3, "q": 2}), Move("/other", {"p": 1}, {"p": 2}))
    journal.did(Step(both), ChangeSource.EDIT)
    journal.restarted("/n", "p")
    assert journal.state.unsaved == (("/n", "q"), ("/other", "p"))
    step = journal.take_undo()
    assert step is not None
    assert step.moves == (Move("/n", {"q": 1}, {"q": 2}), both[1])
    assert journal.take_undo() is None and not journal.state.undoes
