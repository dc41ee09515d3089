// The temporary file is in the target's folder, so that rename() stays on one file system and is atomic. Names of
// temporary files are also kept in a fixed table of plain characters, which a signal handler may read at any moment:
// a slot is claimed, filled, and only then marked live.
#include "scantet/io/atomic_file.h"

#include <fcntl.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <system_error>
#include <vector>

#include "scantet/base/error.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

enum SlotState : int { kFree, kFilling, kLive };

struct Slot {
  std::atomic<int> state{kFree};
  char path[PATH_MAX];
};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler must not wait for a lock");

constexpr int kSlots = 64;
Slot g_unfinished[kSlots];

/// Returns the slot's number, -1 if all are taken.
int claim_slot(const std::string& path) {
  for (int i = 0; i < kSlots; ++i) {
    int expected = kFree;
    if (!g_unfinished[i].state.compare_exchange_strong(expected, kFilling)) continue;
    path.copy(g_unfinished[i].path, PATH_MAX - 1);
    g_unfinished[i].path[std::min<std::size_t>(path.size(), PATH_MAX - 1)] = '\0';
    g_unfinished[i].state = kLive;
    return i;
  }
  return -1;
}

const char* remedy_for(int system_error) {
  switch (system_error) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or write to another disk";
    case EFBIG:
      return "raise the file-size limit (ulimit -f) or choose a more compact format";
    case ENOENT:
    case ENOTDIR:
      return "create the folder first, or correct the path";
    case EISDIR:
      return "give the name of a file, not of a folder";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to, or change its permissions";
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return "choose another place";
  }
}

/// Refuses what rename() would replace although nobody wants it to: folders, devices, write-protected files.
/// Returns the permission bits of a file that is there, 0 if there is none.
mode_t check_target(const std::string& path, const std::string& target) {
  struct stat status {};
  if (stat(target.c_str(), &status) != 0) {
    if (errno == ENOENT) return 0;  // a missing folder is found when the temporary file is made
    throw_output_error(path, errno);
  }
  if (S_ISDIR(status.st_mode)) throw_output_error(path, EISDIR);
  if (!S_ISREG(status.st_mode)) {
    throw Error(Fault::output, "output.cannot_write", "cannot write '" + path + "': it is a device, pipe or socket",
                "give the name of a plain file");
  }
  if (access(target.c_str(), W_OK) != 0) throw_output_error(path, errno);
  return status.st_mode & 07777;
}

/// A stream buffer over a file descriptor that remembers why a write failed.
class DescriptorBuffer final : public std::streambuf {
 public:
  explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor), buffer_(std::size_t{1} << 20) {
    setp(buffer_.data(), buffer_.data() + buffer_.size());
  }
  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (!traits_type::eq_int_type(c, traits_type::eof())) {
      *pptr() = traits_type::to_char_type(c);
      pbump(1);
    }
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* data, std::streamsize size) override {
    if (size <= epptr() - pptr()) return std::streambuf::xsputn(data, size);
    return sync() == 0 && write_all(data, size) ? size : 0;
  }
  int sync() override {
    if (!write_all(pbase(), pptr() - pbase())) return -1;
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return 0;
  }

 private:
  bool write_all(const char* data, std::streamsize size) {
    while (size > 0 && error_ == 0) {
      const ssize_t written = write(descriptor_, data, static_cast<std::size_t>(size));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) {
        error_ = errno;
      } else {
        data += written;
        size -= written;
      }
    }
    return error_ == 0;
  }

  int descriptor_;
  int error_ = 0;
  std::vector<char> buffer_;
};

}  // namespace

void throw_output_error(const std::string& path, int system_error) {
  const bool full = system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG;
  throw Error(Fault::output, full ? "output.full" : "output.cannot_write",
              "cannot write '" + path + "': " + std::generic_category().message(system_error),
              remedy_for(system_error));
}

AtomicFile::AtomicFile(const std::string& path, const std::string& part_ending) : path_(path) {
  if (path.empty()) throw_output_error(path, ENOENT);
  if (path.back() == '/') throw_output_error(path, EISDIR);
  std::error_code failure;
  fs::path target = fs::absolute(path, failure);
  std::error_code missing;
  if (!failure && fs::is_symlink(target, missing)) target = fs::weakly_canonical(target, failure);
  if (failure) throw_output_error(path, failure.value());
  target_path_ = target.string();
  const mode_t mode = check_target(path_, target_path_);
  create(part_ending);
  if (mode != 0) fchmod(descriptor_, mode);  // a replaced file keeps its permissions; harmless if refused
}

void AtomicFile::create(const std::string& part_ending) {
  const fs::path target(target_path_);
  const std::string name = target.filename().string();
  const std::string stem = "." + name + "." + std::to_string(getpid());
  // A process killed earlier may have left its file and had our process id (containers): take the next number then.
  constexpr int kTries = 100;
  for (int i = 0; i < kTries && descriptor_ < 0; ++i) {
    std::string part_name = stem;
    if (i > 0) part_name.append(1, '.').append(std::to_string(i));
    part_name += part_ending;
    part_path_ = (target.parent_path() / part_name).string();
    descriptor_ = open(part_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) throw_output_error(path_, errno);
  }
  if (descriptor_ < 0) throw_output_error(path_, EEXIST);
  slot_ = claim_slot(part_path_);
  if (slot_ < 0) {
    remove_part();
    throw_output_error(path_, EMFILE);
  }
}

AtomicFile::~AtomicFile() {
  remove_part();
}

void AtomicFile::remove_part() noexcept {
  if (descriptor_ < 0) return;
  close(descriptor_);
  descriptor_ = -1;
  unlink(part_path_.c_str());
  if (slot_ >= 0) g_unfinished[slot_].state = kFree;
  slot_ = -1;
}

int AtomicFile::append_error() const {
  constexpr std::streamsize kProbe = 1 << 20;
  if (lseek(descriptor_, 0, SEEK_END) < 0) return errno;
  const std::vector<char> zeros(kProbe, '\0');
  DescriptorBuffer probe(descriptor_);
  probe.sputn(zeros.data(), kProbe);
  return probe.pubsync() == 0 ? 0 : probe.error();
}

void AtomicFile::commit() {
  if (descriptor_ < 0) throw Error(Fault::internal, "output.committed", "'" + path_ + "' was committed before");
  if (fsync(descriptor_) != 0) throw_output_error(path_, errno);
  if (rename(part_path_.c_str(), target_path_.c_str()) != 0) throw_output_error(path_, errno);
  close(descriptor_);  // its data are on the disk
  descriptor_ = -1;
  g_unfinished[slot_].state = kFree;
  slot_ = -1;
  const int folder = open(fs::path(target_path_).parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;  // the file is there; only its survival of a power cut is not certain
  fsync(folder);
  close(folder);
}

void write_file(const std::string& path, const std::function<void(std::ostream&)>& content) {
  AtomicFile file(path);
  DescriptorBuffer buffer(file.descriptor());
  std::ostream out(&buffer);
  content(out);
  out.flush();
  if (buffer.error() != 0) throw_output_error(path, buffer.error());
  if (!out) throw Error(Fault::internal, "output.stream", "the stream to '" + path + "' was left in a failed state");
  file.commit();
}

void remove_unfinished_files() noexcept {
  for (Slot& slot : g_unfinished) {
    if (slot.state == kLive) unlink(slot.path);
  }
}

}  // namespace scantet
