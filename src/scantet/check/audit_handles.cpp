// A patch belongs to the component of the mesh, of the same region, that has most of the facets' corners on it, and a
// component of the domain to that of most of the patches around its witness: where surfaces nearly touch, rounding may
// put the one or other point on a wrong one. Where that pairs components one to one, their boundaries must have as many
// handles, or the same Euler number where the domain does not know how many surfaces there are. The mesh's come from
// its facets (audit_boundary.cpp).
#include <algorithm>
#include <map>

#include "scantet/base/known_sum.h"
#include "scantet/base/options.h"
#include "scantet/check/audit_impl.h"

namespace scantet::auditing {
namespace {

class HandleCheck {
 public:
  HandleCheck(const std::vector<ListedComponent>& listed, AuditReport& report)
      : listed_(listed), report_(report), partner_of_(listed.size(), kNone) {}

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
      const auto chosen = std::max_element(votes.begin(), votes.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
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

  void compare() {
    HandleLedger ledger;
    ledger.domain_euler = 0;
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
      const auto handles = component.handles();
      if (handles ? *handles == difference.handles() : *component.euler == difference.euler) continue;
      ledger.different.push_back(difference);
      tally.hit(component.witness, [&] { return describe(difference); });
    }
    if (ledger.compared == 0) return;
    record(tally, report_);
    report_.handle_ledger = std::move(ledger);
  }

 private:
  void pair(std::size_t listed, std::uint32_t partner) {
    partner_of_[listed] = partner;
    ++listed_of_[partner];
  }

  static std::string describe(const HandleDifference& difference) {
    const Component& component = difference.component;
    std::string text = "the one";
    if (component.volume_mm3 > 0) text += " of about " + number_text(component.volume_mm3, 4) + " mm3";
    if (const auto handles = component.handles()) {
      return text + " with " + std::to_string(difference.handles()) + " in the mesh, " + std::to_string(*handles) +
             " in the domain";
    }
    return text + " with the Euler number " + std::to_string(difference.euler) + " in the mesh, " +
           std::to_string(*component.euler) + " in the domain";
  }

  const std::vector<ListedComponent>& listed_;
  AuditReport& report_;
  std::vector<std::uint32_t> partner_of_;   // of each listed component: the one of the mesh, or kNone
  std::map<std::uint32_t, int> listed_of_;  // of each component of the mesh that is one's partner: of how many
};

}  // namespace

void check_handles(const FaceMatch& match, const std::vector<std::uint32_t>& component_of,
                   const std::vector<ListedComponent>& listed, const VertexPatches* patches, AuditReport& report) {
  const auto is_known = [](const ListedComponent& l) { return l.component.region != kOutside && l.component.euler; };
  if (std::none_of(listed.begin(), listed.end(), is_known)) return;
  HandleCheck check(listed, report);
  if (patches != nullptr) {
    check.pair_by_patches(match, component_of, *patches);
  } else {
    check.pair_by_regions();
  }
  check.compare();
}

}  // namespace scantet::auditing
