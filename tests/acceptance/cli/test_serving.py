"""`up --serve` admits clients of a router, and warns of the risk; `router` forwards messages, or says why it cannot."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from processes.certificates import make_certificates
from processes.command_line import run_cli
from processes.ports import free_port

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

TIMEOUT_S = 240


@pytest.mark.slow
def test_background_robot_is_reached_through_router_with_certificate_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    files = make_certificates(tmp_path)
    place = f"tls/localhost:{free_port()}"
    shown = ("--tls-certificate", files.certificate, "--tls-key", files.key)
    started = run_cli("up", "--serve", place, "--tls-ca", files.ca, *shown)
    try:
        assert started.returncode == 0, started.stderr
        assert "WARNING" not in started.stderr  # The router listens on loopback.
        monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", f"{os.environ['BOT_CONSOLE_SOCKET_DIR']}x")
        capture = tmp_path / "robot.json"
        way = ("--connect", place, "--tls-ca", files.ca)
        seen = run_cli("doctor", *way, *shown, "--capture", str(capture))
        assert seen.returncode == 0, seen.stdout
        assert "emergency stop that answers" in seen.stdout
        assert any("/simulator/" in each for each in json.loads(capture.read_text())["tokens"])
        monkeypatch.setenv("BOT_CONSOLE_CONNECT", place)
        names = {
            "root_ca_certificate": files.ca,
            "connect_certificate": files.certificate,
            "connect_private_key": files.key,
        }
        override = ("enable_mtls=true", *(f'{name}="{path}"' for name, path in names.items()))
        monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", ";".join(f"transport/link/tls/{each}" for each in override))
        assert "/simulator" in run_cli("node", "list").stdout
        assert run_cli("stop", "from afar").returncode == 0
        monkeypatch.delenv("ZENOH_CONFIG_OVERRIDE")
        monkeypatch.delenv("BOT_CONSOLE_CONNECT")
        refused = run_cli("doctor", *way)
        assert refused.returncode == 1 and "--tls-certificate" in refused.stdout
    finally:
        monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", os.environ["BOT_CONSOLE_SOCKET_DIR"].removesuffix("x"))
        ended = run_cli("down")
    assert ended.returncode == 0
    assert run_cli("doctor", "--connect", place.replace("tls/", "tcp/")).returncode == 1


@pytest.mark.parametrize(
    ("words", "code", "reported"),
    [
        (["--listen", "robot"], 2, "is not an endpoint"),
        (["--listen", "tls/127.0.0.1:7447"], 2, "needs --tls-certificate and --tls-key"),
        (["--listen", "tcp/192.0.2.1:7447"], 1, "anyone who can reach tcp/192.0.2.1:7447 can drive this robot"),
    ],
)
def test_invalid_endpoint_is_refused_and_open_one_warned_of(words: list[str], code: int, reported: str) -> None:
    done = run_cli("router", *words)
    assert done.returncode == code and reported in done.stderr


def test_router_ends_on_a_signal() -> None:
    line = [sys.executable, "-m", "bot_console.tui", "router", "--listen", f"tcp/127.0.0.1:{free_port()}"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None and "a router for nodes of rmw_zenoh" in process.stdout.readline()
            process.send_signal(signal.SIGTERM)
            assert process.wait(TIMEOUT_S) == 0
        finally:
            process.kill()
