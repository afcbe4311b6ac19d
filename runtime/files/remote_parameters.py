"""Parameter files on a server: downloaded over `https://`, cached, and read from the cache while the server is
unreachable.

A server on this machine may use plain `http://`, since nobody can intercept it.
"""

from __future__ import annotations

import hashlib
import http.client
import ipaddress
import json
import os
import secrets
import ssl
import sys
import time
import urllib.error
import urllib.parse
import urllib.request
from email.message import Message
from pathlib import Path
from typing import IO, Any

import yaml
from bot_console.runtime.files.user_folders import cache_folder

SCHEME = "https://"
MAX_FILE_BYTES = 1_000_000
"""Maximum size of a parameter file in bytes."""
SILENCE_TIMEOUT_S = 5.0
"""Time (s) without data after which a server counts as unreachable."""
FETCH_TIMEOUT_S = 15.0
"""The time limit (s) for a whole download."""
READ_BYTES = 65_536
"""How many bytes are read at once."""


class RemoteError(OSError):
    """A parameter file cannot be fetched from a server; the message says why."""


def local_copy(address: str) -> Path:
    """Return the path of the current file at an address or, with a WARN on stderr, of the copy that was fetched last.

    The server's certificate is verified, with `SSL_CERT_FILE` if that is set. Only valid YAML is cached. Raises
    `RemoteError` for `http://` from another machine and for invalid certificates, because anyone on the network could
    have written the file; for an answer that is not a parameter file; and for an unreachable server if there is no
    cached copy.
    """
    _check(address)
    kept = _CachedCopy(address)
    try:
        answer = _download(address, kept.tag)
    except _UnreachableError as error:
        if not kept.path.is_file():
            raise RemoteError(f"{address} is out of reach ({error}), and there is no copy of it here") from None
        age = _age(time.time() - kept.path.stat().st_mtime)
        print(
            f"[WARN] [bot-console]: {address} is out of reach ({error}); its copy of {age} ago is used: {kept.path}",
            file=sys.stderr,
        )
        return kept.path
    if answer is None:
        kept.path.touch()  # the file's time shows the age of the copy
    else:
        _check_yaml(address, answer[0])
        kept.keep(*answer)
    return kept.path


class _UnreachableError(Exception):
    """The server did not answer, or answered that it is unavailable now."""


class _CachedCopy:
    """The cached copy of one address, if there is one: the text, and beside it the server's ETag."""

    def __init__(self, address: str) -> None:
        name = hashlib.blake2b(address.encode(), digest_size=12).hexdigest()
        self._folder = cache_folder() / "parameters"
        self._address = address
        self.path = self._folder / f"{name}.yaml"
        self._about = self._folder / f"{name}.json"

    @property
    def tag(self) -> str:
        """Return the ETag of the cached copy; empty if there is none, or if the two files do not belong together."""
        try:
            about: Any = json.loads(self._about.read_bytes())
            fits = about["digest"] == _digest(self.path.read_bytes()) and about["address"] == self._address
            return str(about["tag"]) if fits else ""
        except (OSError, ValueError, KeyError, TypeError, RecursionError):
            return ""

    def keep(self, content: bytes, tag: str) -> None:
        about = {"address": self._address, "tag": tag, "digest": _digest(content)}
        try:
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            _replace(self.path, content)
            _replace(self._about, json.dumps(about).encode())
        except OSError as error:
            raise RemoteError(f"{self._address}: its copy {self.path} cannot be written: {error.strerror}") from None


def _digest(content: bytes) -> str:
    return hashlib.blake2b(content, digest_size=16).hexdigest()


def _replace(path: Path, content: bytes) -> None:
    temporary = path.with_name(f"{path.name}.{secrets.token_hex(4)}")
    try:
        with open(temporary, "xb", opener=lambda name, flags: os.open(name, flags, 0o600)) as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise


def _check(address: str) -> None:
    wrong = f"{address} is not a valid address; write for instance https://host/robot.yaml"
    try:
        parts = urllib.parse.urlsplit(address)
        fits = bool(parts.hostname) and parts.port != 0
    except ValueError:
        raise RemoteError(wrong) from None
    if parts.username or parts.password:
        raise RemoteError("a password in an address would appear in logs and process lists; it is not accepted")
    if not address.lower().startswith(SCHEME) and not _is_here(address):
        raise RemoteError(
            f"{address}: anyone on the network could change a file sent by http; give an https:// address "
            "(http:// is for a server on this machine: 127.0.0.1, [::1] or localhost)"
        )
    if not fits or not address.isascii() or any(character <= " " for character in address):
        raise RemoteError(wrong)


