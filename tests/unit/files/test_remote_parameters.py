"""Parameter files from a real HTTPS server with a temporary certificate: which are cached, and which are refused."""

from __future__ import annotations

import contextlib
import os
import shutil
import ssl
import subprocess
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from bot_console.runtime.files import remote_parameters
from bot_console.runtime.files.remote_parameters import RemoteError, local_copy
from bot_console.runtime.rmw.arguments import ArgumentsError, parse
from launch_ros.parameter_descriptions import ParameterFile

from launch import LaunchContext

pytestmark = pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl makes the certificate")
FIRST = b"/robot:\n  ros__parameters:\n    speed: 1.5\n"
SECOND = b"/robot:\n  ros__parameters:\n    speed: 2.5\n"


class Server(ThreadingHTTPServer):
    """Answers each request as the test says."""

    daemon_threads = True

    def __init__(self, certificate: Path | None) -> None:
        super().__init__(("127.0.0.1", 0), Answers)
        self.scheme = "https" if certificate else "http"
        if certificate:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
            context.load_cert_chain(certificate)
            self.socket = context.wrap_socket(self.socket, server_side=True)
        self.content, self.tag, self.status, self.location, self.length = FIRST, '"1"', 200, "", -1
        self.asked: list[str] = []

    @property
    def address(self) -> str:
        return f"{self.scheme}://localhost:{self.server_port}/robot.yaml"

    def handle_error(self, request: object, client_address: object) -> None:
        """Ignore clients that close the connection: some tests do."""


class Answers(BaseHTTPRequestHandler):
    server: Server

    def do_GET(self) -> None:
        known = self.headers.get("If-None-Match", "")
        self.server.asked.append(known)
        status = 200 if self.path.startswith("/there") else self.server.status
        status = 304 if known and known == self.server.tag and status == 200 else status
        self.send_response(status)
        if self.server.location:
            self.send_header("Location", self.server.location)
        if status != 304:
            self.send_header("ETag", self.server.tag)
            length = self.server.length if self.server.length >= 0 else len(self.server.content)
            self.send_header("Content-Length", str(length))
        self.end_headers()
        if status != 304:
            self.wfile.write(self.server.content)

    def log_message(self, *_: object) -> None:
        """Log nothing."""


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("tls")
    words = ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes"]
    words += ["-keyout", "key.pem", "-out", "certificate.pem", "-days", "2", "-subj", "/CN=localhost"]
    subprocess.run([*words, "-addext", "subjectAltName=DNS:localhost"], cwd=folder, check=True, capture_output=True)
    both = folder / "both.pem"
    both.write_text((folder / "key.pem").read_text() + (folder / "certificate.pem").read_text())
    return both


