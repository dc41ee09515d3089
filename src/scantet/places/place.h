// Places of an object as users write them: docs/places.md has the grammar.
#pragma once

#include <string>
#include <vector>

#include "scantet/cuts/cut_plane.h"

namespace scantet {

/// A place, or what joins places.
struct Place {
  enum class Kind {
    everything,
    box,       ///< numbers: least x, y, z, largest x, y, z, mm
    ball,      ///< numbers: centre x, y, z, radius, mm
    cylinder,  ///< numbers: the ends of its axis x, y, z, x, y, z, radius, mm
    planes,    ///< what is kept of all of `planes`
    normal,    ///< numbers: direction x, y, z, largest angle in degrees
    region,    ///< name: or number
    patch,     ///< name
    curve,     ///< name; empty: any curve
    border,    ///< name: left, right, anterior, posterior, superior, inferior
    nearest,   ///< numbers: how many, x, y, z, mm
    above,     ///< name: of a scan; numbers: its values are at least that
    below,     ///< the same, at most that
    set,       ///< name: of a set that is there already
    all_of,    ///< in all of `parts`
    any_of,    ///< in one of `parts`
    not_in,    ///< not in parts[0]
  };
  Kind kind = Kind::everything;
  std::vector<double> numbers;
  std::string name;
  std::vector<CutPlane> planes;
  std::vector<Place> parts;
};

/// What a set holds.
enum class PlaceItems { all, nodes, facets, elements };

/// A place with the name that it has in files.
struct NamedPlace {
  std::string name;
  PlaceItems items = PlaceItems::all;
  Place place;
  std::string text;  ///< as typed, with its name
};

/// Reads a place. option: opens messages, "--set". Throws Error (usage.place), which says the column of the text.
Place read_place(const std::string& option, const std::string& text);

/// Reads "NAME=PLACE", "NAME=facets: PLACE". Names have letters, digits and _, begin with a letter, and are none that
/// files use for something else. Throws Error (usage.place).
NamedPlace read_named_place(const std::string& option, const std::string& text);

/// The scans that the place asks, each once, in their order.
std::vector<std::string> scans_of(const Place& place);

/// The sets that the place asks, each once, in their order.
std::vector<std::string> sets_of(const Place& place);

/// The regions that the place asks, names or numbers, each once, in their order.
std::vector<std::string> regions_of_place(const Place& place);

/// Whether a point and the region that it is in tell whether it is in the place, so that no mesh is needed.
bool is_of_points(const Place& place);

}  // namespace scantet
