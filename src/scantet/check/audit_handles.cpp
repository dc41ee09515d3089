// A patch belongs to the component of the mesh, of the same region, that has most of the facets' corners on it, and a
// component of the domain to that of most of the patches around its witness: where surfaces nearly touch, rounding may
// put the one or other point on a wrong one. Where that pairs two of the domain with one of the mesh, they are joined
// there, which their count does not show if another one is parted. Those paired one to one must have boundaries with as
// many handles, or the same Euler number where the domain does not know how many surfaces there are. The mesh's come
// from its facets (audit_boundary.cpp).
//
// A component with cavities has several surfaces, and a handle that one of them has for another does not show in the
// sum. So the boundaries of cavities are compared, too. That is enough: components and cavities, joined by the surfaces
// between them, form a tree, in which the sums at all nodes determine the numbers of the edges.
#include <algorithm>
#include <map>

#include "scantet/base/known_sum.h"
#include "scantet/base/options.h"
#include "scantet/check/audit_impl.h"

namespace scantet::auditing {
namespace {

/// votes: how many by what they are for.
template <class Votes>
typename Votes::const_iterator most_votes(const Votes& votes) {
  return std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
}

class HandleCheck {
 public:
  HandleCheck(const std::vector<ListedComponent>& listed, bool are_all, AuditReport& report)
      : listed_(listed), are_all_(are_all), report_(report), partner_of_(listed.size(), kNone) {}

  /// By the patches of vertices.
  void pair_by_patches(const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                       const VertexPatches& patches) {
    std::map<std::pair<Patch, std::uint32_t>, std::uint64_t> corners;  // on a patch, of a component of the mesh
    for (const BoundaryFace& face : match.boundary) {
      for (const std::uint32_t tet : {face.behind, face.front}) {
        if (tet == kNone || component_of[tet] == kNone) continue;
        for (const VertexId v : face.vertices) ++corners[{patches.at(v), component_of[tet]}];
      }
    }
    using Side = std::pair<Patch, Region>;
    std::map<Side, std::pair<std::uint64_t, std::uint32_t>> most;  // corners, and whose
    for (const auto& [key, count] : corners) {
      auto& best = most[{key.first, report_.components[key.second].region}];
      if (count > best.first) best = {count, key.second};
    }
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      std::map<std::uint32_t, int> votes;
      for (const Patch& patch : listed_[i].walls) {
        const auto found = most.find({patch, listed_[i].component.region});
        if (found != most.end()) ++votes[found->second.second];
      }
      const auto chosen = most_votes(votes);
      if (chosen != votes.end()) pair(i, chosen->first);
    }
  }

  /// By their regions: for domains whose components have a region each.
  void pair_by_regions() {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      for (std::uint32_t n = 0; n < report_.components.size(); ++n) {
        if (report_.components[n].region == listed_[i].component.region) pair(i, n);
      }
    }
  }

