// Abaqus and CalculiX input: keyword lines (*NODE) with data lines below them, and comments (**). A keyword chooses the
// function that takes its lines; lines of keywords that have nothing to do with the mesh are passed over. Elements may
// have any numbers and belong to sets named before or after them, so regions and sets are resolved at the end.
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "scantet/base/ascii_text.h"
#include "scantet/base/error.h"
#include "scantet/io/inp_sets_impl.h"
#include "scantet/io/inp_text_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/tagged_mesh_impl.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {
namespace {

class InpReader {
 public:
  InpReader(const std::string& path, const std::string& text)
      : path_(path), scan_(path, text), ends_with_line_(text.ends_with('\n')), most_in_sets_(4 * text.size()) {}

  RawMesh read() {
    while (next_line()) {
      if (line_.starts_with("**")) {
        read_comment();
      } else if (line_.starts_with('*')) {
        read_keyword();
      } else if (!line_.empty()) {
        split(line_, parts_);
        (this->*take_)();
      }
    }
    require_whole();
    const auto is_region = [&](std::string_view name) { return sets_.contains(std::string(name)); };
    if (ours_) drop_derived_sets(is_region, file_, surfaces_);
    drop_set_of_all_nodes(file_);
    sort_by_tag(file_, path_);
    resolve_regions();
    resolve_surfaces(surfaces_, file_);
    return std::move(file_.mesh);
  }

 private:
  using Parameters = std::map<std::string, std::string>;

  /// Numbers of elements in a set that is a region.
  struct Members {
    Region region;
    std::int64_t first, last, step;
  };

  [[noreturn]] void fail(const std::string& what) const {
    throw_bad_mesh(path_, "line " + std::to_string(line_number_) + ": " + what);
  }
  /// Refuses something that is right in such a file but that this reader does not read.
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw Error(Fault::input, "input.inp",
                "cannot read '" + path_ + "': line " + std::to_string(line_number_) + ": " + what, remedy);
  }

  bool next_line() {
    if (scan_.at_end()) return false;
    line_ = trimmed(scan_.rest_of_line());
    ++line_number_;
    return true;
  }

  void read_comment() {
    const std::string_view comment = trimmed(line_.substr(2));
    const std::string key = std::string(kSpaceKey) + "=";
    ours_ = ours_ || comment.starts_with(key);
    if (comment.starts_with(key + "RAS")) file_.mesh.ras = true;
  }