def _is_here(address: str) -> bool:
    """Whether an address is on this machine and without TLS."""
    try:
        parts = urllib.parse.urlsplit(address)
        host = parts.hostname or ""
        return parts.scheme == "http" and (host == "localhost" or ipaddress.ip_address(host).is_loopback)
    except ValueError:  # a host name, or not an address
        return False


class _SafeRedirects(urllib.request.HTTPRedirectHandler):
    """Follows redirects, but never from TLS to plain HTTP, and without TLS only on this machine."""

    def redirect_request(
        self, req: urllib.request.Request, fp: IO[bytes], code: int, msg: str, headers: Message, newurl: str
    ) -> urllib.request.Request | None:
        if not newurl.lower().startswith(SCHEME) and not (_is_here(req.full_url) and _is_here(newurl)):
            raise RemoteError(f"{req.full_url} redirects to {newurl}, which is not https: not followed")
        return super().redirect_request(req, fp, code, msg, headers, newurl)  # type: ignore[arg-type] -- as typeshed has it in some versions


def _download(address: str, tag: str) -> tuple[bytes, str] | None:
    """Return content and ETag; None if the file is unchanged."""
    request = urllib.request.Request(address, headers={"User-Agent": "bot-console", "Accept-Encoding": "identity"})
    if tag:
        request.add_header("If-None-Match", tag)
    try:
        handlers = [urllib.request.HTTPSHandler(context=ssl.create_default_context()), _SafeRedirects()]
        if _is_here(address):
            handlers.append(urllib.request.ProxyHandler({}))  # a proxy would be in between, and not on this machine
        with urllib.request.build_opener(*handlers).open(request, timeout=SILENCE_TIMEOUT_S) as answer:
            return _read_body(address, answer), answer.headers.get("ETag", "")
    except urllib.error.HTTPError as error:
        with error:
            if error.code == http.client.NOT_MODIFIED and tag:
                return None
            if error.code >= http.client.INTERNAL_SERVER_ERROR or error.code == http.client.TOO_MANY_REQUESTS:
                raise _UnreachableError(f"it answers {error.code} {error.reason}") from None
            raise RemoteError(f"{address}: the server answers {error.code} {error.reason}") from None
    except RemoteError:
        raise
    except (OSError, http.client.HTTPException) as error:
        why = getattr(error, "reason", None) or error
        if isinstance(why, ssl.SSLCertVerificationError):
            raise RemoteError(
                f"{address}: its certificate is not trusted: {why.verify_message}; "
                "SSL_CERT_FILE names the file of an authority of your own"
            ) from None
        raise _UnreachableError(_words(why)) from None


def _read_body(address: str, answer: Any) -> bytes:
    """Return the body, within the limits of size and time."""
    end = time.monotonic() + FETCH_TIMEOUT_S
    content = b""
    while piece := answer.read1(READ_BYTES):
        content += piece
        if len(content) > MAX_FILE_BYTES:
            raise RemoteError(f"{address} is larger than {MAX_FILE_BYTES // 1000} kB, which no parameter file is")
        if time.monotonic() > end:
            raise _UnreachableError(f"it took more than {FETCH_TIMEOUT_S:g} s")
    if answer.length:
        raise _UnreachableError("it broke off")
    return content


def _check_yaml(address: str, content: bytes) -> None:
    """Raise `RemoteError` for invalid YAML. Only its events are read; no objects are constructed from it."""
    loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        for _ in yaml.parse(content.decode("utf-8-sig"), Loader=loader):
            pass
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        line = getattr(getattr(error, "problem_mark", None), "line", None)
        where = f", line {line + 1}" if line is not None else ""
        raise RemoteError(f"{address} is not valid YAML{where}; the previous copy was kept") from None


def _words(why: object) -> str:
    if isinstance(why, TimeoutError):
        return f"silent for {SILENCE_TIMEOUT_S:g} s"
    return str(getattr(why, "strerror", None) or why).lower()


def _age(seconds: float) -> str:
    for size, name in ((86_400, "days"), (3_600, "hours"), (60, "minutes")):
        if seconds >= 2 * size:
            return f"{int(seconds // size)} {name}"
    return f"{max(0, int(seconds))} s"
