// What an action is refused with.
#pragma once

#include <string>

#include "scantet/base/error.h"

namespace scantet::test {

/// The code of the Error that the action throws; empty if it throws none.
template <class Act>
std::string error_code(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.code();
  }
  return "";
}

}  // namespace scantet::test
