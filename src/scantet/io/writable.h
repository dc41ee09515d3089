// Whether files can be written, before hours of work go into them.
#pragma once

#include <string>
#include <vector>

namespace scantet {

/// Checks that each file can be written: a folder that exists and lets us, no file named twice, none that is one of
/// `inputs`, by whatever name or link. Throws Error: usage.same_file, output.* (see AtomicFile). Leaves nothing behind.
void check_writable(const std::vector<std::string>& files, const std::vector<std::string>& inputs);

}  // namespace scantet
