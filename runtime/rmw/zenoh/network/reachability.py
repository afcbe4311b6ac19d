"""Find out why a router cannot be reached, by trying the network and TLS without Zenoh.

Zenoh itself reports only that it could not connect.
"""

from __future__ import annotations

import os
import socket
import ssl
from collections.abc import Sequence
from dataclasses import dataclass

TIMEOUT_S = 3.0
"""Timeout of each step, in seconds."""
ENCRYPTED = ("tls", "quic", "wss")
PORT = 7447
"""The port of a Zenoh router."""


@dataclass(frozen=True)
class Tls:
    """TLS files (PEM). A client that has its own certificate authenticates itself (mutual TLS)."""

    ca: str = ""
    """The certificate authority that signed the other side's certificate."""
    certificate: str = ""
    key: str = ""
    any_name: bool = False
    """Whether the name in the router's certificate may differ from the host name used to connect."""

    def as_client(self) -> dict[str, object]:
        """Return the settings for connecting."""
        given: dict[str, object] = {}
        if self.ca:
            given["root_ca_certificate"] = os.path.abspath(self.ca)
        if self.certificate:
            given.update(
                enable_mtls=True,
                connect_certificate=os.path.abspath(self.certificate),
                connect_private_key=os.path.abspath(self.key),
            )
        if self.any_name:
            given["verify_name_on_connect"] = False
        return given

    def as_listener(self) -> dict[str, object]:
        """Return the settings for listening; if an authority is given, clients need a certificate signed by it."""
        given: dict[str, object] = {}
        if self.certificate:
            given.update(
                listen_certificate=os.path.abspath(self.certificate), listen_private_key=os.path.abspath(self.key)
            )
        if self.ca:
            given.update(root_ca_certificate=os.path.abspath(self.ca), enable_mtls=True)
        return given

    def problem(self) -> str:
        """Say what is wrong with the files; empty if nothing is."""
        for path in filter(None, (self.ca, self.certificate, self.key)):
            try:
                with open(path, "rb") as file:
                    if b"-----BEGIN " not in file.read():
                        return f"{path} is not a PEM file"
            except OSError as error:
                return f"cannot read {path}: {error.strerror}"
        if bool(self.certificate) != bool(self.key):
            return "a certificate and its private key go together: give both"
        return ""


def place_of(endpoint: str) -> tuple[str, str, int]:
    """Split an endpoint such as `tcp/robot:7447` or `tls/[::1]:7447` into protocol, host, port; raises `ValueError`."""
    protocol, _, rest = endpoint.partition("#")[0].partition("?")[0].partition("/")
    host, _, port = rest.rpartition(":")
    if not (protocol.isalnum() and host and port.isdecimal() and 0 < int(port) < 65536):
        raise ValueError(f"'{endpoint}' is not an endpoint: write it as tcp/robot:{PORT} or tls/192.168.1.5:{PORT}")
    return protocol, host.strip("[]"), int(port)


def why_unreachable(endpoints: Sequence[str], tls: Tls) -> str:
    """Say why none of the endpoints is reachable and what to do; empty if the network shows no reason."""
    reasons: list[str] = []
    for each in endpoints:
        protocol, host, port = place_of(each)
        if protocol not in ("tcp", "tls"):
            return ""
        reason = _why(each, host, port, tls if protocol in ENCRYPTED else None)
        if not reason:
            return ""
        reasons.append(reason)
    return "; ".join(reasons)


def _why(endpoint: str, host: str, port: int, tls: Tls | None) -> str:
    try:
        with socket.create_connection((host, port), TIMEOUT_S) as link:
            return _why_no_tls(link, endpoint, host, tls) if tls else ""
    except (socket.gaierror, UnicodeError):  # UnicodeError: not a host name
        return f"{endpoint}: no host of the name '{host}' is known here: check the name, or give the robot's address"
    except ConnectionRefusedError:
        return (
            f"{endpoint}: the host is there, but no router listens on port {port}: start one on the robot "
            "(`ros2 run rmw_zenoh_cpp rmw_zenohd`, or `bot-console router`)"
        )
    except TimeoutError:
        return f"{endpoint}: no answer within {TIMEOUT_S:g} s: is the robot on, in this network, and its firewall open?"
    except OSError as error:
        return f"{endpoint}: {error.strerror or error}"


def _why_no_tls(link: socket.socket, endpoint: str, host: str, tls: Tls) -> str:
    problem = tls.problem()
    if problem:
        return problem
    context = ssl.create_default_context(cafile=tls.ca or None)
    context.check_hostname = not tls.any_name
    # Zenoh accepts certificates without the extensions that this flag requires; Python sets it by default from 3.13 on.
    context.verify_flags &= ~ssl.VERIFY_X509_STRICT
    try:
        if tls.certificate:
            context.load_cert_chain(tls.certificate, tls.key)
        secure = context.wrap_socket(link, server_hostname=host)
    except TimeoutError:
        return (
            f"{endpoint}: no answer to TLS within {TIMEOUT_S:g} s: the router is overloaded (try again), "
            f"or it is one for tcp/{host}"
        )
    except ssl.SSLCertVerificationError as error:
        return f"{endpoint}: the router's certificate is refused: {error.verify_message}; --tls-ca names its authority"
    except (ssl.SSLError, OSError) as error:
        return _refused(endpoint, error, tls)
    try:
        with secure:
            secure.settimeout(0.5)  # a router that requires a certificate reports that only after the handshake
            secure.recv(1)
    except TimeoutError:
        return ""
    except (ssl.SSLError, OSError) as error:
        return _refused(endpoint, error, tls)
    return ""


def _refused(endpoint: str, error: Exception, tls: Tls) -> str:
    reason = str(getattr(error, "reason", None) or error)
    if "CERTIFICATE" in reason or "UNKNOWN_CA" in reason:
        hint = "give --tls-certificate, --tls-key"
        if tls.certificate:
            hint = (
                f"is {tls.certificate} signed by the authority that the router asks for, in date, and of X.509 "
                "version 3 (which openssl makes with -extfile)?"
            )
        return f"{endpoint}: the router refuses this side's certificate ({reason}): {hint}"
    return f"{endpoint}: no TLS there ({reason}): is it a router for tcp/?"
