// Cuts as people type them.
#pragma once

#include <string>
#include <vector>

#include "scantet/cuts/cut_plane.h"

namespace scantet {

/// Reads "x < 10", "x + 2z > -3.5" (what is kept), "-10 < y < 10" (two planes), each with a name before it or none:
/// "clamp: z > -40". Lengths are mm along the axes of the world, LPS; a sum such as x + 2z is held against the number
/// as it is. Appends the planes, which without a name are cut_1, cut_2 and so on; two planes with a name are NAME_low
/// and NAME_high. place: opens messages, "--cut". Throws Error: usage.cut.
void read_cut(const std::string& place, const std::string& text, std::vector<CutPlane>& planes);

}  // namespace scantet
