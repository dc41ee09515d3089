// Numbers are counted on from where the last search for the same name ended: a file may have one name a million times.
#include "scantet/base/ascii_text.h"
#include "scantet/io/taken_names_impl.h"

namespace scantet {

std::string TakenNames::distinct(const std::string& name, const std::string& prefix) {
  if (take(name, prefix)) return name;
  int& number = next_.emplace(std::pair(ascii_upper(name), prefix), 2).first->second;
  while (true) {
    std::string numbered = name + "_" + std::to_string(number++);
    if (take(numbered, prefix)) return numbered;
  }
}

bool TakenNames::take(const std::string& name, const std::string& prefix) {
  const std::string plain = ascii_upper(name);
  const std::string prefixed = ascii_upper(prefix + name);
  if (taken_.contains(plain) || taken_.contains(prefixed)) return false;
  taken_.insert(plain);
  taken_.insert(prefixed);
  return true;
}

}  // namespace scantet
