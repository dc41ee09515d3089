// Nothing should be thrown here: an Error of the plugin counts as a fault, like any other exception.
#include "scantet/base/child_process.h"
#include "scantet/base/error.h"
#include "scantet/plugin/plugin_trial_impl.h"

namespace scantet {

std::string try_in_child(const std::function<void()>& act) {
  constexpr double kMost_s = 10;
  ChildProcess child({0, kMost_s, 0}, [&](ChildLine&) { act(); });
  try {
    child.await_step();
  } catch (const ChildFailure& failure) {
    return failure.what();
  } catch (const Error& error) {
    return std::string("throws: ") + error.what();
  }
  return {};
}

}  // namespace scantet