  void read_keyword() {
    if (!numbers_.empty()) fail("the element before has too few nodes");
    std::string text = ascii_upper(line_.substr(1));
    while (text.ends_with(',') && next_line()) {
      if (!line_.starts_with("**")) text += ascii_upper(line_);
    }
    split(text, parts_);
    const std::string keyword(parts_.empty() ? "" : parts_.front());
    Parameters parameters;
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      const std::size_t equals = std::min(parts_[i].find('='), parts_[i].size());
      std::string_view value = trimmed(parts_[i].substr(std::min(equals + 1, parts_[i].size())));
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      parameters[std::string(trimmed(parts_[i].substr(0, equals)))] = value;
    }
    begin_section(keyword, parameters);
  }

  void begin_section(const std::string& keyword, const Parameters& parameters) {
    constexpr std::string_view kMakers[] = {"INCLUDE", "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};
    if (std::find(std::begin(kMakers), std::end(kMakers), keyword) != std::end(kMakers)) {
      refuse("*" + keyword + " brings, makes or moves parts of the mesh",
             "give the file that has all of the mesh in it");
    }
    const bool of_mesh = keyword == "NODE" || keyword == "ELEMENT";
    if (of_mesh && parameters.contains("INPUT")) {
      refuse("the lines of *" + keyword + " are in another file", "give the file that has all of the mesh in it");
    }
    take_ = &InpReader::pass_over;
    if (keyword == "NODE") {
      begin_nodes(parameters);
    } else if (keyword == "ELEMENT") {
      begin_elements(parameters);
    } else if (keyword == "ELSET") {
      begin_set(parameters);
    } else if (keyword == "NSET") {
      begin_other_set("NSET", parameters, file_.node_sets);
    } else if (keyword == "SURFACE") {
      begin_surface(parameters);
    } else if (keyword == "INSTANCE") {
      take_ = &InpReader::refuse_line;  // it would move the part
    } else if (!is_of_order(keyword)) {
      leave_out(keyword);
    }
  }

  /// A section whose lines are not taken.
  void leave_out(const std::string& keyword, const std::string& name = "") {
    const std::string text = keyword.substr(0, 40) + (name.empty() ? "" : " " + in_quotes(name));
    if (left_out_.insert(text).second) file_.mesh.left_out.push_back("*" + text);
  }

  void begin_nodes(const Parameters& parameters) {
    const auto system = parameters.find("SYSTEM");
    if (system != parameters.end() && system->second != "R") {
      refuse("the nodes are not in rectangular coordinates", "write them with x, y and z");
    }
    const auto set = parameters.find("NSET");
    const bool is_in_set = set != parameters.end() && !(ours_ && set->second == "NALL");
    members_of_set_ = is_in_set ? &new_set(set->second, file_.node_sets) : nullptr;
    take_ = &InpReader::take_node;
  }

  /// Where to put the members of a set whose lines follow.
  static std::vector<std::int64_t>& new_set(const std::string& name, std::vector<TaggedSet>& sets) {
    sets.push_back({name, {}});
    return sets.back().tags;
  }

  void begin_elements(const Parameters& parameters) {
    const auto type = parameters.find("TYPE");
    if (type == parameters.end()) fail("*ELEMENT has no TYPE");
    const auto set = parameters.find("ELSET");
    set_ = 0;
    if (set != parameters.end()) {
      const auto [known, is_new] = sets_.emplace(set->second, static_cast<Region>(set_names_.size() + 1));
      if (is_new) set_names_.push_back(set->second);
      set_ = known->second;
    }
    type_ = type->second;
    if (type_ == "C3D4" || type_.starts_with("C3D10")) {  // also C3D10M, C3D10H and the like
      nodes_ = type_ == "C3D4" ? 4 : 10;
      take_ = &InpReader::take_tet;
    } else if (nodes_of_triangle(type_) > 0) {
      nodes_ = nodes_of_triangle(type_);
      const bool is_in_set = set != parameters.end() && set->second != "EALL";
      members_of_set_ = is_in_set ? &new_set(set->second, file_.element_sets) : nullptr;
      take_ = &InpReader::take_triangle;
    } else if (has_no_volume(type_)) {
      if (set != parameters.end()) leave_out("ELEMENT", set->second);
      take_ = &InpReader::count_element;
    } else {
      refuse("elements of type " + in_quotes(type_) +
                 " are not read, only C3D4 and C3D10, tetrahedra of four or ten nodes",
             "write the mesh with tetrahedra");
    }
  }

  void begin_set(const Parameters& parameters) {
    const auto name = parameters.find("ELSET");
    if (name == parameters.end()) fail("*ELSET has no name");
    ends_elements_ = ends_elements_ || name->second == "EALL";
    const std::optional<Region> region = region_in(name->second);
    if (!region) {
      if (name->second != "EALL") begin_other_set("ELSET", parameters, file_.element_sets);
      return;
    }
    set_ = *region;
    take_ = parameters.contains("GENERATE") ? &InpReader::take_range : &InpReader::take_members;
  }

  /// A set that is no region. One that is made of a range, of other sets, or of the nodes of elements, is passed over.
  void begin_other_set(const char* keyword, const Parameters& parameters, std::vector<TaggedSet>& sets) {
    const auto name = parameters.find(keyword);
    if (name == parameters.end()) return leave_out(keyword);
    const bool is_of_elements = name->first == "NSET" && parameters.contains("ELSET");
    if (parameters.contains("GENERATE") || is_of_elements) return leave_out(keyword, name->second);
    keyword_ = keyword;
    name_ = name->second;
    members_of_set_ = &new_set(name_, sets);
    take_ = &InpReader::take_tags;
  }

  void begin_surface(const Parameters& parameters) {
    const auto name = parameters.find("NAME");
    const auto type = parameters.find("TYPE");
    if (name == parameters.end()) return leave_out("SURFACE");
    if (type != parameters.end() && type->second != "ELEMENT") return leave_out("SURFACE", name->second);
    keyword_ = "SURFACE";
    name_ = name->second;
    surfaces_.push_back({name_, {}});
    take_ = &InpReader::take_face;
  }

  std::int64_t whole(std::string_view text) const {
    std::int64_t value = 0;
    if (!parse_number(text, value)) fail("a whole number is expected, not " + in_quotes(text));
    if (value < 1) fail("the number " + std::to_string(value) + " is not positive");
    return value;
  }

  double coordinate(std::string_view text) const {
    double value = 0;
    if (!parse_number(text, value)) fail("a number is expected, not " + in_quotes(text));
    return value;
  }

  void pass_over() {}

  void refuse_line() { fail("a keyword is expected, not " + in_quotes(line_)); }

  void take_node() {
    if (parts_.size() < 4) fail("a node has a number and three coordinates");
    file_.node_tags.push_back(whole(parts_[0]));
    const Point p{coordinate(parts_[1]), coordinate(parts_[2]), coordinate(parts_[3])};
    if (!is_finite(p)) fail("a coordinate is not finite");
    if (members_of_set_ != nullptr) members_of_set_->push_back(file_.node_tags.back());
    file_.mesh.vertices.push_back(p);
  }

  /// Adds the line's numbers to those of an element, which may take several lines; all but the last end with a comma.
  /// Return: whether it is whole.
  bool take_element() {
    for (std::string_view part : parts_) numbers_.push_back(whole(part));
    const bool goes_on = numbers_.size() < 1 + nodes_ && line_.ends_with(',');
    if (!goes_on && numbers_.size() != 1 + nodes_) {
      constexpr std::array<const char*, 11> kWords{"", "", "", "three", "four", "", "six", "", "", "", "ten"};
      fail("an element of type " + in_quotes(type_) + " has a number and " + kWords.at(nodes_) + " nodes");
    }
    return !goes_on;
  }

  void take_tet() {
    if (!take_element()) return;
    file_.element_tags.push_back(numbers_[0]);
    const auto node = [&](std::size_t i) { return static_cast<std::uint64_t>(numbers_[i]); };
    file_.mesh.tets.push_back({node(1), node(2), node(3), node(4)});
    if (nodes_ == 10) file_.mesh.edge_nodes.push_back({node(5), node(6), node(7), node(8), node(9), node(10)});
    file_.mesh.references.push_back(set_);
    numbers_.clear();
  }

  /// Its corners come first.
  void take_triangle() {
    if (!take_element()) return;
    const auto node = [&](std::size_t i) { return static_cast<std::uint64_t>(numbers_[i]); };
    file_.triangles.push_back({numbers_[0], {node(1), node(2), node(3)}});
    if (members_of_set_ != nullptr) members_of_set_->push_back(numbers_[0]);
    ++file_.mesh.other_cells;
    numbers_.clear();
  }

  void count_element() {
    if (!line_.ends_with(',')) ++file_.mesh.other_cells;
  }

  void take_members() {
    for (std::string_view part : parts_) {
      const std::int64_t element = whole(part);
      members_.push_back({set_, element, element, 1});
    }
  }

  void take_tags() {
    for (std::string_view part : parts_) {
      std::int64_t tag = 0;
      if (parse_number(part, tag)) {
        members_of_set_->push_back(tag);
      } else {  // the name of a set
        leave_out(keyword_, name_);
        members_of_set_->clear();
        take_ = &InpReader::pass_over;
        return;
      }
    }
  }

  void take_face() {
    std::int64_t element = 0;
    const bool is_face = parts_.size() == 2 && parse_number(parts_[0], element) && parts_[1].size() == 2 &&
                         (parts_[1][0] == 'S' || parts_[1][0] == 's') && parts_[1][1] >= '1' && parts_[1][1] <= '4';
    if (is_face) {
      surfaces_.back().faces.emplace_back(element, parts_[1][1] - '0');
    } else {
      leave_out(keyword_, name_);
      surfaces_.back().faces.clear();
      take_ = &InpReader::pass_over;
    }
  }

  void take_range() {
    if (parts_.size() < 2) fail("a range has a first and a last number");
    members_.push_back({set_, whole(parts_[0]), whole(parts_[1]), parts_.size() > 2 ? whole(parts_[2]) : 1});
  }

  /// Refuses a file that was cut short: such a file rarely ends with a whole line, and a file of ours has a set of all
  /// elements after the elements.
  void require_whole() const {
    const bool is_in_set = take_ == &InpReader::take_tags || take_ == &InpReader::take_face;
    const bool amid_mesh = take_ != &InpReader::pass_over && (ours_ || !is_in_set) && !ends_with_line_;
    if (!numbers_.empty() || amid_mesh) fail("the file ends in the middle of the mesh");
    if (ours_ && !ends_elements_) fail("the file ends before the set EALL");
  }

  /// Sets of other names get the numbers above those of regions, in the order in which they appear.
  void resolve_regions() {
    const auto twice = std::adjacent_find(file_.element_tags.begin(), file_.element_tags.end());
    if (twice != file_.element_tags.end()) {
      throw_bad_mesh(path_, "element " + std::to_string(*twice) + " is there twice");
    }
    std::int64_t largest = 0;
    for (const Members& m : members_) largest = std::max<std::int64_t>(largest, m.region);
    for (const std::string& name : set_names_) largest = std::max<std::int64_t>(largest, region_in(name).value_or(0));
    std::vector<Region> region_of_set{kOutside};
    for (const std::string& name : set_names_) {
      const std::optional<Region> region = region_in(name);
      if (!region && largest == std::numeric_limits<Region>::max()) {
        throw_bad_mesh(path_, "its region numbers are too large");
      }
      region_of_set.push_back(region ? *region : static_cast<Region>(++largest));
      if (!region) file_.mesh.region_names[region_of_set.back()] = name;
    }
    for (Region& reference : file_.mesh.references) reference = region_of_set[static_cast<std::size_t>(reference)];
    const std::vector<std::int64_t>& tags = file_.element_tags;
    std::size_t looked_at = 0;
    for (const Members& m : members_) {
      for (auto tag = std::lower_bound(tags.begin(), tags.end(), m.first); tag != tags.end() && *tag <= m.last; ++tag) {
        if (++looked_at > most_in_sets_) throw_bad_mesh(path_, "its sets of elements overlap too often");
        if ((*tag - m.first) % m.step == 0) {
          file_.mesh.references[static_cast<std::size_t>(tag - tags.begin())] = m.region;
        }
      }
    }
  }

  const std::string& path_;
  TextScanner scan_;
  bool ends_with_line_;
  std::size_t most_in_sets_;  // elements, each as often as ranges hold it, so that time is bounded by the file's size
  TaggedMesh file_;           // references are indices of sets, from 1, until they are resolved
  std::string_view line_;
  std::size_t line_number_ = 0;
  std::vector<std::string_view> parts_;                  // of the line
  void (InpReader::*take_)() = &InpReader::refuse_line;  // a line of data
  Region set_ = 0;                      // that the elements are in, or the region whose elements follow
  std::string type_;                    // of the elements that follow
  std::size_t nodes_ = 4;               // of each of them
  std::vector<std::int64_t> numbers_;   // of an element that goes on in the next line
  std::map<std::string, Region> sets_;  // to their index, from 1
  std::vector<std::string> set_names_;
  std::vector<Members> members_;
  std::vector<std::int64_t>* members_of_set_ = nullptr;  // that follow; null: what follows is in none
  std::vector<InpSurface> surfaces_;
  std::string keyword_, name_;      // of the set or surface whose members follow
  std::set<std::string> left_out_;  // told already
  bool ours_ = false;
  bool ends_elements_ = false;
};

}  // namespace

RawMesh read_inp(const std::string& path) {
  const std::string text = read_whole_file(path);
  return InpReader(path, text).read();
}

}  // namespace scantet
