"""Type variables by which upstream's annotations, and those of programs, speak of interfaces."""

from __future__ import annotations

from typing import TypeVar

MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")
