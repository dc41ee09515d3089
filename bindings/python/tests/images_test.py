"""Images of other libraries, and where their voxels lie."""
import gc
import sys
import types
import weakref

import numpy as np
import pytest
import scantet

AFFINE = np.array([[0.0, -2.0, 0.0, 30.0], [1.5, 0.0, 0.0, -20.0], [0.0, 0.0, 1.0, 7.0], [0, 0, 0, 1]])
VALUES = np.arange(3 * 4 * 5, dtype=np.int16).reshape(3, 4, 5)


def check(scan, affine=AFFINE):
    assert np.array_equal(scan.values, VALUES)
    assert np.allclose(scan.affine, affine, rtol=0, atol=1e-12)


def test_arrays():
    check(scantet.scan(VALUES, AFFINE))
    turned = np.diag([-1.0, -1, 1, 1]) @ AFFINE
    check(scantet.scan(VALUES, turned, axes="lps"))
    plain = scantet.scan(VALUES)
    assert np.array_equal(plain.affine, np.diag([-1.0, -1, 1, 1]))  # voxels are LPS coordinates
    fortran = np.asfortranarray(VALUES)
    assert np.shares_memory(scantet.scan(fortran).values, fortran)
    for kind in ("int8", "uint8", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64"):
        assert scantet.scan(VALUES.astype(kind)).values.dtype == kind
    assert scantet.scan(VALUES > 7).pixel_type == "uint8"
    assert np.array_equal(scantet.scan(VALUES.astype(">i2")).values, VALUES)
    for wrong in (VALUES[0], VALUES.astype(complex), np.zeros((3, 3, 3))):
        with pytest.raises(scantet.InputError) as caught:
            scantet.scan(wrong)
        assert caught.value.remedy
    with pytest.raises(scantet.InputError, match="4 dimensions") as caught:
        scantet.scan(np.zeros((3, 4, 5, 6)))
    assert caught.value.code == "input.dimension" and "array[..., 0]" in caught.value.remedy
    for act, code in ((lambda: scantet.scan(VALUES, np.eye(3)), "usage.affine"), (lambda: scantet.scan(object()), "usage.image"),
                      (lambda: scantet.scan(VALUES, np.zeros((4, 4))), "usage.affine"), (lambda: scantet.scan(VALUES, "eye"), "usage.affine"),
                      (lambda: scantet.scan(VALUES, np.eye(4), axes="lsp"), "usage.axes")):
        with pytest.raises(scantet.UsageError) as caught:
            act()
        assert caught.value.code == code and caught.value.remedy


def test_nibabel(samples, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    check(scantet.scan(nibabel.Nifti1Image(VALUES, AFFINE)))
    for name in ("islands.nii.gz", "ellipsoid_flipped.nii.gz"):
        read = scantet.read(samples / name)
        scan = scantet.scan(nibabel.load(samples / name))
        assert scan.values.dtype == read.values.dtype
        assert np.array_equal(scan.values, read.values)
        assert np.allclose(scan.affine, read.affine, rtol=1e-6, atol=1e-6)


def test_vtk():
    model = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    from vtkmodules.util.numpy_support import numpy_to_vtk
    image = model.vtkImageData()
    image.SetDimensions(VALUES.shape)
    image.SetSpacing(1.5, 2, 1)
    image.SetOrigin(-30, 20, 7)
    image.SetDirectionMatrix(0, 1, 0, -1, 0, 0, 0, 0, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(VALUES.ravel(order="F"), deep=True))
    check(scantet.scan(image))
    image.SetOrigin(30, -20, 7)
    image.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    check(scantet.scan(image, axes="ras"))


class ItkLike:
    """What SimpleITK's and ITK's images have in common, here of the same scan in LPS."""

    def GetSpacing(self):
        return (1.5, 2.0, 1.0)

    def GetOrigin(self):
        return (-30.0, 20.0, 7.0)

    def GetDirection(self):
        return (0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def test_simple_itk(monkeypatch):
    """Debian has no SimpleITK: a stand-in answers as it does."""
    class Image(ItkLike):
        def GetPixelIDValue(self):
            return 2
    monkeypatch.setitem(sys.modules, "SimpleITK", types.SimpleNamespace(
        GetArrayViewFromImage=lambda image: np.ascontiguousarray(VALUES.T)))
    check(scantet.scan(Image()))
    image = Image()
    seen = weakref.ref(image)
    scan = scantet.scan(image)
    del image
    gc.collect()
    assert seen() is not None  # the view is of its memory
    del scan
    gc.collect()
    assert seen() is None


def test_itk(monkeypatch):
    """As ITK's own Python package, which Debian has not, either."""
    class Region:
        def GetIndex(self):
            return (1, 0, 0)

    class Image(ItkLike):
        def GetOrigin(self):
            return (-30.0, 21.5, 7.0)  # of index (0, 0, 0); the region begins at (1, 0, 0)

        def GetLargestPossibleRegion(self):
            return Region()

        GetBufferedRegion = GetLargestPossibleRegion
    monkeypatch.setitem(sys.modules, "itk", types.SimpleNamespace(
        array_view_from_image=lambda image: np.ascontiguousarray(VALUES.T),
        array_from_matrix=lambda matrix: np.array(matrix).reshape(3, 3)))
    check(scantet.scan(Image()))


def test_tissues_in_memory():
    grid = np.mgrid[-6:7, -6:7, -6:7].astype(float)
    r = np.sqrt((grid**2).sum(axis=0))
    inner, outer = (r < 3).astype(np.float32), ((r >= 3) & (r < 5)).astype(np.float32)
    mesh = scantet.mesh(inner, tissue=[outer], size=2)
    assert set(mesh.region_names) == {1, 2}
