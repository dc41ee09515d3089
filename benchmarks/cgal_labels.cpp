#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_triangulation_3.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "cgal_labels_impl.h"
#include "label_weights.h"

namespace scantet::bench {
namespace {

std::vector<std::uint8_t> bytes_of(const Scan& scan) {
  std::vector<std::uint8_t> labels(static_cast<std::size_t>(scan.voxel_count()));
  std::visit(
      [&](const auto* voxels) {
        for (std::size_t i = 0; i < labels.size(); ++i) {
          labels[i] = static_cast<std::uint8_t>(voxels[i]);
          if (static_cast<double>(labels[i]) != static_cast<double>(voxels[i])) {
            throw std::runtime_error("the peer is compared on labels from 0 to 255 only");
          }
        }
      },
      scan.voxels);
  return labels;
}

CGAL::Image_3 to_image(const Scan& scan, const std::vector<std::uint8_t>& values) {
  _image* image = _createImage(static_cast<std::size_t>(scan.size[0]), static_cast<std::size_t>(scan.size[1]),
                               static_cast<std::size_t>(scan.size[2]), 1, scan.frame.spacing_mm(0),
                               scan.frame.spacing_mm(1), scan.frame.spacing_mm(2), 1, WK_FIXED, SGN_UNSIGNED);
  std::copy(values.begin(), values.end(), static_cast<std::uint8_t*>(image->data));
  return CGAL::Image_3(image, CGAL::Image_3::OWN_THE_DATA);
}

}  // namespace

PeerLabels::PeerLabels(const Scan& scan) {
  const std::vector<std::uint8_t> labels = bytes_of(scan);
  const std::array<double, 3> spacing{scan.frame.spacing_mm(0), scan.frame.spacing_mm(1), scan.frame.spacing_mm(2)};
  image_ = to_image(scan, labels);
  weights_ =
      to_image(scan, label_weights(labels, scan.size, spacing, *std::max_element(spacing.begin(), spacing.end())));
}

}  // namespace scantet::bench
