#include "scantet/materials/material_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scantet/base/error.h"
#include "scantet/base/json_depth.h"
#include "scantet/base/json_message.h"
#include "scantet/base/options.h"
#include "scantet/base/regular_file.h"

namespace scantet {
namespace {

using nlohmann::json;

/// An object of the file, of which each key must be asked for.
class Keys {
 public:
  Keys(const json& object, std::string path, std::string place)
      : object_(object), path_(std::move(path)), place_(std::move(place)) {
    if (!object.is_object()) refuse("it is no object in braces");
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(Fault::usage, "usage.materials", path_ + ": " + (place_.empty() ? "" : place_ + ": ") + why,
                "docs/materials.md says how materials are written");
  }

  const json* find(const std::string& key) {
    known_.push_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
  }

  void number(const std::string& key, double& target, double least = -std::numeric_limits<double>::infinity(),
              double most = std::numeric_limits<double>::infinity()) {
    const json* const value = find(key);
    if (value == nullptr) return;
    if (!value->is_number()) refuse("\"" + key + "\" is no number");
    target = value->get<double>();
    if (target < least || target > most) refuse("\"" + key + "\" is out of range");
  }

  void number(const std::string& key, std::optional<double>& target, double least) {
    double value = -1;
    if (object_.contains(key)) {
      number(key, value, least);
      target = value;
    } else {
      known_.push_back(key);
    }
  }

  std::string text(const std::string& key) {
    const json* const value = find(key);
    if (value == nullptr) return "";
    if (!value->is_string()) refuse("\"" + key + "\" is no text");
    return value->get<std::string>();
  }

  Keys inside(const json& object, const std::string& key) const {
    return {object, path_, place_.empty() ? key : place_ + "." + key};
  }

  /// Refuses what was not asked for.
  void end() const {
    for (const auto& [key, value] : object_.items()) {
      if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
      const auto meant = closest_name(key, known_);
      refuse("\"" + key + "\" is not known" + (meant ? "; did you mean \"" + *meant + "\"?" : ""));
    }
  }

