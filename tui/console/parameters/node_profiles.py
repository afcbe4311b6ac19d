"""The port for profiles: those of all folders, and the changes that they would make in the running nodes."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from concurrent.futures import Future
from functools import partial
from typing import TYPE_CHECKING

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import Gate, done
from bot_console.tui.console.model import Profile, ProfileDifference, SetOutcome, Value
from bot_console.tui.console.parameters.node_parameters import NodeParameters, refused

if TYPE_CHECKING:
    from bot_console.tui.console.parameters.profile_store import ProfileStore


class NodeProfiles:
    """Manages the profiles. They are the user's files, so a read-only console can open and save them too."""

    _count: tuple[Profile | None, object, int] = (None, None, 0)

    def __init__(self, gate: Gate, parameters: NodeParameters, reset_world: Callable[[], Awaitable[object]]) -> None:
        self._gate = gate
        self._parameters = parameters
        self._reset_world = reset_world
        self._store: ProfileStore | None = None
        self._once_there: set[str] = set()
        """Names of profiles that were in the profile store while they were active."""

    def attach(self, store: ProfileStore) -> None:
        """Provide the profile store, once the profiles have been read."""
        self._store = store

    @property
    def all(self) -> tuple[Profile, ...]:
        """All profiles; the same object until one changes."""
        return self._store.profiles if self._store else ()

    @property
    def active(self) -> str:
        """The name of the active profile; empty once its file has been deleted."""
        name = self._parameters.profile
        if self._profile(name) is not None:
            self._once_there.add(name)
        elif name in self._once_there:
            return ""
        return name

    @property
    def active_profile(self) -> Profile | None:
        """The active profile; None if there is none, or if it is not in the profile store."""
        return self._profile(self.active)

    @property
    def changes(self) -> int:
        """How many values of the active profile differ from those of the running nodes."""
        profile, trees = self._profile(self.active), self._parameters.trees
        if self._count[0] is not profile or self._count[1] is not trees:
            self._count = profile, trees, sum(not each.unknown for each in self._differences(profile))
        return self._count[2]

    def _profile(self, name: str) -> Profile | None:
        return next((each for each in self.all if each.name == name), None)

    def _differences(self, profile: Profile | None) -> Sequence[ProfileDifference]:
        if profile is None:
            return ()
        from bot_console.tui.console.parameters.profiles import differences

        return differences(profile, self._parameters.trees)

    def differences(self, name: str) -> Sequence[ProfileDifference]:
        """The changes that a profile would make."""
        return self._differences(self._profile(name))

    def apply(self, name: str, *, reset_world: bool = False) -> Future[tuple[SetOutcome, ...]]:
        """Set a profile's values in the running nodes, then reset the simulator if requested."""
        profile = self._profile(name)
        why_not = self._gate.refusal or self._why_not(name, profile)
        if why_not:
            failed: Future[tuple[SetOutcome, ...]] = Future()
            failed.set_exception(ValueError(why_not))
            return failed
        values: dict[str, dict[str, Value]] = {}
        for each in self._differences(profile):
            if not each.unknown:
                values.setdefault(each.node, {})[each.name] = each.then
        return self._gate.run(lambda: self._apply(name, values, reset_world), partial(refused, values))

    async def _apply(
        self, name: str, values: Mapping[str, Mapping[str, Value]], reset_world: bool
    ) -> tuple[SetOutcome, ...]:
        outcomes = await self._parameters.apply(name, values)
        if reset_world and all(each.accepted for each in outcomes):
            await self._reset_world()
        return outcomes

    def _why_not(self, name: str, profile: Profile | None) -> str:
        if profile is None:
            return f"there is no profile {name}"
        from bot_console.tui.console.parameters.profiles import cannot_apply

        return profile.problem or cannot_apply(profile, self._parameters.trees)

    def open(self, path: str) -> Answer:
        """Add a file as a profile."""
        return self._store.open(path) if self._store and not self._gate.unreached else self._refusal

    def fetch(self, address: str) -> Future[Answer]:
        """Download a parameter file and add it as a profile."""
        return self._store.fetch(address) if self._store and not self._gate.unreached else done(self._refusal)

    def save(self, name: str, description: str = "") -> Answer:
        """Save the current values as a profile."""
        if self._store is None or self._gate.unreached:
            return self._refusal
        answer = self._store.save(name, description, self._parameters.trees)
        if answer.ok:
            self._parameters.saved()
        return answer

    def rename(self, name: str, to: str) -> Answer:
        """Rename a profile, including the active one."""
        if self._store is None or self._gate.unreached:
            return self._refusal
        answer = self._store.rename(name, to)
        if answer.ok:
            self._parameters.profile_renamed(name, to)
        return answer

    def delete(self, name: str) -> Answer:
        """Delete the file of a profile."""
        return self._store.delete(name) if self._store and not self._gate.unreached else self._refusal

    @property
    def _refusal(self) -> Answer:
        return Answer(False, self._gate.unreached)
