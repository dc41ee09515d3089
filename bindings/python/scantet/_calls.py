"""The functions of the package: Python's arguments become what the command is given."""
import json
import os
import sys
import warnings

import numpy as np

from . import _images, _scantet
from ._domain import Domain
from ._errors import BudgetError, UnknownOptionError, UnmetWarning, UsageError
from ._mesh import Mesh

IMAGE = "memory:image"
DOMAIN = "python:domain"


def options(plugin=()):
    """Every option of `scantet mesh`, as mesh() takes it.

    plugin: files of further plugins, which may have options of their own. Return: {keyword: declaration}, a declaration
    being a dict of texts: name (on the command line, without dashes), kind (flag, number, integer, choice, text, list,
    numbers; the last two may be given several times), group, metavar, help, limits, unset, and default, a list of texts.
    Raises UsageError (usage.plugin).
    """
    found = {}
    for option in _scantet.mesh_options([os.fsencode(file) for file in listed(plugin)]):
        found.setdefault(option["name"].replace("-", "_"), option)
    return found


def listed(value):
    if value is None:
        return []
    if isinstance(value, (list, tuple, set, range)):
        return list(value)
    if isinstance(value, np.ndarray) and value.ndim == 1:
        return value.tolist()
    return [value]


def as_text(value):
    """One value as it is typed."""
    if value is None:
        return b"none"
    if isinstance(value, (bool, np.bool_)):
        return b"true" if value else b"false"
    if isinstance(value, (int, np.integer)):
        return str(int(value)).encode()
    if isinstance(value, (float, np.floating)):
        return repr(float(value)).encode()
    if hasattr(value, "__fspath__"):
        return os.fsencode(value)
    if isinstance(value, (str, bytes)):
        return os.fsencode(value)
    raise UsageError(f"a value of type {type(value).__name__} is no number and no text", "usage.value",
                     "give a number, a text, True, None, or a list of these")


def typed_values(given, known, caller):
    """(name, text) of every keyword, as on the command line. Raises UnknownOptionError, with the nearest name."""
    typed = []
    for keyword, value in given.items():
        option = known.get(keyword)
        if option is None:
            meant = _scantet.closest_name(keyword, list(known))
            hint = f"; did you mean {meant}?" if meant else ""
            raise UnknownOptionError(f"{caller}() got an unexpected keyword argument '{keyword}'{hint}",
                                     "usage.unknown_option", f"give {meant}" if meant else "scantet.options() has all")
        name, kind = option["name"], option["kind"]
        if kind == "flag":
            if value not in (True, False, None):
                raise UsageError(f"{keyword}: is True or False", "usage.value", "give True or False")
            if value:
                typed.append((name, b"true"))
        elif kind in ("list", "numbers"):
            typed.extend((name, as_text(one)) for one in listed(value))
            if value is None and kind == "numbers":
                typed.append((name, b"none"))
        elif isinstance(value, (list, tuple, set, range, np.ndarray)):
            typed.append((name, b",".join(as_text(one) for one in listed(value))))
        else:
            typed.append((name, as_text(value)))
    return typed


class ProgressLine:
    """One line on standard error, written over."""

    def __init__(self):
        self.width = 0

    def __call__(self, stage, doing, done, total, pending):
        text = f"scantet: {stage} {doing}".rstrip()
        if total:
            text += f" {min(100, 100 * done // total)}%"
        elif done:
            text += f" {done:,}"
        text = text[:78]
        print("\r" + text.ljust(self.width), end="", file=sys.stderr, flush=True)
        self.width = len(text)

    def clear(self):
        if self.width:
            print("\r" + " " * self.width + "\r", end="", file=sys.stderr, flush=True)


def watched(progress, work):
    """Calls work(listener); progress: None, a function of a dict, or True for a line of text."""
    if progress is True:
        line = ProgressLine()
        try:
            return work(line)
        finally:
            line.clear()
    if not progress:
        return work(None)
    names = ("stage", "doing", "done", "total", "pending")
    return work(lambda *state: progress(dict(zip(names, state))))


def opened(image, affine, axes, given):
    """(input, scans in memory, domain, keywords whose images are names now)."""
    given = dict(given)
    scans = {}
    if not _images.is_path(image) and given.get("certify") not in (None, "no"):
        raise UsageError("certify: the scan is read again for it, and is no file here", "usage.certify",
                         "save the scan, and give its path")
    if isinstance(image, Domain):
        return DOMAIN, scans, image, given
    if _images.is_path(image):
        if affine is not None or axes is not None:
            raise UsageError("affine, axes: a file has its own", "usage.affine", "leave them out")
        name = os.fsencode(image)
    else:
        name = IMAGE
        scans[IMAGE] = _images.scan(image, affine, axes)
    tissues = []
    for number, tissue in enumerate(listed(given.get("tissue")), 1):
        if not _images.is_path(tissue):
            scans[f"memory:tissue {number}"] = _images.scan(tissue, affine, axes)
            tissue = f"memory:tissue {number}"
        tissues.append(tissue)
    if tissues:
        given["tissue"] = tissues
    return name, scans, None, given


