// SHA-256 (FIPS 180-4), which names an input whatever it is called.
#pragma once

#include <string>
#include <string_view>

#include "scantet/base/api.h"

namespace SCANTET_PROGRAM_API scantet {

/// 64 lower-case hexadecimal digits: the checksum of a file's bytes, as sha256sum prints it.
/// Throws Error: input.cannot_open (the file cannot be read to its end), input.not_a_file (a pipe or device).
std::string sha256_file(const std::string& path);

/// The checksum of the bytes of a text.
std::string sha256_text(std::string_view text);

}  // namespace scantet
