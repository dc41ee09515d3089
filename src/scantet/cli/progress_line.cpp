// Rates are exponential averages over about three seconds. While refining nobody knows the final number of vertices, so
// the time left is what the queue of pending elements needs at the rate at which it has been shrinking: an estimate,
// and marked as one.
#include "scantet/cli/progress_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "scantet/cli/interrupt.h"

namespace scantet {
namespace {

constexpr double kRedrawEvery_s = 0.1;
constexpr double kMeasureEvery_s = 0.5;
constexpr double kMemory_s = 3;

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

// 139552 -> "139,552"
std::string grouped(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (int i = static_cast<int>(digits.size()) - 3; i > 0; i -= 3) digits.insert(static_cast<std::size_t>(i), ",");
  return digits;
}

std::string duration(double seconds) {
  const auto whole = static_cast<std::uint64_t>(std::ceil(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace

bool error_is_terminal() {
  return isatty(STDERR_FILENO) == 1;
}

bool ProgressLine::cancelled() const {
  return interrupted();
}

void ProgressLine::report(const ProgressState& state) {
  if (!visible_) return;
  const double now_s = std::chrono::duration<double>(Clock::now() - start_).count();
  // While a mesh is made, what is being done changes too often; elsewhere each part may take long.
  const bool makes_mesh = state.stage == "sample" || state.stage == "refine" || state.stage == "optimize";
  const bool is_new_part = !makes_mesh && state.doing != doing_;
  if (state.stage != stage_) {
    start_stage(state, now_s);
  } else if (!is_new_part && now_s - drawn_s_ < kRedrawEvery_s) {
    return;
  }
  doing_ = state.doing;
  measure(state, now_s);
  std::string text = line(state, now_s);
  const std::size_t width = terminal_width();
  if (text.size() + 1 > width) text.resize(width - 1);
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
  drawn_ = true;
  drawn_s_ = now_s;
}

void ProgressLine::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void ProgressLine::start_stage(const ProgressState& state, double now_s) {
  stage_ = state.stage;
  measured_s_ = now_s;
  measured_done_ = state.done;
  measured_pending_ = state.pending;
  done_rate_ = 0;
  pending_rate_ = 0;
}

void ProgressLine::measure(const ProgressState& state, double now_s) {
  const double passed_s = now_s - measured_s_;
  if (passed_s < kMeasureEvery_s) return;
  const double done = (static_cast<double>(state.done) - static_cast<double>(measured_done_)) / passed_s;
  const double shrunk = (static_cast<double>(measured_pending_) - static_cast<double>(state.pending)) / passed_s;
  const double weight = done_rate_ == 0 ? 1 : 1 - std::exp(-passed_s / kMemory_s);
  done_rate_ += weight * (done - done_rate_);
  pending_rate_ += weight * (shrunk - pending_rate_);
  measured_s_ = now_s;
  measured_done_ = state.done;
  measured_pending_ = state.pending;
}

std::string ProgressLine::line(const ProgressState& state, double now_s) {
  std::string text(state.stage);
  if (!state.doing.empty()) text += " " + std::string(state.doing);
  const bool counts_vertices = state.stage == "refine" || state.stage == "sample";
  if (state.done > 0 && (counts_vertices || !state.total)) {
    text += "  " + grouped(state.done) + (counts_vertices ? " vertices" : "");
  }
  if (state.total && *state.total > 0) {
    text +=
        "  " +
        std::to_string(static_cast<int>(100.0 * static_cast<double>(state.done) / static_cast<double>(*state.total))) +
        " %";
  }
  if (state.pending > 0) text += "  " + grouped(state.pending) + " pending";
  if (counts_vertices && done_rate_ > 0) text += "  " + grouped(static_cast<std::uint64_t>(done_rate_)) + "/s";
  double left_s = -1;
  if (state.total && done_rate_ > 0 && *state.total >= state.done) {
    left_s = static_cast<double>(*state.total - state.done) / done_rate_;
  } else if (state.pending > 0 && pending_rate_ > 0) {
    left_s = static_cast<double>(state.pending) / pending_rate_;
  }
  text += "  " + duration(std::floor(now_s));
  if (left_s >= 0 && left_s < 100 * 3600) text += ", ~" + duration(left_s) + " left";
  return text;
}

}  // namespace scantet
