"""Packages in source form, found by their `package.xml` and read without building or running anything."""

from bot_console.runtime.workspace.discover import Workspace, workspace
from bot_console.runtime.workspace.package import EntryPoint, Package

__all__ = ["EntryPoint", "Package", "Workspace", "workspace"]
