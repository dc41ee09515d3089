// Reads a scan from a file or folder: the one door between image formats and the rest of scantet.
#pragma once

#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// How sure the reader is that it can read `path`, which is as of read_scan(): 100 the content says so, 20 only the
/// name does (of a file that is not there, too), 10 a folder without DICOM images, 0 no. Never throws; reads the
/// headers it needs, no voxels (DICOM: skips over them).
int can_read_scan(const std::string& path);

/// Reads a three-dimensional scalar image.
///
/// path: a file (NRRD, NHDR, NIfTI-1, NIfTI-2, Analyze 7.5, MetaImage, multi-frame DICOM, multi-page TIFF, VTK
/// structured points, GIPL, INRIMAGE), a folder with one DICOM series, or FOLDER:UID to choose among several (UID as
/// the refusal lists it, or any unambiguous beginning of it).
///
/// progress: reported to as stage "read", and polled. may_be_constant: whether one value in all voxels will do.
///
/// Return: voxels in the pixel type of the file, one copy of them. Rescaled NIfTI comes as float (8- and 16-bit
/// integers, and floats) or double, rescaled DICOM in the smallest type that holds the result, slices of different
/// types as double. If progress.cancelled() becomes true: an empty Scan, voxel_count() == 0.
///
/// Frame: LPS, mm, the full affine of the header, unaltered.
///   NIfTI: the sform if sform_code > 0, else the qform if qform_code > 0, else spacing alone (NIfTI-1 methods 3, 2,
///   1). When both are set and differ, the sform wins. Sheared sforms are honoured; xyzt_units (m, mm, µm) become mm.
///   DICOM series: the third column is the step between slice positions, so a tilted gantry comes out as shear.
///   TIFF: the physical sizes of OME-TIFF, else resolution tags and ImageJ's "spacing"; 1 mm where the file says
///   nothing, as a plain stack says nothing of the distance of its slices.
///   VTK, GIPL: as stored. INRIMAGE: spacing and offset; a rotation is refused.
///
/// Segmentations: segments of 3D Slicer (.seg.nrrd) and of DICOM (a SEG object of kind BINARY or LABELMAP) come as one
/// label map, those of several layers merged, as uint16, or int32 if a label needs it: a voxel in several is in the
/// last of them, and Scan::overlapping counts such voxels. Scan::segments has their names and colours, and what later
/// segments cover of each.
///
/// Throws Error(Fault::input) with the code
///   input.not_found   nothing there, or not readable
///   input.not_a_file  a pipe, a device or a socket, at the path or where the header says that the voxels are
///   input.empty       a file of 0 bytes
///   input.format      not a format listed above, or a folder without DICOM images
///   input.series      several DICOM series, or none or several whose UID begins so: the message lists them
///   input.slices      DICOM or TIFF slices that do not stack evenly: where a DICOM series has a gap, and how wide
///   input.dimension   fewer than two voxels along an axis, or more than one volume
///   input.pixel_type  more than one value per voxel (colour, vector, complex), or a type that is none of the ten
///   input.frame       the header's axes do not span space, or their steps differ by more than 1e9 times
///   input.nan         NaN or infinite voxels: how many and where the first is
///   input.range       values beyond 1e100
///   input.constant    all voxels are equal, which leaves nothing to mesh; not if may_be_constant
///   input.labels      a segmentation whose header and voxels do not fit each other
///   input.corrupt     truncated or damaged; or reading it crashed, or did not end
///   input.too_large   the header asks for more memory than the machine has, or reading it took more than it should
/// and internal.fork (no child process can be made). The message names the file and the remedy.
///
/// Guarantees: thread-safe. All formats but NIfTI and Analyze are read in a child process, with limits of time and
/// memory: what image libraries print is not shown, and their crashes are errors.
Scan read_scan(const std::string& path, Progress& progress, bool may_be_constant = false);

/// The same of an image that may hold several volumes on one grid, as probability maps are kept: along a fourth axis
/// (NIfTI, NRRD, MetaImage), as values of a voxel (NRRD, MetaImage), as segments of kind FRACTIONAL of a DICOM SEG
/// object. Return: the volumes in the file's order, of which each may be constant if there are several; none if
/// cancelled. Several are read only if their values may be probabilities: float, double or uint8; others are refused as
/// by read_scan() (input.dimension, input.pixel_type). Throws as read_scan().
std::vector<Scan> read_volumes(const std::string& path, Progress& progress, bool may_be_constant = false);

}  // namespace scantet
