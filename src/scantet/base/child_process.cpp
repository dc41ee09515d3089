// A step is a byte: done, a note, an Error, or the text of another exception. Whatever else happens to the child (a
// signal, exit, a limit) is seen from outside, when the line ends too early. The terminate handler names what static
// objects of a library throw while it is loaded, which nobody can catch. Only soft limits are set, so that the child
// may set them anew when it knows how much there is to do.
//
// A copy of a process with threads may wait for ever for a lock that one of them held. No limit of processor time ends
// that, so the parent looks at a child that says nothing: time counts while it sleeps, not while it works, waits for a
// disk, or is held by a debugger or the terminal.
#include "scantet/base/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <exception>
#include <fstream>
#include <sstream>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/sanitizers.h"

namespace scantet {
namespace {

constexpr char kDone = '.';
constexpr char kNote = 'N';
constexpr char kError = 'E';
constexpr char kThrown = 'T';
constexpr std::size_t kLongestText = 1 << 20;
constexpr double kMega = 1e6;
ChildLine* line_of_child = nullptr;

[[noreturn]] void name_exception() {
  std::string text = "calls std::terminate";
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::exception& error) {
    text = std::string("throws: ") + error.what();
  } catch (...) {
    text = "throws something that is no std::exception";
  }
  line_of_child->put(kThrown);
  line_of_child->put_text(text);
  _exit(0);
}

// The child inherits the program's signal handlers and its terminal; neither is for it. The parent tells it to stop.
void be_quiet() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGXCPU, SIGTERM, SIGPIPE}) {
    std::signal(signal, SIG_DFL);
  }
  std::signal(SIGINT, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
}

void work_noexcept(const std::function<void(ChildLine&)>& work, ChildLine& line) noexcept {
  try {
    work(line);
  } catch (const Error& error) {
    std::string what = error.what();
    const std::string tail = "; " + error.remedy();
    if (!error.remedy().empty() && what.ends_with(tail)) what.resize(what.size() - tail.size());
    line.put(kError);
    line.put(error.fault());
    for (const std::string& text : {error.code(), what, error.remedy()}) line.put_text(text);
    _exit(0);
  } catch (...) {
    name_exception();
  }
}

void set_soft_limit(__rlimit_resource resource, double value) {
  rlimit limit;
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = static_cast<rlim_t>(std::min(value, 1e18));
  if (limit.rlim_max != RLIM_INFINITY) limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  setrlimit(resource, &limit);
}

void limit_memory([[maybe_unused]] double bytes) {
#if !defined(SCANTET_IS_SANITIZED)
  std::ifstream statistics("/proc/self/statm");
  std::array<double, 6> pages{};  // the sixth: data and stack
  for (double& count : pages) statistics >> count;
  if (statistics) set_soft_limit(RLIMIT_DATA, pages[5] * static_cast<double>(sysconf(_SC_PAGE_SIZE)) + bytes);
#endif
}

/// What a process is at, as the system tells it.
struct Activity {
  char state = '?';         ///< 'S': it sleeps, and waits for no disk
  std::uint64_t ticks = 0;  ///< of processor time, of all its threads
};

/// Source: proc(5), /proc/pid/stat; the second word is the name, in brackets, and may have blanks and brackets.
Activity activity_of(int process) {
  constexpr int kBeforeTimes = 10;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream words(text.substr(name_end + 1));
  Activity activity;
  words >> activity.state;
  std::string skipped;
  for (int word = 0; word < kBeforeTimes; ++word) words >> skipped;
  std::uint64_t user = 0;
  std::uint64_t system = 0;
  words >> user >> system;
  activity.ticks = user + system;
  return activity;
}

std::string ending_of(int status, const ChildLimits& limits) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGALRM || signal == SIGXCPU) {
    std::ostringstream text;
    text << "does not end within " << (signal == SIGALRM ? limits.wall_s : limits.cpu_s) << " s"
         << (signal == SIGXCPU ? " of processor time" : "");
    return text.str();
  }
  if (signal != 0) return std::string("crashes: ") + strsignal(signal);
  return "ends the process, with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

ChildLimits limits_for(double bytes, double s_per_mb, double bytes_per_byte) {
  constexpr double kLeastMemory = 512 * 1024.0 * 1024.0;
  return {10 + s_per_mb * bytes / kMega, 0, kLeastMemory + bytes_per_byte * bytes};
}

void limit_this_process(const ChildLimits& limits) {
  if (limits.cpu_s > 0) {
    rusage used;
    getrusage(RUSAGE_SELF, &used);
    const auto so_far = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1);
    set_soft_limit(RLIMIT_CPU, std::ceil(so_far + limits.cpu_s));
  }
  if (limits.wall_s > 0) alarm(static_cast<unsigned>(std::ceil(limits.wall_s)));
  if (limits.memory_bytes > 0) limit_memory(limits.memory_bytes);
}

ChildLine::ChildLine(int descriptor, bool in_child, std::function<bool()> stop)
    : descriptor_(descriptor), in_child_(in_child), stop_(std::move(stop)) {}

