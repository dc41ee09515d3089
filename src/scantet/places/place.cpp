// What a place asks for, without a mesh.
#include "scantet/places/place.h"

#include <algorithm>
#include <initializer_list>

namespace scantet {
namespace {

/// The names that places of these kinds have.
void collect_names(const Place& place, std::initializer_list<Place::Kind> kinds, std::vector<std::string>& names) {
  const bool asks = std::find(kinds.begin(), kinds.end(), place.kind) != kinds.end();
  if (asks && std::find(names.begin(), names.end(), place.name) == names.end()) names.push_back(place.name);
  for (const Place& part : place.parts) collect_names(part, kinds, names);
}

}  // namespace

std::vector<std::string> scans_of(const Place& place) {
  std::vector<std::string> files;
  collect_names(place, {Place::Kind::above, Place::Kind::below}, files);
  return files;
}

std::vector<std::string> sets_of(const Place& place) {
  std::vector<std::string> sets;
  collect_names(place, {Place::Kind::set}, sets);
  return sets;
}

std::vector<std::string> regions_of_place(const Place& place) {
  std::vector<std::string> regions;
  collect_names(place, {Place::Kind::region}, regions);
  return regions;
}

bool is_of_points(const Place& place) {
  switch (place.kind) {
    case Place::Kind::everything:
    case Place::Kind::box:
    case Place::Kind::ball:
    case Place::Kind::cylinder:
    case Place::Kind::planes:
    case Place::Kind::above:
    case Place::Kind::below:
      return true;
    case Place::Kind::all_of:
    case Place::Kind::any_of:
    case Place::Kind::not_in:
      return std::all_of(place.parts.begin(), place.parts.end(), is_of_points);
    default:
      return false;
  }
}

}  // namespace scantet
