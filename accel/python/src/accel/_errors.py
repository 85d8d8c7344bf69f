# SPDX-License-Identifier: Apache-2.0
"""The library's statuses as exceptions; their text is the library's."""
from . import _library as c


class Error(Exception):
    """What the library refused."""


class ArgumentError(Error, ValueError):
    pass


class ConfigError(Error, ValueError):
    pass


class MemoryLimitError(Error, MemoryError):
    pass


class TooLargeError(Error, ValueError):
    pass


class Cancelled(Error):
    pass


class BrokenError(Error):
    pass


_CLASSES = {c.BAD_ARGUMENT: ArgumentError, c.BAD_CONFIG: ConfigError,
            c.NO_MEMORY: MemoryLimitError, c.TOO_LARGE: TooLargeError, c.CANCELLED: Cancelled,
            c.BROKEN: BrokenError}


def check(status, error):
    if status != c.OK:
        raise _CLASSES.get(status, Error)(error.text.decode("utf-8", "replace"))
