"""Whatever a console starts reaches the system of that console: its robot's router, or the domain of this machine."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.rmw.zenoh.network.client import (
    CONFIG_VARIABLE,
    OVERRIDE_VARIABLE,
    ClientConfig,
    with_environment,
)
from bot_console.runtime.rmw.zenoh.network.reachability import Tls
from bot_console.tui.cli import open_console
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.attach_options import AttachOptions
from bot_console.tui.session import network
from bot_console.tui.session.embedded.connecting import lead_children_to
from bot_console.tui.session.embedded.domain import CONNECT_VARIABLE
from bot_console.tui.session.embedded.reaching import named_routers
from domains import unused_domain

ROBOT = "tcp/robot:7447"
CA = "transport/link/tls/root_ca_certificate"


@pytest.fixture(autouse=True)
def own_environment(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(os, "environ", os.environ.copy())
    for each in (CONNECT_VARIABLE, CONFIG_VARIABLE, OVERRIDE_VARIABLE):
        os.environ.pop(each, None)
    os.environ["ROS_DOMAIN_ID"] = str(unused_domain())
    yield


@pytest.fixture
def started_sessions(monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, ...]]:
    """The arguments of the sessions that are started; none is shown."""
    sessions: list[tuple[Any, ...]] = []

    class Started:
        def __init__(self, *arguments: Any, **_: Any) -> None:
            sessions.append(arguments)

        def run(self) -> int:
            return 0

    monkeypatch.setattr(open_console, "Session", Started)
    monkeypatch.setattr(open_console, "_refusal", lambda _: "")
    monkeypatch.setattr(network, "AttachedSession", Started)
    monkeypatch.setattr(network, "connect", lambda _: Closed())
    monkeypatch.setattr(network, "choose", lambda _: None)
    return sessions


class Closed:
    """Replaces a connection."""

    def other_domains(self, domain: int) -> str:
        return ""

    def close(self) -> None:
        pass


def test_programs_that_a_network_console_starts_reach_its_router(started_sessions: list[tuple[Any, ...]]) -> None:
    assert network.run_network(AttachOptions(Options(), ClientConfig((ROBOT,)))) == 0
    assert len(started_sessions) == 1 and named_routers() == [ROBOT]


@pytest.mark.parametrize(
    "line", ["ros2 run package node", "run node.py --ros-args -p a:=1", "launch x.launch.py", "run --prefix nice a b"]
)
def test_network_console_starts_no_nodes_that_would_not_reach_its_robot(
    started_sessions: list[tuple[Any, ...]], line: str
) -> None:
    network.run_network(AttachOptions(Options(), ClientConfig((ROBOT,))))
    with pytest.raises(ValueError, match="launch on the robot itself"):
        started_sessions[0][1].run(line).result(240.0)


def test_programs_that_a_console_in_the_domain_starts_stay_there(started_sessions: list[tuple[Any, ...]]) -> None:
    os.environ[CONNECT_VARIABLE] = ROBOT
    assert open_console.run(Options(attach=True)) == 0
    assert named_routers() == []
    assert any(ROBOT in each for each in started_sessions[0][1].args[1]), "the console's log reports it"


def test_children_inherit_several_endpoints_and_certificates_but_the_users_settings_take_precedence(
    tmp_path: Path,
) -> None:
    ca = tmp_path / "a;b=c.pem"
    os.environ[OVERRIDE_VARIABLE] = f'{CA}="/mine.pem"'
    lead_children_to(ClientConfig((ROBOT, "tls/other:1"), Tls(ca=str(ca), any_name=True)))
    inherited = with_environment(ClientConfig(tuple(named_routers())))
    assert inherited.endpoints == (ROBOT, "tls/other:1")
    settings = [(path, value.replace("\\u003b", ";")) for path, value in inherited.override]
    assert settings[0] == (CA, f'"{ca}"') and settings[-1] == (CA, '"/mine.pem"')
    assert ("transport/link/tls/verify_name_on_connect", "false") in settings


@pytest.mark.parametrize("endpoints", [f'["{ROBOT}"]', f'{{ router: [], client: ["{ROBOT}"] }}'])
def test_children_inherit_the_endpoint_of_a_configuration_file(tmp_path: Path, endpoints: str) -> None:
    file = tmp_path / "session.json5"
    file.write_text(f"{{ connect: {{ endpoints: {endpoints} }} }}")
    os.environ[CONFIG_VARIABLE] = str(file)
    lead_children_to(ClientConfig())
    assert named_routers() == [ROBOT]