def mesh(image, *, affine=None, axes=None, progress=None, **given):
    """Meshes an object with tetrahedra: what `scantet mesh` does, with the same bytes.

    image: a path (NRRD, NIfTI, MetaImage, a folder with DICOM, whatever a plugin opens); an array of shape (i, j, k)
        with its affine; an image of nibabel, SimpleITK, ITK, VTK or pyvista; a Scan; a Domain.
    affine: of an array: shape (4, 4), voxel index to world, mm. None: 1 mm voxels, the first at the origin, and the
        vertices come out in voxels.
    axes: world axes of affine, "ras" (nibabel's, the default) or "lps"; of a VTK image "lps" is the default.
    progress: a function that is called with a dict about 20 times a second at most: stage, doing, done, total (or
        None), pending; True: a line of text on standard error. What the function raises ends the run.
    Everything else is an option of the command line, with _ for -: level=300, min_dihedral=12, output="bone.msh". Lists
        stand for what may be given several times (level=[-300, 300]), and for texts with commas (labels=[1, 3]). None
        means "none". options() has all, docs/options.md explains them. Images of `tissue` may be in memory, too.

    Return: a Mesh; with plan=True a dict of what is to be expected. Bounds that are not kept, and faults that the
    audit found, are an UnmetWarning each, and in Mesh.findings.
    Raises UnknownOptionError (a TypeError), UsageError, InputError, OutputError, BudgetError (max_time or max_memory
    ended it before there was a mesh), InternalError, MemoryError; KeyboardInterrupt: nothing is written then.
    """
    plugins = [os.fsencode(file) for file in listed(given.get("plugin"))]
    name, scans, domain, given = opened(image, affine, axes, given)
    typed = typed_values(given, options(given.get("plugin")), "mesh")
    quiet = bool(given.get("quiet"))
    result = watched(None if quiet and progress is True else progress,
                     lambda listener: _scantet.mesh(name, typed, plugins, scans, domain, listener))
    if result.cancelled:
        raise KeyboardInterrupt
    if result.is_plan:
        return json.loads(result.plan_json)
    found = Mesh(result, ras=given.get("space") == "ras")
    if len(found.tets) == 0:
        raise BudgetError("; ".join(found.findings), "limit.budget", "allow more, or choose a larger size")
    for finding in found.findings:
        warnings.warn(UnmetWarning(finding), stacklevel=2)
    return found


def info(image, *, affine=None, axes=None, progress=None, **given):
    """What there is to know of an image before it is meshed: `scantet info --json`.

    image, affine, axes, progress: as of mesh(). Everything else: an option that says how the image is read, as of
    mesh(), such as level, which tells components and cavities there. Return: {section: {key: value}}; lengths in mm.
    Raises as mesh().
    """
    plugins = [os.fsencode(file) for file in listed(given.pop("plugin", None))]
    name, scans, domain, given = opened(image, affine, axes, given)
    if domain is not None:
        raise UsageError("info: a domain in Python has nothing to tell", "usage.image", "give an image")
    typed = typed_values(given, options(plugins), "info")
    text = watched(progress, lambda listener: _scantet.info(name, typed, plugins, scans, listener))
    return json.loads(text)


def read(path, *, progress=None):
    """Reads a scan: NRRD, NIfTI, MetaImage, TIFF, a folder with DICOM. Return: a Scan. Raises InputError."""
    return watched(progress, lambda listener: _scantet.read_scan(os.fsencode(path), listener))


def read_mesh(path, *, progress=None):
    """Reads a mesh file, measures and audits it. Return: a Mesh, in LPS, mm; its report has no scan to compare with.
    Raises InputError, UsageError (usage.format: an extension that is not read)."""
    return Mesh(watched(progress, lambda listener: _scantet.read_mesh(os.fsencode(path), listener)), ras=False)


class Verification:
    """What verify() found.

    grade: "certified", "bounded", "undecided" or "not the scan". is_as_required: whether that is what `require` asks for,
    or better; so is bool() of it. text: for people; str() of it.
    """

    def __init__(self, grade, is_as_required, text):
        self.grade = grade
        self.is_as_required = is_as_required
        self.text = text

    def __bool__(self):
        return self.is_as_required

    def __repr__(self):
        return f"<scantet.Verification: {self.grade}>"

    def __str__(self):
        return self.text


def verify(mesh_file=None, against=None, level=None, *, progress=None, **given):
    """Proves that a mesh file is a scan's level set: `scantet verify` (docs/certificate.md).

    mesh_file, against: paths of a mesh and of the scan, or of a surface, which has no level. level: in the units of the
    voxels; a list for several.
    Everything else is an option of the command: require="bounded", json="bone.cert.json", certificate=….
    Return: a Verification. Raises UnknownOptionError, UsageError, InputError, OutputError.
    """
    given.update({key: value for key, value in (("against", against), ("level", level)) if value is not None})
    known = {option["name"].replace("-", "_"): option for option in _scantet.verify_options()}
    typed = typed_values(given, known, "verify")
    name = b"" if mesh_file is None else os.fsencode(mesh_file)
    return Verification(*watched(progress, lambda listener: _scantet.verify(name, typed, listener)))