 private:
  const json& object_;
  std::string path_;
  std::string place_;
  std::vector<std::string> known_;
};

constexpr double kMostPoisson = 0.4999;

std::vector<LawPiece> read_pieces(Keys& keys, const std::string& key, bool has_power) {
  std::vector<LawPiece> pieces;
  const json* const list = keys.find(key);
  if (list == nullptr) return pieces;
  if (!list->is_array() || list->empty()) keys.refuse("\"" + key + "\" is no list of pieces");
  for (const json& each : *list) {
    Keys piece = keys.inside(each, key);
    LawPiece read;
    piece.number("below", read.below);
    piece.number("a", read.a);
    piece.number("b", read.b);
    if (has_power) piece.number("c", read.c, 0);
    piece.end();
    if (!pieces.empty() && !(pieces.back().below < read.below))
      piece.refuse("\"below\" does not rise from piece to piece");
    pieces.push_back(read);
  }
  if (std::isfinite(pieces.back().below)) keys.refuse("the last piece of \"" + key + "\" must have no \"below\"");
  return pieces;
}

template <class Word>
void read_word(Keys& keys, const std::string& key, const std::vector<std::pair<const char*, Word>>& words,
               Word& target) {
  const std::string text = keys.text(key);
  if (text.empty()) return;
  for (const auto& [word, value] : words) {
    if (text == word) {
      target = value;
      return;
    }
  }
  keys.refuse("\"" + key + "\": \"" + text + "\" is not known");
}

MaterialLaw read_law(Keys keys) {
  MaterialLaw law;
  law.scan = keys.text("file");
  if (law.scan.empty()) keys.refuse("\"file\", the scan, is missing");
  if (const json* const regions = keys.find("regions")) {
    if (!regions->is_array()) keys.refuse("\"regions\" is no list");
    for (const json& region : *regions)
      law.regions.push_back(region.is_string() ? region.get<std::string>() : region.dump());
  }
  if (const json* const density = keys.find("density")) {
    Keys line = keys.inside(*density, "density");
    line.number("a", law.density_a);
    line.number("b", law.density_b);
    line.end();
  }
  law.ash = read_pieces(keys, "ash", false);
  law.modulus = read_pieces(keys, "modulus", true);
  if (law.modulus.empty()) keys.refuse("\"modulus\", from density to stiffness, is missing");
  read_word<Integrate>(keys, "integrate",
                       {{"hu", Integrate::hu},
                        {"density", Integrate::density},
                        {"modulus", Integrate::modulus},
                        {"voxels", Integrate::voxels},
                        {"nodes", Integrate::nodes}},
                       law.integrate);
  constexpr double kTiny = 1e-12;
  keys.number("least_modulus_mpa", law.least_modulus_mpa, kTiny);
  keys.number("poissons_ratio", law.poissons_ratio, 0, kMostPoisson);
  keys.number("conductivity", law.conductivity, kTiny);
  if (const json* const bins = keys.find("bins")) {
    Keys inner = keys.inside(*bins, "bins");
    inner.number("width_mpa", law.bin_width_mpa, kTiny);
    inner.number("number", law.bin_number, 1);
    read_word<BinModulus>(inner, "modulus", {{"max", BinModulus::max}, {"mean", BinModulus::mean}}, law.bin_modulus);
    inner.end();
    if ((law.bin_width_mpa > 0) == (law.bin_number > 0)) inner.refuse("give either \"width_mpa\" or \"number\"");
  }
  keys.end();
  return law;
}

MaterialConstants read_constants(Keys& keys) {
  MaterialConstants constants;
  keys.number("youngs_modulus_mpa", constants.youngs_modulus_mpa, 0);
  keys.number("poissons_ratio", constants.poissons_ratio, 0, kMostPoisson);
  keys.number("density_g_per_cm3", constants.density_g_per_cm3, 0);
  keys.number("conductivity", constants.conductivity, 0);
  if (constants.youngs_modulus_mpa > 0 && keys.find("poissons_ratio") == nullptr) {
    keys.refuse("\"youngs_modulus_mpa\" is there, and \"poissons_ratio\" is missing");
  }
  keys.end();
  return constants;
}

std::vector<PlaceMaterial> read_places(const json& list, const Keys& keys) {
  if (!list.is_array()) keys.refuse("\"places\" is no list");
  std::vector<PlaceMaterial> places;
  for (const json& each : list) {
    Keys inner = keys.inside(each, "places");
    const std::string name = inner.text("name");
    const std::string where = inner.text("where");
    if (name.empty() || where.empty()) inner.refuse("\"name\" or \"where\", the place, is missing");
    places.push_back({read_named_place("--materials", name + "=elements: " + where), read_constants(inner)});
  }
  return places;
}

json parse(const std::string& path) {
  check_regular_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(Fault::usage, "usage.materials", path + ": cannot be read", "check the path");
  const auto within_depth = [&](int depth, json::parse_event_t, json&) {
    if (depth <= kMostJsonDepth) return true;
    throw Error(Fault::usage, "usage.materials", path + ": nested too deeply",
                "docs/materials.md says how materials are written");
  };
  try {
    return json::parse(stream, within_depth);
  } catch (const json::exception& error) {
    throw Error(Fault::usage, "usage.materials", path + ": not valid JSON: " + without_json_tag(error.what()),
                "docs/materials.md says how materials are written");
  }
}

}  // namespace

MaterialFile read_material_file(const std::string& path) {
  const json whole = parse(path);
  MaterialFile file;
  file.path = path;
  Keys keys(whole, path, "");
  if (const json* const regions = keys.find("regions")) {
    if (!regions->is_object()) keys.refuse("\"regions\" is no object in braces");
    for (const auto& [name, constants] : regions->items()) {
      Keys inner(constants, path, "regions." + name);
      file.regions[name] = read_constants(inner);
    }
  }
  if (const json* const places = keys.find("places")) file.places = read_places(*places, keys);
  if (const json* const scan = keys.find("scan")) file.law = read_law(keys.inside(*scan, "scan"));
  keys.end();
  if (file.places.empty() && file.regions.empty() && !file.law) {
    keys.refuse("it has neither \"places\" nor \"regions\" nor \"scan\"");
  }
  return file;
}

}  // namespace scantet
