// From what was asked for as a size to a source that can be asked for sizes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/size_options/size_request.h"

namespace scantet {

/// The source that a number, an image or a formula asks for; the image is read here, and its files are added to
/// `files`. object: the bounds of what is meshed, world mm. Null if cancelled.
/// Throws Error: as read_scan and check_covers for an image.
std::shared_ptr<const SizeSource> read_source(const SizeRequest& request, const Box& object, Progress& progress,
                                              std::vector<std::string>& files);

/// Throws Error (input.size_image) if an image of sizes lies beside the object along one of the axes. covered, object:
/// their boxes, world mm. file: opens the message.
void check_covers(const Box& covered, const Box& object, const std::string& file);

}  // namespace scantet
