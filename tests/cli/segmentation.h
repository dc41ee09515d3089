// A small segmentation, as the bytes of a file.
#pragma once

#include <string>

namespace scantet {

/// A segmentation as 3D Slicer writes it: labels 1, 2 and 3 in slabs of a box of 8³. keys: of the segments.
inline std::string segmentation(const std::string& keys, int labels = 3) {
  std::string file =
      "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n" +
      keys + "\n";
  for (int n = 0; n < 512; ++n) {
    const int i = n % 8;
    file += static_cast<char>(i == 0 || i == 7 ? 0 : 1 + (i - 1) / 2 % labels);
  }
  return file;
}

/// The segments of these labels, without names.
inline const std::string kKeys =
    "Segment0_ID:=Segment_1\nSegment0_LabelValue:=1\nSegment1_ID:=Segment_2\nSegment1_LabelValue:=2\n"
    "Segment2_ID:=Segment_3\nSegment2_LabelValue:=3\n";

}  // namespace scantet
