// Two sweeps of each slab with the same labels. The first joins them: along grid edges run by run, then through the
// faces and bodies of the few cells whose corners leave that open. The second measures the components. The slabs are
// then sewn together at the layers they share.
#include "scantet/topology/level_slabs.h"

#include "scantet/base/parallel.h"
#include "scantet/topology/cell_euler.h"

namespace scantet {

void LevelSlab::join(const HeightGrid& heights, const Progress& progress) {
  UnionFind sets;
  sets.add();  // kUnboundedLabel
  RunSweep sweep(heights, first, last);
  while (!progress.cancelled() && sweep.advance(&sets)) {
    has_zeros = has_zeros || sweep.layer().has_zeros;
    if (sweep.k() == first) first_parts = sweep.layer().label;
    if (sweep.k() > first) join_cells(heights, sweep, sets, contacts);
  }
  join_contacts(contacts, sets);
  last_parts = sweep.layer().label;
  measures.resize(sets.number_sets(number_of));
  for (std::uint32_t& part : first_parts) part = number_of[part];
  for (std::uint32_t& part : last_parts) part = number_of[part];
  std::erase_if(contacts, [&](const LevelContact& contact) {
    return !is_in_layer(contact, heights, first) && !is_in_layer(contact, heights, last);
  });
  for (LevelContact& contact : contacts) contact.label = number_of[contact.label];
}

void LevelSlab::measure(const HeightGrid& heights, const Progress& progress) {
  std::vector<std::int64_t> eighths(measures.size());
  RunSweep sweep(heights, first, last);
  while (!progress.cancelled() && sweep.advance(nullptr)) {
    if (sweep.k() > first) add_cell_shares(heights, sweep, number_of, eighths);
    if (sweep.k() == last) break;  // it is the first layer of the slab above
    visit_layer(heights, sweep, [&](int begin, int end, int j, int k, int side, std::uint32_t label) {
      const std::uint32_t part = number_of[label];
      surfaces.add_run(begin == 0, end == heights.size()[0], side, part);
      if (part != 0) measures[part].add(heights, begin, end, j, k, side > 0);
    });
  }
  for (std::size_t part = 0; part < measures.size(); ++part) measures[part].eighths = eighths[part];
}

std::vector<LevelSlab> make_level_slabs(const HeightGrid& heights, const Progress& progress) {
  constexpr int kHeight = 32;
  const int cells = heights.size()[2] + 1;
  std::vector<LevelSlab> slabs((cells + kHeight - 1) / kHeight);
  parallel_for(slabs.size(), 1, [&](std::size_t n, std::size_t) {
    LevelSlab& slab = slabs[n];
    slab.first = static_cast<int>(n) * kHeight - 1;
    slab.last = std::min(slab.first + kHeight, cells - 1);
    slab.join(heights, progress);
    slab.measure(heights, progress);
  });
  return slabs;
}

std::vector<Measure> sew(std::vector<LevelSlab>& slabs) {
  std::vector<std::uint32_t> offsets;
  std::uint32_t parts = 0;
  for (const LevelSlab& slab : slabs) {
    offsets.push_back(parts);
    parts += static_cast<std::uint32_t>(slab.measures.size());
  }
  UnionFind sets(parts);
  for (std::size_t n = 0; n + 1 < slabs.size(); ++n) {
    for (std::size_t run = 0; run < slabs[n].last_parts.size(); ++run) {
      sets.unite(offsets[n] + slabs[n].last_parts[run], offsets[n + 1] + slabs[n + 1].first_parts[run]);
    }
  }
  std::vector<LevelContact> contacts;
  for (std::size_t n = 0; n < slabs.size(); ++n) {
    for (LevelContact contact : slabs[n].contacts) {
      contact.label += offsets[n];
      contacts.push_back(contact);
    }
  }
  join_contacts(contacts, sets);
  std::vector<std::uint32_t> component_of;
  std::vector<Measure> measures(sets.number_sets(component_of));
  for (std::size_t n = 0; n < slabs.size(); ++n) {
    for (std::size_t part = 0; part < slabs[n].measures.size(); ++part) {
      measures[component_of[offsets[n] + part]].merge(slabs[n].measures[part]);
    }
    for (std::uint32_t& number : slabs[n].number_of) number = component_of[offsets[n] + number];
    slabs[n].surfaces.renumber([&](std::uint32_t part) { return component_of[offsets[n] + part]; });
  }
  return measures;
}

}  // namespace scantet
