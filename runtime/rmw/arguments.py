"""Parse the ROS part of a command line: `--ros-args ... [--]`. The grammar and the error messages are rcl's.

Arguments outside that part belong to the program; a remap rule among them is applied and recorded as deprecated.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from bot_console.runtime.programs.hints import assignment, did_you_mean
from bot_console.runtime.rmw.lexer import GrammarError, Lexeme, Lexer
from bot_console.runtime.rmw.parameter_precedence import ParameterTable, ParameterYamlError
from bot_console.runtime.rmw.remapping import RemapRule, parse_rule

START = "--ros-args"
END = "--"
SEVERITIES = {"UNSET": 0, "DEBUG": 10, "INFO": 20, "WARN": 30, "ERROR": 40, "FATAL": 50}


class ArgumentsError(ValueError):
    """A command line cannot be parsed; the message has rcl's wording. `hint` adds how to fix it.

    `warning` is what rcl logs before the error, if anything.
    """

    def __init__(self, text: str, hint: str = "", warning: str = "") -> None:
        super().__init__(text)
        self.hint = hint
        self.warning = warning


class Arguments:
    """The parsed ROS arguments of a command line."""

    def __init__(self) -> None:
        self.remap_rules: list[RemapRule] = []
        self.parameters = ParameterTable()
        """Values of `-p` and `--params-file`, in command line order."""
        self.unparsed: list[str] = []
        """The arguments for the program itself."""
        self.unknown_ros_args: list[str] = []
        self.deprecated_rules: list[str] = []
        """Remap rules outside the ROS part."""
        self.default_level: int | None = None
        self.logger_levels: dict[str, int] = {}
        self.log_config_file: str | None = None
        self.log_file_name: str | None = None
        self.enclave: str | None = None
        self.stdout_enabled = True
        self.rosout_enabled = True
        self.external_logs_enabled = True


def parse(words: Sequence[str]) -> Arguments:
    """Parse a command line; raises `ArgumentsError`, or `TypeError` if it is not a sequence of strings."""
    parsed = Arguments()
    inside = False
    rest = iter(list(words))
    for word in rest:
        if not isinstance(word, str):  # pyright: ignore[reportUnnecessaryIsInstance] -- programs pass what they like
            raise TypeError(f"expected str instance, {type(word).__name__} found")
        if word == START:
            inside = True
        elif inside and word == END:
            inside = False
        elif inside:
            _parse_flag(word, rest, parsed)
        else:
            _parse_outside(word, parsed)
    return parsed


def _parse_outside(word: str, parsed: Arguments) -> None:
    try:
        rule = parse_rule(word)
    except GrammarError:
        parsed.unparsed.append(word)
        return
    parsed.remap_rules.append(rule)
    parsed.deprecated_rules.append(word)


def suggest_argument(word: str) -> str:
    """Suggest the ROS argument that a mistyped one may mean, as a sentence; empty if none is similar."""
    near = did_you_mean(word, [*_VALUED, *_SWITCHES])
    return f"{word} is not a ROS argument{near}" if near else ""


def _parse_flag(word: str, rest: Iterable[str], parsed: Arguments) -> None:
    if word in _VALUED:
        handler, missing = _VALUED[word]
        for value in rest:
            handler(word, value, parsed)
            return
        raise ArgumentsError(missing.format(word))
    if word in _SWITCHES:
        setattr(parsed, *_SWITCHES[word])
    else:
        parsed.unknown_ros_args.append(word)


def _parameter(word: str, value: str, parsed: Arguments) -> None:
    lexer = Lexer(value)
    try:
        node = lexer.node_prefix() or "/**"
        name = _parameter_name(lexer)
        lexer.expect(Lexeme.SEPARATOR)
        parsed.parameters.add_value(node, name, value[lexer.index :])
    except (GrammarError, ParameterYamlError) as error:
        text = f"Couldn't parse parameter override rule: '{word} {value}'. Error: {error}"
        raise ArgumentsError(text, assignment(word, value)) from None


def _parameter_name(lexer: Lexer) -> str:
    """Consume dot-separated parts, each made of tokens and slashes in any order, and return the name."""
    start = lexer.index
    _parameter_name_part(lexer)
    while lexer.peek() != Lexeme.SEPARATOR:
        lexer.expect(Lexeme.DOT)
        _parameter_name_part(lexer)
    return lexer.text[start : lexer.index]


def _parameter_name_part(lexer: Lexer) -> None:
    if lexer.peek() != Lexeme.FORWARD_SLASH:
        lexer.match_token()
    while lexer.peek() in (Lexeme.TOKEN, Lexeme.FORWARD_SLASH):
        lexer.accept()


def _parameters_file(word: str, value: str, parsed: Arguments) -> None:
    try:
        parsed.parameters.add_file(value)
    except ParameterYamlError as error:
        raise ArgumentsError(f"Couldn't parse params file: '{word} {value}'. Error: {error}", error.hint) from None


def _remap(word: str, value: str, parsed: Arguments) -> None:
    try:
        parsed.remap_rules.append(parse_rule(value))
    except GrammarError as error:
        text = f"Couldn't parse remap rule: '{word} {value}'. Error: {error}"
        raise ArgumentsError(text, warning=error.warning) from None


def _log_level(word: str, value: str, parsed: Arguments) -> None:
    logger, separator, _ = value.partition(":=")
    try:
        if separator:
            parsed.logger_levels[logger] = _severity(_level_token(value, logger))
        else:
            parsed.default_level = _severity(value)
    except GrammarError as error:
        raise ArgumentsError(f"Couldn't parse log level: '{word} {value}'. Error: {error}") from None


def _level_token(value: str, logger: str) -> str:
    if not logger:
        raise GrammarError("Argument has an invalid logger item that name is empty")
    lexer = Lexer(value)
    lexer.index = len(logger)
    lexer.expect(Lexeme.SEPARATOR)
    level = lexer.expect(Lexeme.TOKEN)
    lexer.expect(Lexeme.EOF)
    return level


def _severity(level: str) -> int:
    if level.upper() not in SEVERITIES:
        raise GrammarError("Argument does not use a valid severity level")
    return SEVERITIES[level.upper()]


def _log_config_file(word: str, value: str, parsed: Arguments) -> None:
    parsed.log_config_file = value


def _log_file_name(word: str, value: str, parsed: Arguments) -> None:
    parsed.log_file_name = value


def _enclave(word: str, value: str, parsed: Arguments) -> None:
    parsed.enclave = value


_MISSING_PARAMETER = "Couldn't parse trailing {} flag. No parameter override rule found."
_MISSING_REMAP = "Couldn't parse trailing {} flag. No remap rule found."
_MISSING_ENCLAVE = "Couldn't parse trailing {} flag. No enclave path provided."

_VALUED = {
    "-p": (_parameter, _MISSING_PARAMETER),
    "--param": (_parameter, _MISSING_PARAMETER),
    "--params-file": (_parameters_file, "Couldn't parse trailing {} flag. No file path provided."),
    "-r": (_remap, _MISSING_REMAP),
    "--remap": (_remap, _MISSING_REMAP),
    "--log-level": (_log_level, "Couldn't parse trailing log level flag: '{}'. No log level provided."),
    "--log-config-file": (_log_config_file, "Couldn't parse trailing {} flag. No file path provided."),
    "--log-file-name": (_log_file_name, "Couldn't parse trailing {} flag. No string prefix provided."),
    "-e": (_enclave, _MISSING_ENCLAVE),
    "--enclave": (_enclave, _MISSING_ENCLAVE),
}

_SWITCHES = {
    f"--{verb}-{what}-logs": (attribute, verb == "enable")
    for verb in ("enable", "disable")
    for what, attribute in (
        ("stdout", "stdout_enabled"),
        ("rosout", "rosout_enabled"),
        ("external-lib", "external_logs_enabled"),
    )
}
