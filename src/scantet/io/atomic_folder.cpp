// The temporary folder is an unfinished file of another kind (unfinished_folder.cpp).
#include <sys/stat.h>

#include <cerrno>

#include "scantet/io/atomic_file.h"
#include "scantet/io/atomic_folder_impl.h"
#include "scantet/io/file_set.h"

namespace scantet {

AtomicFolder::AtomicFolder(const std::string& path, FolderContent content, FileSet* set)
    : path_(path), folder_(std::make_unique<UnfinishedFile>(path, path, ".part", content)), set_(set) {
  part_path_ = folder_->part_path();
}

AtomicFolder::~AtomicFolder() = default;

void AtomicFolder::make_folder(const std::string& name) const {
  if (mkdir((part_path_ + "/" + name).c_str(), 0777) != 0) throw_output_error(path_ + "/" + name, errno);
}

void AtomicFolder::commit() {
  folder_->flush();
  if (set_ != nullptr) return set_->add(std::move(folder_));
  if (const int failure = folder_->appear(); failure != 0) throw_output_error(path_, failure);
  folder_->sync_folder();
  folder_.reset();
}

}  // namespace scantet
