// Names that are to differ from each other. Private to io/.
#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace scantet {

/// Names of which no two are the same in capitals.
class TakenNames {
 public:
  TakenNames(std::initializer_list<std::string> names = {}) : taken_(names) {}

  /// The name, or the first of name_2, name_3 ... that is not taken, neither as it is nor after `prefix`. Both are
  /// then.
  std::string distinct(const std::string& name, const std::string& prefix = "");

 private:
  bool take(const std::string& name, const std::string& prefix);

  std::set<std::string> taken_;                              // in capitals
  std::map<std::pair<std::string, std::string>, int> next_;  // by name and prefix: no number below is free
};

}  // namespace scantet
