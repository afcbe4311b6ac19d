"""The type variables for interfaces in upstream's annotations, which programs use too."""

from __future__ import annotations

from typing import TypeVar

MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")
