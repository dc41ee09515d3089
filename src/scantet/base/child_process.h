// Work on untrusted bytes, done in a process of its own.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"

namespace SCANTET_API scantet {

/// What a child process may take from now on; 0 sets no limit. A build with AddressSanitizer or ThreadSanitizer has no
/// limit of memory.
struct ChildLimits {
  double cpu_s = 10;        ///< of processor time, to within two seconds
  double wall_s = 0;        ///< of time on the wall, rounded up to whole seconds
  double memory_bytes = 0;  ///< of writable memory, beyond what there is
  double idle_s = 60;       ///< that the parent waits for a child that sleeps all the time
};

/// Limits for reading `bytes` bytes: of processor time 10 s and s_per_mb for each 10⁶ bytes, of memory 512 MiB and
/// bytes_per_byte times the bytes; no limit of time on the wall.
ChildLimits limits_for(double bytes, double s_per_mb = 1, double bytes_per_byte = 4);

/// Sets the limits of this process, in place of those that it has, but for idle_s, which is the parent's; one that is 0
/// stays as it is. Called in a child that knows by now how much there is to do.
void limit_this_process(const ChildLimits& limits);

/// The child ended before it had sent all that was asked for. what(): how it ended, as the rest of a sentence:
/// "crashes: Segmentation fault".
struct ChildFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// Thrown in the parent: stop() became true.
struct ChildStopped {};

/// One end of the line between a process and its child. In the child, a line that breaks ends the process. For one
/// thread.
class ChildLine {
 public:
  /// What the child says of its progress: note(what, done, of how many); the total is 0 if it is not known.
  using Note = std::function<void(const std::string& doing, std::uint64_t done, std::uint64_t total)>;

  /// descriptor: of a socket, which others keep open and close. stop: polled while the parent waits for bytes, or for
  /// the child to take some; may be empty.
  ChildLine(int descriptor, bool in_child, std::function<bool()> stop = {});

  /// Sends all `count` bytes. In the parent it throws ChildFailure (also if the child sleeps for ChildLimits::idle_s),
  /// ChildStopped.
  void send(const void* bytes, std::size_t count);
  /// Takes all `count` bytes. Throws as send().
  void receive(void* bytes, std::size_t count);
  /// Sends the bytes of a value, as send().
  template <class Value>
  void put(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    send(&value, sizeof value);
  }
  /// Receives what put() sent, as receive(). Both ends must mean the same type.
  template <class Value>
  Value take() {
    static_assert(std::is_trivially_copyable_v<Value>);
    Value value;
    receive(&value, sizeof value);
    return value;
  }
  /// Sends a text, or its first 1 MiB if it is longer.
  void put_text(const std::string& text);
  /// Takes a text of 1 MiB at most. Throws ChildFailure if it is longer, and as receive().
  std::string take_text();

  /// In the child: says that a step of the work is done, which ChildProcess::await_step() waits for.
  void step();
  /// In the child: says how far the work is. total: 0 if it is not known.
  void note(const std::string& doing, std::uint64_t done, std::uint64_t total);

 private:
  friend class ChildProcess;
  void await(short event);  // of poll()

  int descriptor_;
  bool in_child_;
  std::function<bool()> stop_;
  int watched_ = -1;  // the parent's: the process at the other end
  double idle_s_ = 0;
  bool fell_asleep_ = false;
};

/// What is reported to it in a child goes to the parent, as notes.
class SentProgress final : public Progress {
 public:
  /// line: must outlive it.
  explicit SentProgress(ChildLine& line) : line_(line) {}
  void report(const ProgressState& state) override {
    line_.note(std::string(state.doing), state.done, state.total.value_or(0));
  }

 private:
  ChildLine& line_;
};

/// Runs work(line) in a child process that is a copy of this one, without its other threads: the work must start none.
/// It has no standard input or output, and speaks through the line. The end of the work is its last step. Destroyed,
/// the object ends the child. After await_step() or take() has thrown ChildFailure, there is no child, and the line
/// throws ChildFailure whenever it is used.
class ChildProcess {
 public:
  /// stop: as of ChildLine. Throws Error: internal.fork (no process or no line to it can be made).
  ChildProcess(const ChildLimits& limits, const std::function<void(ChildLine&)>& work, std::function<bool()> stop = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for the next step. note: called on this thread for what the child says meanwhile; empty: nobody listens.
  /// Throws the Error that the work threw; ChildFailure for any other exception, if the child ended in any other way,
  /// sent nonsense or slept too long; ChildStopped.
  void await_step(const ChildLine::Note& note = {});
  /// Calls act(line), which takes the data of the step, and returns what it returns. Throws ChildFailure, with how the
  /// child ended, and ChildStopped.
  template <class Act>
  auto take(const Act& act) {
    try {
      return act(line_);
    } catch (const ChildFailure&) {
      fail();
    }
  }
  /// The parent's end; valid as long as this object.
  ChildLine& line() { return line_; }

 private:
  [[noreturn]] void fail();
  int end();  // the status that the child ended with

  ChildLimits limits_;
  int child_;
  ChildLine line_;
};

}  // namespace scantet
