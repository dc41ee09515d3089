// The identity of an input: a checksum of everything that was read.
#pragma once

#include <string>
#include <vector>

namespace scantet {

/// The files behind an input as typed: the file itself, with the voxel files that a header (.nhdr, .nrrd, .mhd, .mha,
/// .hdr) names beside it, one by one, in a list or by a pattern; the files of a folder, subfolders not included; for
/// FOLDER:UID those of the folder. Sorted.
std::vector<std::string> input_files(const std::string& input);

/// SHA-256 as 64 hexadecimal digits. One file: of its bytes. Several: of the lines "<sha256>  <file name>\n" in their
/// order, which `sha256sum *` prints too. Throws Error (input.*) if a file cannot be read.
std::string input_sha256(const std::vector<std::string>& files);

}  // namespace scantet
