"""Certificates generated on demand with the machine's `openssl`."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

KEY = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")


@dataclass(frozen=True)
class Certificates:
    """The paths of an authority, and of a certificate for `localhost` signed by it."""

    ca: str
    certificate: str
    key: str


def make_certificates(folder: Path, name: str = "robot") -> Certificates:
    """Make a new authority and a certificate."""
    if not shutil.which("openssl"):
        pytest.skip("needs openssl to make certificates")
    place = folder / name
    place.mkdir()
    (place / "names").write_text("subjectAltName=DNS:localhost,IP:127.0.0.1\n")
    _openssl(
        place, "req", "-x509", *KEY, "-keyout", "ca.key", "-out", "ca.pem", "-days", "2", "-subj", f"/CN={name}-ca"
    )
    _openssl(place, "req", *KEY, "-keyout", "own.key", "-out", "own.csr", "-subj", f"/CN={name}")
    sign = ("x509", "-req", "-in", "own.csr", "-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial")
    _openssl(place, *sign, "-out", "own.pem", "-days", "2", "-extfile", "names")
    return Certificates(*(str(place / each) for each in ("ca.pem", "own.pem", "own.key")))


def _openssl(place: Path, *words: str) -> None:
    subprocess.run(["openssl", *words], cwd=place, check=True, capture_output=True)
