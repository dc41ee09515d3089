// A folder takes another's place in one step where the file system can exchange two names, as those of Linux can; where
// it cannot, the old one steps aside first.
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/unfinished_folder_impl.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;

/// What getdents64() gives, which glibc has no name for.
struct Entry {
  std::uint64_t inode;
  std::int64_t offset;
  std::uint16_t size;
  std::uint8_t type;
  char name[1];
};

/// Removes what is in an open folder, and folders in it as deep as `depth`. Calls the system alone, allocates nothing.
void empty_folder(int folder, int depth) noexcept {
  alignas(Entry) char buffer[4096];
  bool is_changed = true;
  while (is_changed) {  // what was removed may have hidden others
    is_changed = false;
    lseek(folder, 0, SEEK_SET);
    for (long size = 0; (size = syscall(SYS_getdents64, folder, buffer, sizeof buffer)) > 0;) {
      for (long at = 0; at < size;) {
        const auto* const entry = reinterpret_cast<const Entry*>(buffer + at);
        at += entry->size;
        if (std::strcmp(entry->name, ".") == 0 || std::strcmp(entry->name, "..") == 0) continue;
        if (unlinkat(folder, entry->name, 0) == 0) {
          is_changed = true;
          continue;
        }
        const int inner = depth > 0 ? openat(folder, entry->name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC) : -1;
        if (inner < 0) continue;
        empty_folder(inner, depth - 1);
        close(inner);
        is_changed = unlinkat(folder, entry->name, AT_REMOVEDIR) == 0 || is_changed;
      }
    }
  }
}

void sync_one(const std::string& folder, const std::string& path) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool is_synced = descriptor >= 0 && fsync(descriptor) == 0;
  const int failure = errno;
  if (descriptor >= 0) close(descriptor);
  if (!is_synced) throw_output_error(path, failure);
}

}  // namespace

unsigned check_target_folder(const std::string& path, const std::string& target, FolderContent content) {
  struct stat status {};
  if (stat(target.c_str(), &status) != 0) {
    if (errno == ENOENT) return 0;
    throw_output_error(path, errno);
  }
  if (!S_ISDIR(status.st_mode)) {
    throw Error(Fault::output, "output.cannot_write",
                "cannot write '" + path + "': it is a file, and is to be a folder",
                "choose another name, or remove the file");
  }
  if (access(target.c_str(), W_OK | X_OK) != 0) throw_output_error(path, errno);
  std::error_code failure;
  for (fs::recursive_directory_iterator entry(target, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string name = entry->path().lexically_relative(target).string();
    const bool is_folder = entry->is_directory(failure) && !entry->is_symlink(failure);
    if (content(is_folder ? name + "/" : name)) continue;
    throw Error(Fault::output, "output.cannot_write",
                "cannot write '" + path + "': the folder is there and holds '" + name +
                    "', which is not of such a mesh and would be lost",
                "choose another name, or empty the folder");
  }
  if (failure) throw_output_error(path, failure.value());
  return status.st_mode & 07777;
}

int replace_folder(const std::string& part, const std::string& target) noexcept {
  if (rename(part.c_str(), target.c_str()) == 0) return 0;
  if (errno != ENOTEMPTY && errno != EEXIST) return errno;
  if (renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, target.c_str(), RENAME_EXCHANGE) == 0) {
    remove_tree(part.c_str());
    return 0;
  }
  if (errno != EINVAL && errno != ENOSYS) return errno;
  const std::string aside = part + ".old";
  if (rename(target.c_str(), aside.c_str()) != 0) return errno;
  if (rename(part.c_str(), target.c_str()) != 0) {
    const int failure = errno;
    rename(aside.c_str(), target.c_str());
    return failure;
  }
  remove_tree(aside.c_str());
  return 0;
}

void sync_tree(const std::string& folder, const std::string& path) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) sync_one(entry.path().string(), path);
  }
  sync_one(folder, path);
}

void remove_tree(const char* path) noexcept {
  constexpr int kDepth = 1;
  const int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  empty_folder(folder, kDepth);
  close(folder);
  rmdir(path);
}

}  // namespace scantet