/// The parent sends what the line takes at once: in a call that waits it would look neither at stop() nor at the child.
void ChildLine::send(const void* bytes, std::size_t count) {
  const int flags = in_child_ ? MSG_NOSIGNAL : MSG_NOSIGNAL | MSG_DONTWAIT;
  for (const char* from = static_cast<const char*>(bytes); count > 0;) {
    if (!in_child_) await(POLLOUT);
    const ssize_t sent = ::send(descriptor_, from, count, flags);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (sent < 0 && in_child_) _exit(1);
    if (sent < 0) throw ChildFailure("has ended");
    from += sent;
    count -= static_cast<std::size_t>(sent);
  }
}

/// Looks are counted, not the clock, which goes on while the machine or the parent is halted.
void ChildLine::await(short event) {
  constexpr int kPoll_ms = 100;
  if (descriptor_ < 0) throw ChildFailure("has ended");
  double asleep_ms = 0;
  Activity last;
  for (;;) {
    if (stop_ && stop_()) throw ChildStopped{};
    pollfd watched{descriptor_, event, 0};
    const int ready = poll(&watched, 1, kPoll_ms);
    if (ready > 0) return;
    if (ready < 0 || watched_ < 0 || idle_s_ <= 0) continue;
    const Activity now = activity_of(watched_);
    if (now.state == 'Z' && last.state == 'Z')
      throw ChildFailure("has ended");  // and another holds its end of the line
    asleep_ms = now.state == 'S' && now.ticks == last.ticks ? asleep_ms + kPoll_ms : 0;
    last = now;
    if (asleep_ms < 1000 * idle_s_) continue;
    fell_asleep_ = true;
    throw ChildFailure("has fallen asleep");
  }
}

void ChildLine::receive(void* bytes, std::size_t count) {
  for (char* to = static_cast<char*>(bytes); count > 0;) {
    if (!in_child_) await(POLLIN);
    const ssize_t got = recv(descriptor_, to, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 && in_child_) _exit(1);
    if (got <= 0) throw ChildFailure("has ended");
    to += got;
    count -= static_cast<std::size_t>(got);
  }
}

void ChildLine::put_text(const std::string& text) {
  const std::size_t length = std::min(text.size(), kLongestText);
  put(length);
  send(text.data(), length);
}

std::string ChildLine::take_text() {
  const auto length = take<std::size_t>();
  if (length > kLongestText) throw ChildFailure("sends nonsense");
  std::string text(length, '\0');
  receive(text.data(), length);
  return text;
}

void ChildLine::step() {
  put(kDone);
}

void ChildLine::note(const std::string& doing, std::uint64_t done, std::uint64_t total) {
  put(kNote);
  put_text(doing);
  put(done);
  put(total);
}

ChildProcess::ChildProcess(const ChildLimits& limits, const std::function<void(ChildLine&)>& work,
                           std::function<bool()> stop)
    : limits_(limits), child_(-1), line_(-1, false, std::move(stop)) {
  std::array<int, 2> ends;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw Error(Fault::internal, "internal.fork", "no line to a child process can be made");
  }
  child_ = fork();
  if (child_ == 0) {
    close(ends[0]);
    ChildLine line(ends[1], true);
    line_of_child = &line;
    be_quiet();
    std::set_terminate(name_exception);
    limit_this_process(limits);
    work_noexcept(work, line);
    line.step();
    _exit(0);
  }
  close(ends[1]);
  line_.descriptor_ = ends[0];
  line_.watched_ = child_;
  line_.idle_s_ = limits.idle_s;
  if (child_ > 0) return;
  close(ends[0]);
  throw Error(Fault::internal, "internal.fork", "no child process can be made");
}

ChildProcess::~ChildProcess() {
  end();
}

/// The number of a closed descriptor may soon be that of another one, so the line forgets it.
int ChildProcess::end() {
  if (child_ < 0) return 0;
  int status = 0;
  kill(child_, SIGKILL);
  while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  close(line_.descriptor_);
  line_.descriptor_ = -1;
  line_.watched_ = -1;
  return status;
}

void ChildProcess::await_step(const ChildLine::Note& note) {
  take([&](ChildLine& line) {
    for (char what = line.take<char>(); what != kDone; what = line.take<char>()) {
      if (what == kNote) {
        const std::string doing = line.take_text();
        const auto done = line.take<std::uint64_t>();
        const auto total = line.take<std::uint64_t>();
        if (note) note(doing, done, total);
      } else if (what == kError) {
        const auto fault = line.take<Fault>();
        std::string texts[3];
        for (std::string& text : texts) text = line.take_text();
        throw Error(fault, texts[0], texts[1], texts[2]);
      } else if (what == kThrown) {
        const std::string text = line.take_text();
        end();
        throw ChildFailure(text);
      } else {
        throw ChildFailure("sends nonsense");
      }
    }
  });
}

// The line broke: a process closes it when it has ended, so the signal only meets a child that sends nonsense or has
// fallen asleep.
void ChildProcess::fail() {
  if (child_ < 0) throw;
  const int status = end();
  if (!line_.fell_asleep_) throw ChildFailure(ending_of(status, limits_));
  std::ostringstream text;
  text << "waits, without doing anything, for more than " << limits_.idle_s << " s";
  throw ChildFailure(text.str());
}

}  // namespace scantet
