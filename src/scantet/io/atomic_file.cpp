// The content goes to a temporary file (unfinished_file.cpp). Here are the ways to write it, and the errors of writing.
#include "scantet/io/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <ostream>
#include <streambuf>
#include <system_error>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/io/atomic_folder_impl.h"
#include "scantet/io/file_set.h"
#include "scantet/io/unfinished_file_impl.h"

namespace scantet {
namespace {

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

AtomicFile::AtomicFile(const std::string& path, const std::string& part_ending, FileSet* set)
    : path_(path), file_(std::make_unique<UnfinishedFile>(path, path, part_ending)), set_(set) {
  part_path_ = file_->part_path();
}

AtomicFile::AtomicFile(const AtomicFolder& folder, const std::string& name, const std::string& part_ending)
    : path_(folder.path() + "/" + name),
      file_(std::make_unique<UnfinishedFile>(path_, folder.part_path() + "/" + name, part_ending)),
      set_(nullptr) {
  part_path_ = file_->part_path();
}

AtomicFile::~AtomicFile() = default;

int AtomicFile::descriptor() const {
  return file_ ? file_->descriptor() : -1;
}

int AtomicFile::append_error() const {
  constexpr std::streamsize kProbe = 1 << 20;
  if (lseek(descriptor(), 0, SEEK_END) < 0) return errno;
  const std::vector<char> zeros(kProbe, '\0');
  DescriptorBuffer probe(descriptor());
  probe.sputn(zeros.data(), kProbe);
  return probe.pubsync() == 0 ? 0 : probe.error();
}

void AtomicFile::commit() {
  if (!file_) throw Error(Fault::internal, "output.committed", "'" + path_ + "' was committed before");
  file_->flush();
  if (set_ != nullptr) {
    set_->add(std::move(file_));
    return;
  }
  if (const int failure = file_->appear(); failure != 0) throw_output_error(path_, failure);
  file_->sync_folder();
  file_.reset();
}

namespace {

void fill_and_commit(AtomicFile& file, const std::function<void(std::ostream&)>& content) {
  DescriptorBuffer buffer(file.descriptor());
  std::ostream out(&buffer);
  content(out);
  out.flush();
  if (buffer.error() != 0) throw_output_error(file.path(), buffer.error());
  if (!out) {
    throw Error(Fault::internal, "output.stream", "the stream to '" + file.path() + "' was left in a failed state");
  }
  file.commit();
}

}  // namespace

void write_file(const std::string& path, const std::function<void(std::ostream&)>& content, FileSet* set) {
  AtomicFile file(path, ".part", set);
  fill_and_commit(file, content);
}

void write_file(const AtomicFolder& folder, const std::string& name,
                const std::function<void(std::ostream&)>& content) {
  AtomicFile file(folder, name);
  fill_and_commit(file, content);
}

}  // namespace scantet
