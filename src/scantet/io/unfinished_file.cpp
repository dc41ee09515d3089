// The temporary file is in the target's folder, so that rename() stays on one file system and is atomic. Its name is
// short, because the target's may be as long as names can be. Names of temporary files are also kept in a fixed table
// of plain characters, which a signal handler may read at any moment: a slot is claimed, filled, and only then marked
// live.
#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/resolved_path.h"
#include "scantet/io/unfinished_file_impl.h"
#include "scantet/io/unfinished_folder_impl.h"

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

/// Sixteen hexadecimal digits of a name (FNV-1a), the same in every run.
std::string short_name(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[hash >> shift & 15];
  return text;
}

/// Removes what killed processes have left of a target. A file that can be locked is nobody's; but its name must still
/// stand for the file that was locked.
void sweep(const fs::path& folder, const std::string& stem) {
  std::error_code code;
  for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
    if (!entry->path().filename().string().starts_with(stem)) continue;
    const char* const name = entry->path().c_str();
    int left = open(name, O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (left < 0 && errno == EISDIR) left = open(name, O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
    if (left < 0) continue;
    struct stat locked {};
    struct stat named {};
    const bool is_it = flock(left, LOCK_EX | LOCK_NB) == 0 && fstat(left, &locked) == 0 && lstat(name, &named) == 0 &&
                       locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
    if (is_it && S_ISREG(named.st_mode)) unlink(name);
    if (is_it && S_ISDIR(named.st_mode)) remove_tree(name);
    close(left);
  }
}

/// Removes a file, or a folder with what is in it. Async-signal-safe.
void remove_one(const char* path) noexcept {
  if (unlink(path) != 0) remove_tree(path);
}

/// Locks a new file. False if a sweep has taken it away in between.
bool lock(int descriptor) {
  while (flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
  }
  struct stat status {};
  return fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

}  // namespace

UnfinishedFile::UnfinishedFile(const std::string& path, const std::string& target, const std::string& part_ending,
                               FolderContent content)
    : path_(path), content_(content) {
  if (target.empty()) throw_output_error(path, ENOENT);
  if (target.back() == '/') throw_output_error(path, EISDIR);
  std::error_code failure;
  target_path_ = resolved_path(target, failure).string();
  if (failure) throw_output_error(path, failure.value());
  folder_path_ = fs::path(target_path_).parent_path().string();
  const mode_t mode =
      is_folder() ? check_target_folder(path_, target_path_, content_) : check_target(path_, target_path_);
  create(part_ending);
  if (mode != 0) fchmod(descriptor_, mode);  // a replaced file keeps its permissions; harmless if refused
}

void UnfinishedFile::create(const std::string& part_ending) {
  const fs::path target(target_path_);
  const std::string stem = ".scantet-" + short_name(target.filename().string()) + ".";
  sweep(target.parent_path(), stem);
  // Another process, in a container, may have the same id: take the next number then.
  constexpr int kTries = 100;
  for (int i = 0; i < kTries && descriptor_ < 0; ++i) {
    std::string part_name = stem + std::to_string(getpid());
    if (i > 0) part_name.append(1, '.').append(std::to_string(i));
    part_path_ = (target.parent_path() / (part_name + part_ending)).string();
    if (is_folder()) {
      descriptor_ =
          mkdir(part_path_.c_str(), 0777) == 0 ? open(part_path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    } else {  // some libraries read back
      descriptor_ = open(part_path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    }
    if (descriptor_ < 0 && errno != EEXIST) throw_output_error(path_, errno);
    if (descriptor_ < 0 || lock(descriptor_)) continue;
    close(descriptor_);
    descriptor_ = -1;
  }
  if (descriptor_ < 0) throw_output_error(path_, EEXIST);
  slot_ = claim_slot(part_path_);
  if (slot_ >= 0) return;
  remove_part();
  throw_output_error(path_, EMFILE);
}

UnfinishedFile::~UnfinishedFile() {
  if (descriptor_ >= 0) remove_part();
}

void UnfinishedFile::remove_part() noexcept {
  remove_one(part_path_.c_str());
  close_part();
}

void UnfinishedFile::close_part() noexcept {
  close(descriptor_);
  descriptor_ = -1;
  if (slot_ >= 0) g_unfinished[slot_].state = kFree;
  slot_ = -1;
}

void UnfinishedFile::flush() const {
  if (is_folder()) return sync_tree(part_path_, path_);
  if (fsync(descriptor_) != 0) throw_output_error(path_, errno);
}

int UnfinishedFile::appear() noexcept {
  if (is_folder()) {
    if (const int failure = replace_folder(part_path_, target_path_); failure != 0) return failure;
  } else if (rename(part_path_.c_str(), target_path_.c_str()) != 0) {
    return errno;
  }
  close_part();
  return 0;
}

void UnfinishedFile::sync_folder() const noexcept {
  const int folder = open(folder_path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  fsync(folder);
  close(folder);
}

void remove_unfinished_files() noexcept {
  for (Slot& slot : g_unfinished) {
    if (slot.state == kLive) remove_one(slot.path);
  }
}

}  // namespace scantet
