// VTK prints what goes wrong; this collects it instead. Private to io/.
#pragma once

#include <memory>
#include <string>

namespace scantet {

/// While it lives, VTK's errors go here and nothing of VTK's reaches standard error. VTK has one output window and one
/// log a process: a second object waits, in its constructor, for the first to go.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  bool failed() const;
  /// The first error, on one line, without VTK's source file and object address; empty if there is none.
  std::string first_error() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scantet
