#include "scantet/labels/junction_crossings.h"

#include <optional>
#include <vector>

#include "scantet/labels/junction_places.h"

namespace scantet {
namespace {

constexpr double kRise =
    0.05;  // of values that differ by about 1 from node to node: parts curves by a quarter of a voxel

}  // namespace

std::shared_ptr<const LabelField> part_crossings(const LabelField& field, std::span<const JunctionCrossing> crossings) {
  JunctionPlaces places(field);
  std::vector<LabelRise> rises;
  for (const JunctionCrossing& crossing : crossings) {
    const std::optional<Region> region = places.meeting_itself(crossing.index, crossing.regions);
    if (region) rises.push_back({places.cell(), *region, kRise});
  }
  return field.raised(rises);
}

}  // namespace scantet
