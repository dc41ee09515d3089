// What the library throws when the caller or the data is at fault. Expected endings (converged, cancelled, limit) are
// values, not errors.
#pragma once

#include <stdexcept>
#include <string>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// Who is at fault. The values are the command line's exit statuses.
enum class Fault {
  internal = 1,  ///< a bug in scantet, in a plugin or in the program that calls it
  usage = 2,     ///< an option or argument is wrong
  input = 3,     ///< a file cannot be read, or it or other data make no sense
  output = 5,    ///< a file cannot be written
};

/// One failure: who is at fault, a stable code for programs ("input.nan"), a sentence for people and the remedy.
/// docs/errors.md lists the codes.
class Error : public std::runtime_error {
 public:
  /// what: a clause naming the place (file, option) and the value. remedy: what to do about it; may be empty. what() is
  /// both, with a semicolon between them.
  Error(Fault fault, std::string code, const std::string& what, std::string remedy = {})
      : std::runtime_error(remedy.empty() ? what : what + "; " + remedy),
        fault_(fault),
        code_(std::move(code)),
        remedy_(std::move(remedy)) {}

  Fault fault() const { return fault_; }                 ///< who is at fault
  const std::string& code() const { return code_; }      ///< stable, "input.nan"
  const std::string& remedy() const { return remedy_; }  ///< what to do about it; what() ends with it; may be empty

 private:
  Fault fault_;
  std::string code_;
  std::string remedy_;
};

}  // namespace scantet
