"""What the console asks of the runtime because no ROS interface provides it."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from pathlib import Path
from typing import Any

from bot_console.runtime.files.remote_parameters import local_copy
from bot_console.runtime.interfaces.type_inquiry import inquiries
from bot_console.runtime.process.virtual.install import reinstall_stdio
from bot_console.runtime.rmw.middleware import bus_of
from bot_console.runtime.rosidl.generic import generic_class
from bot_console.runtime.rosidl.type_hash import text
from bot_console.tui.session.embedded.domain import domain


class DomainTypes:
    """A `TypeSource`: builds interfaces that the console lacks from the definitions that nodes send.

    Also a `GenericTypes`, for recording and playing messages of types without a definition.
    """

    def inquiries(self, domain: int, type_name: str) -> Mapping[str, Generator[tuple[str, str], Any, str]]:
        """The dialogues about a type, by the nodes of other processes that can be asked."""
        return inquiries(domain, type_name)

    def generic_class(self, type_name: str, type_hash: str) -> Any:
        """A class for serialized messages of an unknown type; raises `ValueError` for an invalid name or hash."""
        return generic_class(type_name, type_hash)

    def type_hash(self, kind: Any) -> str:
        """The type hash of a message class; messages with another one are not received."""
        return text(kind)


def graph_events(domain: int, changed: Callable[[tuple[str, str]], None]) -> Callable[[], None]:
    """Call `changed` with name and namespace of each changed node of a domain; returns a function that ends this."""
    return bus_of(domain).on_graph_change(changed)


def halted_nodes(domain: int) -> tuple[Mapping[int, Sequence[str]], Mapping[str, str]]:
    """The frozen processes of a domain with their nodes, by pid; and the nodes in a debugger, with the line."""
    bus = bus_of(domain)
    return bus.stopped(), bus.debugged()


def node_processes() -> Mapping[int, Sequence[str]]:
    """The nodes of the domain's processes on this machine, by pid."""
    return bus_of(domain()).processes()


def local_parameter_file(address: str) -> Path:
    """The local copy of a parameter file on a server."""
    return local_copy(address)


def take_over_streams() -> None:
    """Give standard input and output back to the node processes, after Textual has replaced the streams."""
    reinstall_stdio()
