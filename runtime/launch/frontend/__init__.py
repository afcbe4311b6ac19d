"""Launch files in XML and YAML: the common part of their parsers."""

from launch.frontend.entity import Entity
from launch.frontend.expose import expose_action, expose_substitution
from launch.frontend.parser import InvalidFrontendLaunchFileError, Parser

__all__ = ["Entity", "InvalidFrontendLaunchFileError", "Parser", "expose_action", "expose_substitution"]
