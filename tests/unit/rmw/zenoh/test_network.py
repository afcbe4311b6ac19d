"""A client of a router: how it connects, why it fails, and what happens if the router leaves and returns."""

import json
import re
import socket
import ssl
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.rmw.zenoh.link_probe import LinkProbe
from bot_console.runtime.rmw.zenoh.network import reachability
from bot_console.runtime.rmw.zenoh.network.client import (
    ClientConfig,
    client_settings,
    open_network_session,
    with_environment,
)
from bot_console.runtime.rmw.zenoh.network.reachability import Tls, place_of, why_unreachable
from bot_console.runtime.rmw.zenoh.network.router import Router, router_settings
from bot_console.runtime.rmw.zenoh.session import SessionError
from bot_console.runtime.rmw.zenoh.settings import Serving, session_settings
from bot_console.runtime.rmw.zenoh.whole_graph import WholeGraph
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, node_token
from processes.certificates import make_certificates
from processes.ports import free_port

TIMEOUT_S = 240.0
STEP = 0.125


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tls")
    return make_certificates(folder), make_certificates(folder, "stranger")


@pytest.fixture(scope="module")
def secure(files):
    own, _ = files
    endpoint = f"tls/localhost:{free_port()}"
    router = Router(Serving((endpoint,), Tls(own.ca, own.certificate, own.key).as_listener()))
    yield endpoint
    router.close()


def refusal(config: ClientConfig) -> str:
    with pytest.raises(SessionError) as refused:
        open_network_session(0, config)
    return str(refused.value)


def test_mutual_tls_connects(secure, files):
    own, _ = files
    session = open_network_session(0, ClientConfig((secure,), Tls(own.ca, own.certificate, own.key)))
    assert session.answering_sessions(session.zid[:8], TIMEOUT_S) == {session.zid[:8]}
    session.close()


def test_router_with_foreign_certificate_is_refused_and_reported(secure, files):
    _, stranger = files
    tls = Tls(stranger.ca, stranger.certificate, stranger.key)
    assert "the router's certificate is refused" in refusal(ClientConfig((secure,), tls, timeout_s=0.3))


def test_client_with_missing_or_wrong_certificate_is_refused_and_reported(secure, files):
    own, stranger = files
    assert "--tls-certificate" in refusal(ClientConfig((secure,), Tls(own.ca), timeout_s=0.3))
    wrong = Tls(own.ca, stranger.certificate, stranger.key)
    reported = refusal(ClientConfig((secure,), wrong, timeout_s=0.3))
    assert stranger.certificate in reported and "X.509 version 3" in reported and "--tls-certificate" not in reported


def test_router_that_does_not_get_to_the_handshake_is_reported_as_overloaded_or_without_tls(monkeypatch):
    monkeypatch.setattr(reachability, "TIMEOUT_S", 0.1)
    with socket.create_server(("127.0.0.1", 0)) as listening:  # connections wait, as behind a flood of others
        reported = why_unreachable([f"tls/127.0.0.1:{listening.getsockname()[1]}"], Tls())
    assert "no answer to TLS within 0.1 s: the router is overloaded (try again)" in reported


def test_certificate_accepted_by_zenoh_is_not_blamed_by_stricter_python(secure, files, monkeypatch):
    own, _ = files
    default = ssl.create_default_context

    def strict(**given):
        context = default(**given)
        context.verify_flags |= ssl.VERIFY_X509_STRICT
        return context

    monkeypatch.setattr(ssl, "create_default_context", strict)
    assert "--tls-certificate" in refusal(ClientConfig((secure,), Tls(own.ca), timeout_s=0.3))


def test_unusable_certificate_files_are_named(secure, files, tmp_path):
    own, _ = files
    text = tmp_path / "text"
    text.write_text("hello")
    assert f"{text} is not a PEM file" in refusal(ClientConfig((secure,), Tls(str(text)), timeout_s=0.3))
    assert "cannot read /nowhere" in refusal(ClientConfig((secure,), Tls("/nowhere"), timeout_s=0.3))
    assert "go together" in refusal(ClientConfig((secure,), Tls(own.ca, own.certificate), timeout_s=0.3))


def test_unreachable_router_is_reported_with_what_to_start():
    assert "rmw_zenohd" in refusal(ClientConfig((f"tcp/127.0.0.1:{free_port()}",), timeout_s=0.3))
    assert "no host of the name" in refusal(ClientConfig(("tcp/no-such-robot.invalid:7447",), timeout_s=0.3))
    assert "no host of the name" in refusal(ClientConfig((f"tcp/{'a' * 64}:7447",), timeout_s=0.3))


def test_port_that_is_open_but_does_not_answer_is_reported_with_what_to_check():
    with socket.create_server(("127.0.0.1", 0)) as listening:
        endpoint = f"tcp/127.0.0.1:{listening.getsockname()[1]}"
        reported = refusal(ClientConfig((endpoint,), timeout_s=0.3))
    assert reported.startswith(f"{endpoint}: the port is open, but no router answered within 0.3 s: try again")


