// A segmentation as CGAL takes it.
#pragma once

#include <CGAL/Image_3.h>
#include <CGAL/Mesh_3/initialize_triangulation_from_labeled_image.h>
#include <CGAL/Mesh_3/search_for_connected_components_in_labeled_image.h>

#include <iostream>

#include "scantet/field/scan.h"

namespace scantet::bench {

/// The labels, and their weights for a Gaussian of the largest voxel edge, as CGAL's guide recommends.
class PeerLabels {
 public:
  /// Throws std::runtime_error if the labels are not whole numbers from 0 to 255.
  explicit PeerLabels(const Scan& scan);

  const CGAL::Image_3& image() const { return image_; }
  const CGAL::Image_3& weights() const { return weights_; }

 private:
  CGAL::Image_3 image_;
  CGAL::Image_3 weights_;
};

/// Puts points on the surface around each component of each label. What CGAL prints meanwhile is not shown.
template <class Complex, class PeerDomain, class Criteria>
void add_points_around_labels(Complex& mesh, const PeerDomain& domain, const Criteria& criteria,
                              const PeerLabels& labels) {
  std::streambuf* const shown = std::cout.rdbuf(nullptr);
  initialize_triangulation_from_labeled_image(mesh, domain, labels.image(), criteria, static_cast<unsigned char>(0));
  std::cout.rdbuf(shown);
  std::cout.clear();
}

}  // namespace scantet::bench
