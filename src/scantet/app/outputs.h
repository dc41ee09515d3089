// Output files are checked before hours of work go into them.
#pragma once

#include <string>
#include <vector>

namespace scantet {

/// Checks that each file can be written: a known extension, a folder that exists and lets us, no file named twice, none
/// that is one of `inputs`, by whatever name or link. beside: what is written beside meshes, of any extension.
/// mesh_option: what names the meshes; empty if no option does.
/// Throws Error: usage.format, usage.same_file, output.* (see AtomicFile). Leaves nothing behind.
void check_outputs(const std::vector<std::string>& meshes, const std::vector<std::string>& reports,
                   const std::vector<std::string>& inputs, const std::vector<std::string>& beside = {},
                   const std::string& mesh_option = "--output");

}  // namespace scantet
