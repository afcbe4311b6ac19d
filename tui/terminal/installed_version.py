"""The version of an installed package, without `importlib.metadata`, whose imports take a tenth of the first frame."""

from __future__ import annotations

import importlib
import os
import re


def installed_version(package: str) -> str:
    """The version of an importable package with that name; raises `PackageNotFoundError` if it has none.

    Installers write it into the name of a folder beside the package (PEP 376 and 427).
    """
    place = importlib.import_module(package).__file__ or ""
    named = re.compile(rf"{re.escape(package)}-([^-]+)\.dist-info")
    try:
        beside = os.listdir(os.path.dirname(os.path.dirname(place)))
    except OSError:  # for example in an archive
        beside = []
    found = [match[1] for each in beside if (match := named.fullmatch(each))]
    if len(found) == 1:
        return found[0]
    from importlib.metadata import version

    return version(package)