  /// Adds the surfaces of the mesh around and within each cavity: those with most of their corners on its patches.
  void measure_cavities(const FaceMatch& match, const OutsideSurfaces& outside, const VertexPatches& patches) {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (listed_[i].component.region != kOutside || !listed_[i].component.euler) continue;
      const std::optional<ComponentId> id = outside_component(listed_[i].walls);
      if (!id || *id == kNotToldApart) continue;
      if (!cavity_of_.emplace(*id, i).second) cavity_of_[*id] = listed_.size();  // of two cavities
    }
    std::vector<std::map<ComponentId, std::uint64_t>> corners(outside.euler.size());
    for (std::size_t f = 0; f < match.boundary.size(); ++f) {
      if (outside.of_face[f] == kNone) continue;
      for (const VertexId v : match.boundary[f].vertices) {
        const Patch& patch = patches.at(v);
        if (patch.regions[0] == kOutside) ++corners[outside.of_face[f]][patch.components[0]];
      }
    }
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const auto most = most_votes(corners[n]);
      const auto cavity = most == corners[n].end() ? cavity_of_.end() : cavity_of_.find(most->first);
      if (outside.cavity[n] != kNone) {
        walls_[cavity == cavity_of_.end() ? listed_.size() : cavity->second].push_back(outside.cavity[n]);
      }
      if (cavity == cavity_of_.end() || cavity->second == listed_.size()) continue;
      SurfaceSum& sum = cavities_[cavity->second];
      sum.euler += outside.euler[n];
      ++sum.surfaces;
    }
  }

  /// Tells of components that are one in the mesh, in regions where their count does not, as of some it cannot. Where
  /// it does, it gets the places of all of these but the largest, and of the mesh's that none of the domain's is.
  void find_joined() {
    std::map<Region, std::int64_t> too_few;
    for (const ListedComponent& listed : listed_) ++too_few[listed.component.region];
    for (const MeshComponent& component : report_.components) --too_few[component.region];
    std::map<std::uint32_t, std::size_t> largest;  // of those in one
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      std::size_t& of_one = largest.try_emplace(partner_of_[i], i).first->second;
      if (listed_[i].component.volume_mm3 > listed_[of_one].component.volume_mm3) of_one = i;
    }
    Tally tally{"audit.component_joined"};
    Tally counted{"audit.component_count"};
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const Component& component = listed_[i].component;
      const std::uint32_t partner = partner_of_[i];
      if (component.region == kOutside || partner == kNone || listed_of_.at(partner) == 1) continue;
      if (are_all_ && too_few.at(component.region) != 0) {
        if (largest.at(partner) != i) counted.hit(component.witness, [&] { return size_text(component); });
        continue;
      }
      tally.hit(component.witness, [&] { return size_text(component); });
    }
    for (std::uint32_t n = 0; are_all_ && n < report_.components.size(); ++n) {
      if (!listed_of_.contains(n)) counted.hit(report_.components[n].box_mm.center(), [] { return "a part of one"; });
    }
    record(tally, report_);
    place(counted);
  }

  /// Tells of components that are several in the mesh, of which no count tells if not all are known.
  void find_split(const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                  const VertexPatches& patches) {
    std::vector<std::map<ComponentId, std::uint64_t>> corners(report_.components.size());
    for (const BoundaryFace& face : match.boundary) {
      for (const std::uint32_t tet : {face.behind, face.front}) {
        if (tet == kNone || component_of[tet] == kNone) continue;
        const std::uint32_t mine = component_of[tet];
        for (const VertexId v : face.vertices) {
          if (const auto id = id_of(patches.at(v), report_.components[mine].region)) ++corners[mine][*id];
        }
      }
    }
    std::map<std::pair<Region, ComponentId>, std::uint64_t> parts;
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const auto most = most_votes(corners[n]);
      if (most != corners[n].end()) ++parts[{report_.components[n].region, most->first}];
    }
    Tally tally{"audit.component_split"};
    for (const ListedComponent& listed : listed_) {
      const Region region = listed.component.region;
      std::map<ComponentId, int> votes;
      for (const Patch& patch : listed.walls) {
        if (const auto id = id_of(patch, region)) ++votes[*id];
      }
      const auto own = most_votes(votes);
      if (region == kOutside || own == votes.end()) continue;
      const auto found = parts.find({region, own->first});
      if (found == parts.end() || found->second < 2) continue;
      tally.hit(listed.component.witness,
                [&] { return size_text(listed.component) + ", in " + std::to_string(found->second) + " parts"; });
    }
    record(tally, report_);
  }

  /// Cavities that no surface of the mesh is the wall of, being in one with others, and the mesh's that are a part of
  /// one, or of what is no cavity.
  void place_cavities() {
    Tally counted{"audit.cavity_count"};
    for (auto& [i, walls] : walls_) {
      std::sort(walls.begin(), walls.end(), [&](std::uint32_t a, std::uint32_t b) { return volume(a) > volume(b); });
      for (std::size_t n = i == listed_.size() ? 0 : 1; n < walls.size(); ++n) {
        counted.hit(report_.cavity_walls[walls[n]].box_mm.center(), [] { return "a cavity of the mesh"; });
      }
    }
    for (const auto& [id, i] : cavity_of_) {
      if (i == listed_.size() || cavities_.contains(i)) continue;
      counted.hit(listed_[i].component.witness, [&, i = i] { return size_text(listed_[i].component); });
    }
    place(counted);
  }

  void compare() {
    HandleLedger ledger;
    if (are_all_) ledger.domain_euler = 0;
    ledger.expected_handles = 0;
    Tally tally{"audit.handles"};
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      const Component& component = listed_[i].component;
      if (component.region == kOutside) continue;
      ledger.unknown += component.euler ? 0 : 1;
      ledger.domain_euler = known_sum(ledger.domain_euler, component.euler);
      const std::uint32_t partner = partner_of_[i];
      if (!component.euler || partner == kNone || listed_of_.at(partner) != 1) continue;
      const MeshComponent& mine = report_.components[partner];
      const HandleDifference difference{component, mine.boundary_euler, mine.surfaces};
      ++ledger.compared;
      ledger.expected_euler += *component.euler;
      ledger.euler += difference.euler;
      ledger.expected_handles = known_sum(ledger.expected_handles, component.handles());
      ledger.handles += difference.handles();
      judge(difference, ledger, tally);
    }
    if (ledger.compared == 0) return;
    ledger.compared_cavities = cavities_.size();
    for (const auto& [i, sum] : cavities_) judge({listed_[i].component, sum.euler, sum.surfaces}, ledger, tally);
    record(tally, report_);
    report_.handle_ledger = std::move(ledger);
  }

 private:
  struct SurfaceSum {
    std::int64_t euler = 0;
    std::uint64_t surfaces = 0;
  };

  /// Which component of that region the patch bounds.
  static std::optional<ComponentId> id_of(const Patch& patch, Region region) {
    if (patch.regions[0] == region) return patch.components[0];
    return patch.regions[1] == region ? std::optional(patch.components[1]) : std::nullopt;
  }

  /// Of the outside, that most of the walls are of; none if there are no such walls.
  static std::optional<ComponentId> outside_component(const std::vector<Patch>& walls) {
    std::map<ComponentId, int> votes;
    for (const Patch& patch : walls) {
      if (patch.regions[0] == kOutside) ++votes[patch.components[0]];
    }
    return votes.empty() ? std::nullopt : std::optional(most_votes(votes)->first);
  }

  static constexpr ComponentId kNotToldApart = 0;  // by such domains; of others the unbounded outside, no cavity

  static void judge(const HandleDifference& difference, HandleLedger& ledger, Tally& tally) {
    const Component& component = difference.component;
    const auto handles = component.handles();
    if (handles ? *handles == difference.handles() : *component.euler == difference.euler) return;
    ledger.different.push_back(difference);
    tally.hit(component.witness, [&] { return describe(difference); });
  }

  double volume(std::uint32_t wall) const { return report_.cavity_walls[wall].volume_mm3; }

  /// Gives a finding that counts these its places, if there is one.
  void place(const Tally& counted) {
    for (Finding& finding : report_.findings) {
      if (counted.count == 0 || finding.code != counted.code) continue;
      finding.where = counted.places.front();
      finding.places = counted.places;
    }
  }

  void pair(std::size_t listed, std::uint32_t partner) {
    partner_of_[listed] = partner;
    ++listed_of_[partner];
  }

  static std::string size_text(const Component& component) {
    const std::string text = component.region == kOutside ? "the cavity" : "the one";
    return component.volume_mm3 > 0 ? text + " of about " + number_text(component.volume_mm3, 4) + " mm3" : text;
  }

  static std::string describe(const HandleDifference& difference) {
    const Component& component = difference.component;
    const std::string text = size_text(component);
    if (const auto handles = component.handles()) {
      return text + " with " + std::to_string(difference.handles()) + " in the mesh, " + std::to_string(*handles) +
             " in the domain";
    }
    return text + " with the Euler number " + std::to_string(difference.euler) + " in the mesh, " +
           std::to_string(*component.euler) + " in the domain";
  }

  const std::vector<ListedComponent>& listed_;
  bool are_all_;
  AuditReport& report_;
  std::vector<std::uint32_t> partner_of_;         // of each listed component: the one of the mesh, or kNone
  std::map<ComponentId, std::size_t> cavity_of_;  // listed; of a part of the outside with several: listed_.size()
  std::map<std::size_t, SurfaceSum> cavities_;    // what the mesh has around and within each listed cavity
  std::map<std::size_t, std::vector<std::uint32_t>> walls_;  // of these, and of the others, in cavity_walls
  std::map<std::uint32_t, int> listed_of_;  // of each component of the mesh that is one's partner: of how many
};

}  // namespace

void check_handles(const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                   const OutsideSurfaces& outside, const std::vector<ListedComponent>& listed, bool are_all,
                   const VertexPatches* patches, AuditReport& report) {
  const auto is_known = [](const ListedComponent& l) { return l.component.region != kOutside && l.component.euler; };
  if (std::none_of(listed.begin(), listed.end(), is_known)) return;
  HandleCheck check(listed, are_all, report);
  if (patches != nullptr) {
    check.pair_by_patches(match, component_of, *patches);
    check.find_joined();
    if (!are_all) check.find_split(match, component_of, *patches);
    check.measure_cavities(match, outside, *patches);
    if (are_all) check.place_cavities();
  } else {
    check.pair_by_regions();
  }
  check.compare();
}

}  // namespace scantet::auditing
