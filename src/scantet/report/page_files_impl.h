// The files that the build embeds (see CMakeLists.txt), in the order in which the page holds them.
#pragma once

#include <string_view>

namespace scantet::page_files {

using namespace std::string_view_literals;

#include "scantet/report/page_files.inc"

inline constexpr std::string_view kScripts[] = {kThree,     kOrbitControls, kD3,          kCut,    kMarks,
                                                kView,      kCharts,        kTables,      kPlaces, kRegions,
                                                kSliceScan, kSlices,        kCertificate, kPage};

}  // namespace scantet::page_files
