#include "scantet/labels/label_values.h"

namespace scantet {

NodeSet::NodeSet(const std::array<int, 3>& size)
    : row_(static_cast<std::size_t>(size[0]) + 2), rows_(static_cast<std::size_t>(size[1]) + 2) {
  bits_.assign((row_ * rows_ * (static_cast<std::size_t>(size[2]) + 2) + 63) / 64, 0);
}

void NodeSet::number() {
  before_.resize(bits_.size());
  count_ = 0;
  for (std::size_t word = 0; word < bits_.size(); ++word) {
    before_[word] = static_cast<std::uint32_t>(count_);
    count_ += static_cast<std::size_t>(std::popcount(bits_[word]));
  }
}

std::vector<std::size_t> NodeSet::positions() const {
  std::vector<std::size_t> all;
  all.reserve(count_);
  for (std::size_t word = 0; word < bits_.size(); ++word) {
    for (std::uint64_t left = bits_[word]; left != 0; left &= left - 1) {
      all.push_back(word * 64 + static_cast<std::size_t>(std::countr_zero(left)));
    }
  }
  return all;
}

}  // namespace scantet
