// `scantet-check`: checks a certificate again. It has the verifier and the readers in it, and nothing that makes
// meshes.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/printable.h"
#include "scantet/base/version.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/verification/verify_job.h"

namespace scantet {
namespace {

// As those of scantet.
constexpr int kHolds = 0;
constexpr int kFailed = 1;
constexpr int kUsage = 2;
constexpr int kInput = 3;
constexpr int kDoesNotHold = 4;
constexpr int kOutput = 5;
constexpr int kNoMemory = 6;

const char* const kHelp =
    "Usage: scantet-check CERTIFICATE [MESH] [--against SCAN] [--threads N]\n"
    "\n"
    "Checks a certificate that scantet verify --json or scantet mesh --certificate has written: whether mesh and scan\n"
    "are the files that it names, by their checksums, and whether the same options give the same grade. MESH and SCAN\n"
    "are needed only if the files have moved.\n"
    "\n"
    "Exit status: 0 it holds; 1 a fault of the program; 2 wrong use; 3 a file cannot be read; 4 it does not\n"
    "hold; 6 out of memory.\n";

/// Takes the words of the command line. False if they make no sense.
bool read_words(const std::vector<std::string>& words, VerifyJob& job, std::vector<OptionValue>& given) {
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::string& word = words[n];
    if (word == "--against" || word == "--threads") {
      if (n + 1 == words.size()) return false;
      given.push_back({word.substr(2), words[++n], word});
    } else if (word.starts_with("-") || !job.mesh.empty()) {
      return false;
    } else {
      (job.certificate.empty() ? job.certificate : job.mesh) = word;
    }
  }
  return !job.certificate.empty();
}

int status_of(Fault fault) {
  return fault == Fault::usage ? kUsage : fault == Fault::input ? kInput : fault == Fault::output ? kOutput : kFailed;
}

int run(const std::vector<std::string>& words) {
  const bool wants_help = words.size() == 1 && (words[0] == "--help" || words[0] == "-h");
  if (wants_help) {
    std::fputs(kHelp, stdout);
    return kHolds;
  }
  if (words.size() == 1 && words[0] == "--version") {
    std::printf("scantet-check %s\n", kVersion);
    return kHolds;
  }
  VerifyJob asked;
  std::vector<OptionValue> given;
  if (!read_words(words, asked, given)) {
    std::fputs(kHelp, stderr);
    return kUsage;
  }
  VerifyJob job = recorded_job(asked, given);
  job.certificate = asked.certificate;
  const bool is_of_plugin = can_read_scan(job.against) == 0;
  if (is_of_plugin) {
    throw Error(
        Fault::input, "input.format",
        job.against + " is no image: an OpenVDB grid or a surface is read by a plugin, and scantet-check loads none",
        "check with: scantet verify --certificate " + asked.certificate);
  }
  Progress progress;
  const VerifyOutcome outcome = run_verify(job, progress);
  std::fputs(printable(outcome.text).c_str(), stdout);
  return outcome.is_as_required ? kHolds : kDoesNotHold;
}

}  // namespace
}  // namespace scantet

int main(int count, char** words) {
  try {
    return scantet::run({words + 1, words + count});
  } catch (const scantet::Error& error) {
    std::fprintf(stderr, "scantet-check: error: %s\n", scantet::printable(error.what()).c_str());
    return scantet::status_of(error.fault());
  } catch (const std::bad_alloc&) {
    std::fputs("scantet-check: error: out of memory\n", stderr);
    return scantet::kNoMemory;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scantet-check: error: %s\n", scantet::printable(error.what()).c_str());
    return scantet::kFailed;
  }
}
