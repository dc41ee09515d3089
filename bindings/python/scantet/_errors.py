"""What scantet raises."""
import re


class Error(Exception):
    """A failure that the caller can do something about.

    code: stable, for programs ("input.nan"). remedy: what to do about it, a clause; may be empty. str() of the error
    names the place and the value, and ends with the remedy.
    """

    def __init__(self, text, code="", remedy=""):
        super().__init__(text)
        self.code = code
        self.remedy = remedy

    def __str__(self):
        return str(self.args[0]) if self.args else ""

    def __reduce__(self):
        return type(self), (str(self), self.code, self.remedy)


class UsageError(Error, ValueError):
    """An option or argument is wrong (the command's exit status 2)."""


class UnknownOptionError(UsageError, TypeError):
    """There is no option of that name; the text has the nearest one."""


class InputError(Error, ValueError):
    """A file or an array cannot be read or makes no sense (exit status 3)."""


class OutputError(Error, OSError):
    """A file cannot be written (exit status 5)."""


class BudgetError(Error):
    """max_time or max_memory was used up before there was a mesh (exit status 4, with nothing written)."""


class InternalError(Error, RuntimeError):
    """A fault of scantet, or of a plugin (exit status 1)."""


class UnmetWarning(UserWarning):
    """A bound that was asked for is not kept by the mesh, or the audit found a fault (exit status 4)."""


OF_FAULT = {1: InternalError, 2: UsageError, 3: InputError, 5: OutputError}


def in_keywords(text):
    """Options are called as Python calls them: --min-dihedral is min_dihedral."""
    return re.sub(r"(?<![\w-])--([a-z][a-z0-9-]*[a-z0-9])", lambda found: found.group(1).replace("-", "_"), text)


def error_of(fault, code, text, remedy):
    """The exception for an error of the library; called by the module _scantet."""
    kind = UnknownOptionError if code == "usage.unknown_option" else OF_FAULT.get(fault, InternalError)
    return kind(in_keywords(text), code, in_keywords(remedy))
