// From what was asked for as a size to a source that can be asked for sizes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/size_options/size_plan.h"
#include "scantet/size_options/size_request.h"

namespace scantet {

/// The source that a number, an image or a formula asks for; the image is read here, and its files are added to
/// `files`. object: the bounds of what is meshed, world mm. Null if cancelled.
/// Throws Error: as read_scan and check_covers for an image.
std::shared_ptr<const SizeSource> read_source(const SizeRequest& request, const Box& object, Progress& progress,
                                              std::vector<std::string>& files);

/// Another source, but for places, which have a size each; the smallest where they overlap. Reads the scans that the
/// places ask, and adds their files to `files`. Null if cancelled. Throws Error: as read_scan.
std::shared_ptr<const SizeSource> place_source(std::shared_ptr<const SizeSource> elsewhere,
                                               const std::vector<PlaceSize>& places, Progress& progress,
                                               std::vector<std::string>& files);

/// Throws Error (input.size_image) if an image of sizes lies beside the object along one of the axes. covered, object:
/// their boxes, world mm. file: opens the message.
void check_covers(const Box& covered, const Box& object, const std::string& file);

}  // namespace scantet
