"""The ascending numbers of matching log records, either all of them or with each run of equal records as one entry."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

Block = npt.NDArray[np.int64]


def repeat_key(node: int, severity: int, raw: bytes) -> int:
    """A number that is equal for records of the same node, severity and text (UTF-8), and rarely for others."""
    return hash((node, severity, raw))


class Numbers:
    """Ascending numbers in several arrays, so that older and newer ones can be added without copying everything."""

    def __init__(self, parts: Sequence[Block] = ()) -> None:
        self._parts = tuple(each for each in parts if len(each))
        self._ends: list[int] = np.cumsum([len(each) for each in self._parts], dtype=np.int64).tolist()

    def __len__(self) -> int:
        """The number of entries."""
        return self._ends[-1] if self._ends else 0

    def __getitem__(self, index: int) -> int:
        """The number at an index; raises `IndexError` beyond the ends."""
        if not 0 <= index < len(self):
            raise IndexError(index)
        place = int(np.searchsorted(self._ends, index, side="right"))
        return int(self._parts[place][index - (self._ends[place - 1] if place else 0)])

    def place(self, number: int) -> int:
        """The index of the first number that is not less than the given one."""
        return sum(int(np.searchsorted(each, number)) for each in self._parts)

    def count(self, index: int) -> int:
        """Always one: each entry represents itself."""
        return 1

    def array(self) -> Block:
        """All entries."""
        return np.concatenate(self._parts) if self._parts else np.zeros(0, np.int64)

    def joined(self, older: Block | None = None, newer: Block | None = None, keys: Block | None = None) -> Numbers:
        """A copy with older numbers prepended or newer ones appended; `keys` are ignored."""
        parts = [each for each in (older, *self._parts, newer) if each is not None]
        while len(parts) > 1 and len(parts[-2]) <= 2 * len(parts[-1]):
            parts[-2:] = [np.concatenate(parts[-2:])]
        return Numbers(parts)

    def since(self, first: int) -> Numbers:
        """The entries from a number on."""
        if not self._parts or self._parts[0][0] >= first:
            return self
        return Numbers([each[np.searchsorted(each, first) :] for each in self._parts])


class FoldedNumbers:
    """Ascending numbers in which each run of equal records is one entry, represented by its newest record."""

    def __init__(self, every: Numbers | None = None, begins: Numbers | None = None, ends: tuple[int, int] = (0, 0)):
        """`begins` are the first records of each run, `ends` the keys of the first and the last record of all."""
        self._every = every or Numbers()
        self._begins = begins or Numbers()
        self._ends = ends

    def __len__(self) -> int:
        """The number of runs."""
        return len(self._begins)

    def __getitem__(self, index: int) -> int:
        """The newest number of a run; raises `IndexError` beyond the ends."""
        if not 0 <= index < len(self):
            raise IndexError(index)
        return self._every[self._end_of_run(index) - 1]

    def _end_of_run(self, index: int) -> int:
        """The position, among all records, after the last one of a run."""
        return self._every.place(self._begins[index + 1]) if index + 1 < len(self) else len(self._every)

    def place(self, number: int) -> int:
        """The index of the first run whose newest record is not less than a number."""
        before = self._begins.place(number + 1)
        return before - 1 if before and self[before - 1] >= number else before

    def count(self, index: int) -> int:
        """The number of records in a run; raises `IndexError` beyond the ends."""
        return self._end_of_run(index) - self._every.place(self._begins[index])

    def joined(
        self, older: Block | None = None, newer: Block | None = None, keys: Block | None = None
    ) -> FoldedNumbers:
        """A copy with older numbers prepended or newer ones appended; equal records have equal `keys`."""
        block = older if older is not None else newer
        if block is None or keys is None or not len(block):
            return self
        begins = block[np.concatenate(([True], keys[1:] != keys[:-1]))]
        first, last = int(keys[0]), int(keys[-1])
        if not len(self):
            return FoldedNumbers(Numbers([block]), Numbers([begins]), (first, last))
        if older is not None:
            rest = self._begins.since(self._begins[0] + 1) if last == self._ends[0] else self._begins
            return FoldedNumbers(self._every.joined(older=block), rest.joined(older=begins), (first, self._ends[1]))
        if first == self._ends[1]:
            begins = begins[1:]
        return FoldedNumbers(self._every.joined(newer=block), self._begins.joined(newer=begins), (self._ends[0], last))

    def since(self, first: int) -> FoldedNumbers:
        """The entries from a number on; a run that contains it loses its earlier records."""
        every = self._every.since(first)
        begins = self._begins.since(first)
        if every is self._every or not len(every):
            return self if every is self._every else FoldedNumbers()
        if not len(begins) or begins[0] != every[0]:
            begins = begins.joined(older=np.array([every[0]], np.int64))
        return FoldedNumbers(every, begins, self._ends)
