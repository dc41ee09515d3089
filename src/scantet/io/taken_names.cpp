// Numbers are counted on from where the last search for the same name ended: a file may have one name a million times.
#include <algorithm>

#include "scantet/io/taken_names_impl.h"

namespace scantet {

std::string in_capitals(std::string_view name) {
  std::string text(name);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
  return text;
}

std::string TakenNames::distinct(const std::string& name, const std::string& prefix) {
  if (take(name, prefix)) return name;
  int& number = next_.emplace(std::pair(in_capitals(name), prefix), 2).first->second;
  while (true) {
    const std::string numbered = name + "_" + std::to_string(number++);
    if (take(numbered, prefix)) return numbered;
  }
}

bool TakenNames::take(const std::string& name, const std::string& prefix) {
  const std::string plain = in_capitals(name);
  const std::string prefixed = in_capitals(prefix + name);
  if (taken_.contains(plain) || taken_.contains(prefixed)) return false;
  taken_.insert(plain);
  taken_.insert(prefixed);
  return true;
}

}  // namespace scantet