@pytest.mark.parametrize("text", ["robot", "robot:7447", "tcp/robot", "tcp/:7447", "tcp/robot:70000", "tcp/robot:x"])
def test_invalid_endpoint_is_reported_with_an_example(text):
    with pytest.raises(ValueError, match="tcp/robot:7447"):
        place_of(text)


def test_endpoint_is_split_into_protocol_host_and_port():
    assert place_of("tls/[::1]:7447#iface=lo") == ("tls", "::1", 7447)


def test_environment_variables_of_rmw_zenoh_are_respected(monkeypatch, tmp_path):
    port = free_port()
    router = Router(Serving((f"tcp/127.0.0.1:{port}",)))
    file = tmp_path / "session.json5"
    file.write_text("{ mode: 'peer', connect: { endpoints: ['tcp/127.0.0.1:1'] } }  // as for a node")
    monkeypatch.setenv("ZENOH_SESSION_CONFIG_URI", str(file))
    monkeypatch.setenv("ZENOH_CONFIG_OVERRIDE", f'connect/endpoints=["tcp/127.0.0.1:{port}"];connect/timeout_ms=3000')
    session = open_network_session(0, with_environment(ClientConfig(timeout_s=0.3)))
    assert session.answering_sessions(session.zid[:8], TIMEOUT_S)
    session.close()
    router.close()


@pytest.mark.parametrize(
    ("name", "value", "reported"),
    [
        ("ZENOH_SESSION_CONFIG_URI", "/nowhere.json5", "there is no file /nowhere.json5"),
        ("ZENOH_CONFIG_OVERRIDE", "connect", "path=value"),
        ("ZENOH_CONFIG_OVERRIDE", "mode=", "path=value"),
    ],
)
def test_invalid_environment_variables_are_rejected(monkeypatch, name, value, reported):
    monkeypatch.setenv(name, value)
    with pytest.raises(SessionError, match=reported):
        with_environment(ClientConfig(("tcp/robot:7447",)))


def test_invalid_tokens_are_ignored_and_the_first_is_reported():
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router, config, reported = Router(serving), ClientConfig(serving.endpoints), []
    robot, client = open_network_session(0, config), open_network_session(0, config)
    robot.declare_token(node_token(0, TokenNode(robot.zid, 0, "", "/", "robot")))
    for each in ("XX/%/%/robot", "NN/%"):
        robot.declare_token(f"@ros2_lv/0/{robot.zid}/1/2/{each}")
    forget = on_notice(lambda process, text: reported.append(text))
    graph = WholeGraph(client, lambda node: None)
    forget()
    assert [each.name for each in graph.tables.nodes()] == ["robot"]
    assert len(reported) == 1 and "is not in the format of rmw_zenoh" in reported[0]
    for each in (client, robot, router):
        each.close()


def test_setting_unknown_to_zenoh_is_rejected():
    assert "rejects" in refusal(ClientConfig(("tcp/127.0.0.1:1",), override=(("mode", "'boss'"),)))


def test_client_does_not_listen_or_scout():
    settings = client_settings("1" * 32, ClientConfig(("tcp/robot:7447",)))
    assert settings["mode"] == "client" and settings["listen"] == {"endpoints": []}
    assert not settings["scouting"]["multicast"]["enabled"] and not settings["scouting"]["gossip"]["enabled"]
    assert json.dumps(settings)


def test_client_reconnects_and_its_declarations_work_after_router_restart():
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router, config = Router(serving), ClientConfig(serving.endpoints)
    one, two = open_network_session(0, config), open_network_session(0, config)
    heard = threading.Event()
    two.declare_subscriber("t", lambda payload, attachment: heard.set())
    publisher = one.declare_publisher("t")
    lost, back = threading.Event(), threading.Event()
    one.watch_links(lambda zid, on: (back if on and lost.is_set() else lost).set() if not on or lost.is_set() else None)
    router.close()
    assert lost.wait(TIMEOUT_S)
    router = Router(serving)
    assert back.wait(TIMEOUT_S)
    for _ in range(round(TIMEOUT_S / 0.05)):
        publisher.put(b"again", b"")
        if heard.wait(0.05):
            break
    assert heard.is_set()
    for each in (one, two, router):
        each.close()


@pytest.mark.parametrize("settings", [session_settings, router_settings])
def test_queues_to_other_machines_are_short(settings):
    serving = Serving(("tls/localhost:1",), {"listen_certificate": "c"})
    beside = ("unixsock-stream/a", ["unixsock-stream/b"]) if settings is session_settings else ()
    link = settings("1" * 32, *beside, serving)["transport"]["link"]
    assert link["tcp"]["so_sndbuf"] == link["tls"]["so_sndbuf"] == 16_384
    assert link["tls"]["listen_certificate"] == "c"
    assert link["tx"]["batch_size"] * link["tx"]["queue"]["size"]["data"] == 16_384
    at_home = session_settings("1" * 32, "unixsock-stream/a", [])["transport"]["link"]
    assert "tcp" not in at_home and "batch_size" not in at_home["tx"]