@pytest.fixture
def server(certificate: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    monkeypatch.setenv("SSL_CERT_FILE", str(certificate.with_name("certificate.pem")))
    monkeypatch.setenv("no_proxy", "localhost")
    with serving(Server(certificate)) as made:
        yield made


@contextlib.contextmanager
def serving(made: Server) -> Iterator[Server]:
    """A server that answers."""
    threading.Thread(target=made.serve_forever, args=(0.02,), daemon=True).start()
    yield made
    made.shutdown()
    made.server_close()


@pytest.fixture
def plain(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    """A server without TLS on this machine, and a proxy that must not be used."""
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", str(tmp_path))
    monkeypatch.setenv("http_proxy", "http://127.0.0.1:9")
    monkeypatch.delenv("no_proxy", raising=False)
    with serving(Server(None)) as made:
        yield made


@pytest.mark.parametrize("host", ["localhost", "LOCALHOST", "127.0.0.1"])
def test_local_server_needs_no_tls(plain: Server, host: str) -> None:
    address = plain.address.replace("localhost", host)
    assert local_copy(address).read_bytes() == FIRST
    assert parse(["--ros-args", "--params-file", address]).parameters.for_node("/robot") == {"speed": 1.5}


def test_local_server_may_redirect_elsewhere_only_with_tls(plain: Server) -> None:
    plain.status, plain.location = 302, plain.address.replace("robot", "there")
    assert local_copy(plain.address).read_bytes() == FIRST
    for other in ("http://example.org/robot.yaml", "http://127.0.0.1.example.org/robot.yaml"):
        plain.location = other
        with pytest.raises(RemoteError, match="which is not https: not followed"):
            local_copy(plain.address)


@pytest.mark.parametrize(
    "address", ["http://127.0.0.1:8/a.yaml", "http://127.8.9.1/a", "http://[::1]:80/a.yaml", "HTTP://LocalHost/a.yaml"]
)
def test_loopback_addresses_are_accepted_without_tls(address: str) -> None:
    remote_parameters._check(address)


def test_file_is_fetched_once_then_only_revalidated(server: Server) -> None:
    path = local_copy(server.address)
    assert path.read_bytes() == FIRST
    assert local_copy(server.address) == path
    assert server.asked == ["", '"1"']
    server.content, server.tag = SECOND, '"2"'
    assert local_copy(server.address).read_bytes() == SECOND
    assert path.stat().st_mode & 0o777 == 0o600


def test_unreachable_server_is_reported_and_last_copy_is_used(
    server: Server, capsys: pytest.CaptureFixture[str]
) -> None:
    local_copy(server.address)
    server.shutdown()
    server.server_close()
    assert local_copy(server.address).read_bytes() == FIRST
    message = capsys.readouterr().err
    assert message.startswith(
        f"[WARN] [bot-console]: {server.address} is out of reach (connection refused); its copy of "
    )
    with pytest.raises(RemoteError, match="and there is no copy of it here"):
        local_copy(server.address + "?other")


def test_server_error_503_counts_as_unreachable(server: Server, capsys: pytest.CaptureFixture[str]) -> None:
    local_copy(server.address)
    server.status = 503
    assert local_copy(server.address).read_bytes() == FIRST
    assert "it answers 503" in capsys.readouterr().err


def test_truncated_file_is_not_used(server: Server) -> None:
    local_copy(server.address)
    server.content, server.tag, server.length = SECOND[:20], '"2"', len(SECOND)
    assert local_copy(server.address).read_bytes() == FIRST


def test_missing_file_or_invalid_yaml_is_an_error(server: Server) -> None:
    path = local_copy(server.address)
    server.content, server.tag = b"a: [", '"2"'
    with pytest.raises(RemoteError, match="is not valid YAML, line"):
        local_copy(server.address)
    server.status = 404
    with pytest.raises(RemoteError, match="answers 404"):
        local_copy(server.address)
    assert path.read_bytes() == FIRST


def test_file_that_is_too_large_is_refused(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(remote_parameters, "MAX_FILE_BYTES", 1000)
    server.content = b"# " + b"x" * 2000
    with pytest.raises(RemoteError, match="larger than 1 kB"):
        local_copy(server.address)


def test_redirect_away_from_https_is_refused(server: Server) -> None:
    server.status, server.location = 302, "http://localhost/robot.yaml"
    with pytest.raises(RemoteError, match="which is not https: not followed"):
        local_copy(server.address)
    server.location = "file:///etc/passwd"
    with pytest.raises(RemoteError, match="is not allowed"):
        local_copy(server.address)


def test_redirect_within_https_is_followed(server: Server) -> None:
    server.status, server.location = 302, server.address.replace("robot", "there")
    assert local_copy(server.address).read_bytes() == FIRST


def test_untrusted_certificate_is_refused_despite_a_copy(server: Server, monkeypatch: pytest.MonkeyPatch) -> None:
    local_copy(server.address)
    monkeypatch.delenv("SSL_CERT_FILE")
    with pytest.raises(RemoteError, match=r"its certificate is not trusted: self.signed"):
        local_copy(server.address)
    with pytest.raises(RemoteError, match="not trusted"):
        local_copy(server.address.replace("localhost", "127.0.0.1"))


@pytest.mark.parametrize(
    ("address", "why"),
    [
        ("http://example.org/a.yaml", "give an https:// address"),
        ("http://192.168.0.5/a.yaml", "give an https:// address"),
        ("http://localhost.example.org/a.yaml", "give an https:// address"),
        ("http://127.0.0.1.example.org/a.yaml", "give an https:// address"),
        ("http://127.0.0.1@example.org/a.yaml", "a password in an address"),
        ("http://0.0.0.0/a.yaml", "give an https:// address"),
        ("http:///a.yaml", "give an https:// address"),
        ("http://me:secret@example.org/a.yaml", "a password in an address"),
        ("https:///a.yaml", "is not a valid address"),
        ("https://host:port/a.yaml", "is not a valid address"),
        ("https://host/a b.yaml", "is not a valid address"),
        ("https://me:secret@host/a.yaml", "a password in an address"),
    ],
)
def test_invalid_addresses_are_refused_without_printing_passwords(address: str, why: str) -> None:
    with pytest.raises(RemoteError, match=why) as refused:
        local_copy(address)
    assert "secret" not in str(refused.value)


def test_copy_changed_by_hand_is_fetched_again(server: Server) -> None:
    path = local_copy(server.address)
    path.write_bytes(b"changed: true")
    assert local_copy(server.address).read_bytes() == FIRST
    assert server.asked == ["", ""]


def test_node_loads_parameters_from_an_address(server: Server) -> None:
    found = parse(["--ros-args", "--params-file", server.address]).parameters
    assert found.for_node("/robot") == {"speed": 1.5}
    with pytest.raises(ArgumentsError, match="give an https:// address"):
        parse(["--ros-args", "--params-file", "http://example.org/a.yaml"])


def test_parameter_file_in_a_launch_is_fetched_once(server: Server) -> None:
    file = ParameterFile(server.address)
    path = file.evaluate(LaunchContext())
    assert path.read_bytes() == FIRST
    assert file.evaluate(LaunchContext()) == path
    assert len(server.asked) == 1
    assert os.fspath(path).endswith(".yaml")


def test_all_nodes_of_a_launch_share_one_answer(server: Server) -> None:
    context = LaunchContext()
    paths = {ParameterFile(server.address).evaluate(context) for _ in range(3)}
    assert len(paths) == len(server.asked) == 1
    ParameterFile(server.address).evaluate(LaunchContext())
    assert len(server.asked) == 2
