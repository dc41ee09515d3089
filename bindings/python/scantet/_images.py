"""Images of other libraries as scans. None of these libraries is imported unless an image of it is given."""
import numpy as np

from . import _scantet
from ._errors import InputError, UsageError

TO_OTHER_SPACE = np.array([[-1.0], [-1.0], [1.0]])  # LPS to RAS and back: x and y are negated
MM_OF_UNIT = {"meter": 1000.0, "mm": 1.0, "micron": 0.001, "unknown": 1.0}


def frame_of(affine, axes):
    """(3, 4), index to LPS in mm, of a 4x4 or 3x4 matrix whose world axes are `axes`."""
    try:
        matrix = np.asarray(affine, dtype=float)
    except (TypeError, ValueError):
        raise UsageError("affine: it is no matrix of numbers", "usage.affine",
                         "give one of shape (4, 4), index to world") from None
    if matrix.shape not in ((4, 4), (3, 4)):
        raise UsageError(f"affine: a matrix of shape {matrix.shape} is no affine map; give one of shape (4, 4), index "
                         "to world", "usage.affine", "give one of shape (4, 4), index to world")
    if matrix.shape == (4, 4) and not np.array_equal(matrix[3], [0, 0, 0, 1]):
        raise UsageError("affine: its last row is not 0 0 0 1", "usage.affine",
                         "give an affine map, index to world")
    if axes not in ("ras", "lps"):
        raise UsageError(f'axes: "{axes}" is not "ras" or "lps"', "usage.axes", 'give "ras" or "lps"')
    return matrix[:3] * TO_OTHER_SPACE if axes == "ras" else matrix[:3].copy()


def voxels_of(values):
    """The values in an order and type that scans have; the same array if it has these already."""
    array = np.asarray(values)
    if array.ndim == 4 and array.shape[3] == 1:
        array = array[..., 0]
    if array.ndim != 3:
        raise InputError(f"the array has {array.ndim} dimensions; a scan has 3", "input.dimension",
                         "give one volume, such as array[..., 0]" if array.ndim > 3 else "stack the slices: np.stack")
    if array.dtype == bool:
        array = array.astype(np.uint8)
    if array.dtype == np.float16:
        array = array.astype(np.float32)
    if not array.dtype.isnative:
        array = array.astype(array.dtype.newbyteorder("="))
    return np.asfortranarray(array)


def scan_of(values, frame, name, keeper=None):
    """keeper: what the values' memory belongs to, where they do not say so themselves."""
    return _scantet.scan_from_array(voxels_of(values), np.ascontiguousarray(frame), name, keeper)


def of_nibabel(image):
    """In the type that scantet reads from the file: as stored; rescaled 8- and 16-bit numbers as float."""
    values = np.asanyarray(image.dataobj)
    stored = image.get_data_dtype()
    if values.dtype != stored and stored.kind in "iu" and stored.itemsize <= 2:
        values = values.astype(np.float32)
    unit = image.header.get_xyzt_units()[0] if hasattr(image.header, "get_xyzt_units") else "mm"
    frame = frame_of(image.affine, "ras") * MM_OF_UNIT.get(unit, 1.0)
    return scan_of(values, frame, "nibabel image")


def lps_frame(spacing, direction, origin):
    """Of ITK's three, direction as a matrix."""
    columns = np.asarray(direction, dtype=float).reshape(3, 3) * np.asarray(spacing, dtype=float)
    return np.column_stack([columns, np.asarray(origin, dtype=float)])


def of_simple_itk(image):
    import SimpleITK
    values = SimpleITK.GetArrayViewFromImage(image)
    frame = lps_frame(image.GetSpacing(), image.GetDirection(), image.GetOrigin())
    return scan_of(values.T, frame, "SimpleITK image", image)  # the view does not keep it


def of_itk(image):
    import itk
    values = itk.array_view_from_image(image)
    direction = itk.array_from_matrix(image.GetDirection())
    frame = lps_frame(list(image.GetSpacing()), direction, list(image.GetOrigin()))
    start = list(image.GetBufferedRegion().GetIndex())
    frame[:, 3] += frame[:, :3] @ np.asarray(start, dtype=float)
    return scan_of(values.T, frame, "ITK image", image)


def of_vtk(image, axes):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    scalars = image.GetPointData().GetScalars()
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        raise InputError("the VTK image has no active scalars with one value a point", "input.pixel_type",
                         "name them: SetActiveScalars")
    if scalars.GetNumberOfTuples() != np.prod(image.GetDimensions()):
        raise InputError("the VTK image has not one value a point", "input.dimension",
                         "give as many scalars as points")
    matrix = image.GetDirectionMatrix()
    direction = [[matrix.GetElement(row, column) for column in range(3)] for row in range(3)]
    frame = lps_frame(image.GetSpacing(), direction, image.GetOrigin())
    frame[:, 3] += frame[:, :3] @ np.asarray(image.GetExtent()[::2], dtype=float)
    if axes == "ras":
        frame = frame * TO_OTHER_SPACE
    values = vtk_to_numpy(scalars).reshape(image.GetDimensions(), order="F")
    return scan_of(values, frame, "VTK image")


def scan(image, affine=None, axes=None):
    """An image in memory as a Scan; its voxels are shared where their order and type allow it, else copied.

    image, affine, axes: as of mesh(). The array's first index runs fastest in a Scan (Fortran's order), which is how
    nibabel, SimpleITK and VTK have it. Types: 8- to 64-bit integers, float, double; bool becomes uint8.
    Raises InputError: input.dimension, input.pixel_type, input.nan, input.constant, input.frame; UsageError.
    """
    if isinstance(image, _scantet.Scan):
        return image
    if affine is not None:
        return scan_of(image, frame_of(affine, axes or "ras"), "array")
    if hasattr(image, "dataobj") and hasattr(image, "affine"):
        return of_nibabel(image)
    if hasattr(image, "GetPixelIDValue") and hasattr(image, "GetDirection"):
        return of_simple_itk(image)
    if hasattr(image, "GetLargestPossibleRegion") and hasattr(image, "GetDirection"):
        return of_itk(image)
    if hasattr(image, "GetPointData") and hasattr(image, "GetDimensions") and hasattr(image, "GetSpacing"):
        return of_vtk(image, axes or "lps")
    if isinstance(image, np.ndarray) or hasattr(image, "__array__"):
        return scan_of(image, np.eye(4)[:3], "array")
    raise UsageError(f"an object of type {type(image).__name__} is no image that can be meshed", "usage.image",
                     "give a path, an array of NumPy's with an affine, or an image of nibabel, SimpleITK, ITK or VTK")


def is_path(image):
    return isinstance(image, (str, bytes)) or hasattr(image, "__fspath__")


def affine_of(scan):
    """(4, 4): voxel index to world, mm, RAS; what nibabel calls the affine."""
    return np.vstack([scan._frame * TO_OTHER_SPACE, [0.0, 0.0, 0.0, 1.0]])


_scantet.Scan.affine = property(affine_of)
