// Messages stay one line whatever a file name or a third party puts into them. Standard output is flushed at once:
// where both streams go to one file, lines stand there whole and in the order in which they were printed.
#include "scantet/cli/print.h"

#include <cstdio>

#include "scantet/base/error.h"
#include "scantet/base/printable.h"
#include "scantet/cli/command.h"

namespace scantet {

void print(const std::string& text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stdout);
  std::fflush(stdout);  // a failure is found by finish_printing
}

void print_error_line(const std::string& text) {
  std::string line = "scantet: " + text;
  for (char& c : line) {
    if (c == '\n' || c == '\t') c = ' ';
  }
  line = printable(line) + '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

int print_cancelled() {
  print_error_line("cancelled; no file was written");
  return kExitCancelled;
}

void finish_printing() {
  const bool flushed = std::fflush(stdout) == 0;
  if (!flushed || std::ferror(stdout) != 0) {
    throw Error(Fault::output, "output.stdout", "standard output: cannot be written", "check what it is sent to");
  }
}

}  // namespace scantet
