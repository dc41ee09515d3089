// A small image of bytes, as the bytes of a file.
#pragma once

#include <array>
#include <string>

namespace scantet {

/// An NRRD image of voxels of 1 mm, the first at the origin of a world of LPS axes. value(i, j, k): from 0 to 255.
template <class Value>
std::string byte_image(const std::array<int, 3>& size, const Value& value) {
  std::string file = "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes:";
  for (const int along : size) file += " " + std::to_string(along);
  file +=
      "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nencoding: raw\nspace origin: "
      "(0,0,0)\n\n";
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) file += static_cast<char>(value(i, j, k));
    }
  }
  return file;
}

}  // namespace scantet
