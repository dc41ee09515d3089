// An image may be constant here: one size everywhere is a size.
#include "scantet/size_options/size_sources.h"

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/io/input_files.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/sizing/size_image.h"

namespace scantet {

void check_covers(const Box& covered, const Box& object, const std::string& file) {
  for (int axis = 0; axis < 3; ++axis) {
    if (covered.min[axis] <= object.max[axis] && covered.max[axis] >= object.min[axis]) continue;
    throw Error(Fault::input, "input.size_image",
                file + ": the image of sizes is elsewhere than the object: along axis " + std::string(1, "xyz"[axis]) +
                    " it covers " + number_text(covered.min[axis], 5) + " to " + number_text(covered.max[axis], 5) +
                    " mm, the object " + number_text(object.min[axis], 5) + " to " + number_text(object.max[axis], 5) +
                    " mm",
                "check its origin and directions");
  }
}

std::shared_ptr<const SizeSource> read_source(const SizeRequest& request, const Box& object, Progress& progress,
                                              std::vector<std::string>& files) {
  if (request.kind == SizeRequest::Kind::number) return std::make_shared<UniformSource>(request.size_mm);
  if (request.image.empty()) return request.source;
  constexpr bool kMayBeConstant = true;
  const Scan scan = read_scan(request.image, progress, kMayBeConstant);
  if (progress.cancelled()) return nullptr;
  for (const std::string& file : input_files(request.image)) files.push_back(file);
  const Vec last{scan.size[0] - 0.5, scan.size[1] - 0.5, scan.size[2] - 0.5};
  check_covers(scan.frame.world_box({-0.5, -0.5, -0.5}, last), object, request.image);
  return std::make_shared<SizeImage>(scan);
}

}  // namespace scantet