def test_documented_access_list_keeps_guests_from_controlling_the_robot(tmp_path):
    text = (Path(__file__).parents[4] / "docs" / "your-robot.md").read_text(encoding="utf-8")
    (listed,) = re.findall(r"^```json5\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    file = tmp_path / "access.json5"
    file.write_text(listed)
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router, config = Router(serving, str(file)), ClientConfig(serving.endpoints)
    robot, guest = open_network_session(0, config), open_network_session(0, config)
    heard, asked = [], []
    for topic in ("scan", "cmd_vel", "ns/cmd_vel"):
        robot.declare_subscriber(f"0/{topic}/t", lambda payload, attachment, topic=topic: heard.append(topic))
    for service in ("n/get_parameters", "n/set_parameters"):

        def answer(query, service=service):
            asked.append(service)
            query.answer(b"", b"")

        robot.declare_queryable(f"0/{service}/t", answer)
    publishers = [guest.declare_publisher(f"0/{topic}/t") for topic in ("cmd_vel", "ns/cmd_vel", "scan")]
    for _ in range(round(TIMEOUT_S / 0.02)):
        for each in publishers:
            each.put(b"", b"")
        if heard.count("scan") >= 3:
            break
        threading.Event().wait(0.02)
    for service in ("n/set_parameters", "n/get_parameters"):
        done = threading.Event()
        guest.declare_querier(f"0/{service}/t", 2.0).get(b"", b"", lambda *reply: None, done.set)
        assert done.wait(TIMEOUT_S)
    assert set(heard) == {"scan"} and asked == ["n/get_parameters"]
    for each in (robot, guest, router):
        each.close()


def test_taken_port_is_reported():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        place = f"tcp/127.0.0.1:{taken.getsockname()[1]}"
        with pytest.raises(SessionError, match=f"cannot listen on {place}"):
            Router(Serving((place,)))


class Link:
    """A link whose answers are given by the test; its probe runs on request."""

    def __init__(self) -> None:
        self.now = 100.0
        self.asked: list[tuple[float, list[bool]]] = []
        self.probe = LinkProbe(self._ask, "tcp/robot:7447", lambda: self.now)
        self.probe.end()

    def _ask(self, timeout: float) -> Callable[[], bool | None]:
        answer: list[bool] = []
        self.asked.append((self.now, answer))
        return lambda: answer[0] if answer else None

    def pass_time(self, seconds: float, delay: float | None) -> None:
        """Let time pass on a link that answers each query after `delay` s; None: never."""
        for _ in range(round(seconds * 8)):
            self.now += STEP
            for asked, answer in self.asked:
                if delay is not None and self.now - asked >= delay:
                    answer.append(True)
            self.probe.poll()

    @property
    def silent(self) -> float:
        """Return how long nothing was answered, in s."""
        return self.now - (self.probe.state.last_answer or 0.0)

    @property
    def delay(self) -> float | None:
        return self.probe.state.delay


@pytest.fixture
def link():
    link = Link()
    link.probe.poll()
    return link


def test_unanswered_link_keeps_the_delay_of_its_last_answer(link):
    link.pass_time(1.0, 0.25)
    assert (link.silent, link.delay) == (0.25, 0.25)
    link.pass_time(3.0, None)
    assert (link.silent, link.delay) == (3.25, 0.25)


def test_link_that_always_answers_late_is_slow_but_not_silent(link):
    link.pass_time(1.0, 0.25)
    link.pass_time(9.0, 2.5)
    assert link.silent <= 0.5 and link.delay == 2.5
    link.pass_time(2.0, None)
    link.pass_time(STEP, 2.5)
    assert link.silent == 0.0


def test_delays_of_queries_sent_before_a_silence_ended_are_ignored(link):
    link.pass_time(1.0, 0.25)
    link.pass_time(9.0, None)
    link.pass_time(STEP, 0.0)  # all open queries end at once, as when the link is dropped
    link.pass_time(2.0, None)
    assert link.silent == 11.25 + STEP
    link.pass_time(1.0, 0.25)
    link.pass_time(1.0, 0.25)
    assert link.silent <= 0.5


@pytest.mark.parametrize(
    ("content", "expected"),
    [(None, "there is no file {}"), ("mode:", "Zenoh rejects {}: .+")],
    ids=["missing", "broken"],
)
def test_unusable_configuration_of_a_router_names_its_file_and_not_the_port(tmp_path, content, expected):
    file = tmp_path / "router.json5"
    if content is not None:
        file.write_text(content)
    with pytest.raises(SessionError) as raised:
        Router(Serving((f"tcp/127.0.0.1:{free_port()}",)), str(file))
    assert re.fullmatch(expected.format(file), str(raised.value))
