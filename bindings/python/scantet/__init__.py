"""Tetrahedral meshes from medical scans. docs/python.md explains it; __init__.pyi says what each call takes."""
from . import _scantet
from ._calls import Verification, info, mesh, options, read, read_mesh, verify
from ._domain import Domain
from ._errors import (BudgetError, Error, InputError, InternalError, OutputError, UnknownOptionError, UnmetWarning,
                      UsageError)
from ._images import scan
from ._mesh import Mesh, Page
from ._scantet import Scan

__version__ = _scantet.version
__all__ = ["BudgetError", "Domain", "Error", "InputError", "InternalError", "Mesh", "OutputError", "Page", "Scan",
           "UnknownOptionError", "UnmetWarning", "UsageError", "Verification", "info", "mesh", "options", "read",
           "read_mesh", "scan", "verify"]
