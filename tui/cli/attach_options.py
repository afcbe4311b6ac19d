"""The options of `bot-console attach`."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from dataclasses import dataclass

from bot_console.runtime.rmw.zenoh.network.client import CONFIG_VARIABLE, ClientConfig
from bot_console.runtime.rmw.zenoh.network.reachability import Tls, place_of
from bot_console.tui.cli.arguments import Options, attach_parser, parse_attach
from bot_console.tui.session.embedded.domain import CONNECT_VARIABLE

EPILOG = """\
Which system:
  Without an option, attach shows what runs on this machine: a system of bot-console, or that of the sourced ROS 2. If
  there are both, it lists them and asks (without a terminal it ends with exit code 2).

examples:
  bot-console attach                             what runs on this machine
  bot-console attach --ros                       the ROS 2 that is sourced, whatever its middleware
  bot-console attach --connect tcp/robot:7447    a robot with rmw_zenoh, from a machine without ROS
  bot-console attach --connect tls/robot:7447 --tls-ca ca.pem --tls-certificate me.pem --tls-key me.key
"""


@dataclass(frozen=True)
class AttachOptions:
    """The parsed options: one of the three ways to attach, or none."""

    appearance: Options
    """The options that every console has."""
    network: ClientConfig | None = None
    """The route to a robot on the network; None if none was given."""
    ros: bool = False
    embedded: bool = False


def add_network_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for reaching a router; see `network_config`."""
    add = parser.add_argument
    add(
        "--connect",
        action="append",
        nargs="?",
        const="",
        metavar="ENDPOINT",
        help=f"a robot's Zenoh router, such as tcp/robot:7447 (default: the one that {CONFIG_VARIABLE} names)",
    )
    add(
        "--tls-ca",
        default="",
        metavar="FILE",
        help="certificate of the authority that signed the router's certificate",
    )
    add("--tls-certificate", default="", metavar="FILE", help="certificate to present (mutual TLS)")
    add("--tls-key", default="", metavar="FILE", help="its private key")
    add("--tls-any-name", action="store_true", help="accept a certificate for another host name")


def network_config(parser: argparse.ArgumentParser, given: argparse.Namespace) -> ClientConfig | None:
    """The route to a router, from an option or the environment; exits if a text is not an endpoint."""
    asked: list[str] | None = given.connect
    if asked is None:
        from_environment = os.environ.get(CONNECT_VARIABLE, "")
        asked = from_environment.split() or None
    tls = Tls(given.tls_ca, given.tls_certificate, given.tls_key, given.tls_any_name)
    if asked is None:
        if tls != Tls():
            parser.error("the --tls-... options need --connect")
        return None
    endpoints = tuple(filter(None, asked))
    if not endpoints and not os.environ.get(CONFIG_VARIABLE):
        parser.error(f"--connect without an endpoint needs {CONFIG_VARIABLE}, which names a Zenoh configuration")
    for each in endpoints:
        try:
            place_of(each)
        except ValueError as error:
            parser.error(str(error))
    if problem := tls.problem():
        parser.error(problem)
    return ClientConfig(endpoints, tls)


def parse(words: Sequence[str]) -> AttachOptions:
    """Parse the arguments of `attach`; exits with code 2 for wrong usage."""
    parser = attach_parser()
    parser.epilog = EPILOG
    add_network_options(parser)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--ros", action="store_true", help="attach to the ROS 2 of this machine, through its own rclpy")
    which.add_argument(
        "--embedded", action="store_true", help="attach to a bot-console system, even if ROS 2 is installed"
    )
    appearance, given = parse_attach(words, parser)
    config = None if given.ros or given.embedded else network_config(parser, given)
    if given.connect is not None and config is None:
        parser.error("--connect, --ros and --embedded exclude each other")
    appearance.reached_by = " ".join(config.endpoints) if config else ""
    return AttachOptions(appearance, config, given.ros, given.embedded)
