// The library writes through a driver of our own (HDF5's virtual file layer): its usual one leaves a file that it
// cannot close, and prints so at the end of the program, when the disk is full. Ours takes everything and remembers the
// first refusal of the system, as our streams do.
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <limits>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/hdf5_file_impl.h"

namespace scantet {
namespace {

/// Groups know in which order their members were made, by which MED's library lists families.
constexpr unsigned kOrdered = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;

/// Where a driver's file writes, given to it in the list of access properties.
struct Sink {
  int descriptor;
  int error;  ///< the system's first refusal; the file is given up then
};

struct DriverInfo {
  Sink* sink;
};

/// The library's view of a file: its own part first, as it demands.
struct DriverFile {
  H5FD_t shown;
  Sink* sink;
  haddr_t end_allocated;
  haddr_t end_written;
};

DriverFile& own(H5FD_t* file) {
  return *reinterpret_cast<DriverFile*>(file);
}
const DriverFile& own(const H5FD_t* file) {
  return *reinterpret_cast<const DriverFile*>(file);
}

H5FD_t* driver_open(const char* /*name*/, unsigned /*flags*/, hid_t access, haddr_t /*largest*/) {
  const auto* const info = static_cast<const DriverInfo*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto* const file = new DriverFile{};  // NOLINT(cppcoreguidelines-owning-memory): the library keeps it
  file->sink = info->sink;
  return &file->shown;
}

herr_t driver_close(H5FD_t* file) {
  delete &own(file);  // NOLINT(cppcoreguidelines-owning-memory): as above
  return 0;
}

herr_t driver_query(const H5FD_t* /*file*/, unsigned long* features) {
  *features = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
              H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t driver_get_eoa(const H5FD_t* file, H5FD_mem_t /*type*/) {
  return own(file).end_allocated;
}

herr_t driver_set_eoa(H5FD_t* file, H5FD_mem_t /*type*/, haddr_t end) {
  own(file).end_allocated = end;
  return 0;
}

haddr_t driver_get_eof(const H5FD_t* file, H5FD_mem_t /*type*/) {
  return own(file).end_written;
}

herr_t driver_read(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t from, size_t size, void* buffer) {
  auto* bytes = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t got = pread(own(file).sink->descriptor, bytes, size, static_cast<off_t>(from));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && own(file).sink->error == 0) own(file).sink->error = errno;
    if (got <= 0) break;
    bytes += got;
    from += static_cast<haddr_t>(got);
    size -= static_cast<size_t>(got);
  }
  std::fill_n(bytes, size, '\0');  // beyond the end, or of a file that is given up
  return 0;
}

herr_t driver_write(H5FD_t* file, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t to, size_t size,
                    const void* buffer) {
  DriverFile& driver = own(file);
  driver.end_written = std::max(driver.end_written, to + size);
  const auto* bytes = static_cast<const char*>(buffer);
  while (size > 0 && driver.sink->error == 0) {
    const ssize_t put = pwrite(driver.sink->descriptor, bytes, size, static_cast<off_t>(to));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      driver.sink->error = errno;
      break;
    }
    bytes += put;
    to += static_cast<haddr_t>(put);
    size -= static_cast<size_t>(put);
  }
  return 0;
}

herr_t driver_truncate(H5FD_t* file, hid_t /*transfer*/, hbool_t /*closing*/) {
  DriverFile& driver = own(file);
  if (driver.end_written == driver.end_allocated || driver.sink->error != 0) return 0;
  if (ftruncate(driver.sink->descriptor, static_cast<off_t>(driver.end_allocated)) != 0) driver.sink->error = errno;
  driver.end_written = driver.end_allocated;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "scantet";
  driver.maxaddr = static_cast<haddr_t>(std::numeric_limits<off_t>::max());
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(DriverInfo);
  driver.open = driver_open;
  driver.close = driver_close;
  driver.query = driver_query;
  driver.get_eoa = driver_get_eoa;
  driver.set_eoa = driver_set_eoa;
  driver.get_eof = driver_get_eof;
  driver.read = driver_read;
  driver.write = driver_write;
  driver.truncate = driver_truncate;
  const H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(kinds), std::end(kinds), std::begin(driver.fl_map));
  return driver;
}

/// Something of the library that is closed at the end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library's own messages are off while this lives.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace

struct Hdf5File::State {
  const AtomicFile& file;
  Silence silence{};
  Sink sink{};
  hid_t driver = H5I_INVALID_HID;
  hid_t id = H5I_INVALID_HID;

  ~State() {
    if (id >= 0) H5Fclose(id);
    if (driver >= 0) H5FDunregister(driver);
  }

  /// Takes what a call returned: negative for errors.
  hid_t check(hid_t result) const {
    if (result >= 0) return result;
    if (sink.error != 0) throw_output_error(file.path(), sink.error);
    throw Error(Fault::output, "output.cannot_write", "cannot write '" + file.path() + "': HDF5 refuses it",
                "choose another format");
  }

  void write(const std::string& path, const Extents& extents, hid_t in_file, hid_t in_memory,
             const void* values) const {
    const std::vector<hsize_t> sizes(extents.begin(), extents.end());
    const Handle space(check(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr)), H5Sclose);
    const Handle how(check(H5Pcreate(H5P_DATASET_CREATE)), H5Pclose);
    check(H5Pset_obj_track_times(how, 0));
    check(H5Pset_fill_time(how, H5D_FILL_TIME_NEVER));
    const Handle array(check(H5Dcreate2(id, path.c_str(), in_file, space, H5P_DEFAULT, how, H5P_DEFAULT)), H5Dclose);
    if (H5Sget_simple_extent_npoints(space) == 0) return;
    check(H5Dwrite(array, in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  }

  void set_attribute(const std::string& path, const std::string& name, hid_t in_file, hid_t in_memory,
                     const void* value) const {
    const Handle space(check(H5Screate(H5S_SCALAR)), H5Sclose);
    const Handle attribute(
        check(H5Acreate_by_name(id, path.c_str(), name.c_str(), in_file, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)),
        H5Aclose);
    check(H5Awrite(attribute, in_memory, value));
  }
};

Hdf5File::Hdf5File(const AtomicFile& file) : state_(new State{file}) {
  static const H5FD_class_t driver = driver_class();
  state_->sink.descriptor = file.descriptor();
  state_->driver = state_->check(H5FDregister(&driver));
  const Handle access(state_->check(H5Pcreate(H5P_FILE_ACCESS)), H5Pclose);
  const DriverInfo info{&state_->sink};
  state_->check(H5Pset_driver(access, state_->driver, &info));
  const Handle how(state_->check(H5Pcreate(H5P_FILE_CREATE)), H5Pclose);
  state_->check(H5Pset_obj_track_times(how, 0));
  state_->check(H5Pset_link_creation_order(how, kOrdered));
  state_->id = state_->check(H5Fcreate(file.part_path().c_str(), H5F_ACC_TRUNC, how, access));
}

Hdf5File::~Hdf5File() = default;

void Hdf5File::make_group(const std::string& path) {
  const Handle how(state_->check(H5Pcreate(H5P_GROUP_CREATE)), H5Pclose);
  state_->check(H5Pset_obj_track_times(how, 0));
  state_->check(H5Pset_link_creation_order(how, kOrdered));
  const Handle group(state_->check(H5Gcreate2(state_->id, path.c_str(), H5P_DEFAULT, how, H5P_DEFAULT)), H5Gclose);
}

void Hdf5File::write(const std::string& path, const Extents& extents, std::span<const double> values) {
  state_->write(path, extents, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
}

void Hdf5File::write(const std::string& path, const Extents& extents, std::span<const std::int32_t> values) {
  state_->write(path, extents, H5T_STD_I32LE, H5T_NATIVE_INT32, values.data());
}

void Hdf5File::write_wide(const std::string& path, const Extents& extents, std::span<const std::uint32_t> values) {
  state_->write(path, extents, H5T_STD_I64LE, H5T_NATIVE_UINT32, values.data());
}

void Hdf5File::write(const std::string& path, const std::vector<std::string>& texts, std::size_t length) {
  std::string all;
  for (const std::string& text : texts) {
    all += text.substr(0, length);
    all.resize((all.size() + length - 1) / length * length, '\0');
  }
  const hsize_t characters = length;
  const Handle in_file(state_->check(H5Tarray_create2(H5T_STD_I8LE, 1, &characters)), H5Tclose);
  const Handle in_memory(state_->check(H5Tarray_create2(H5T_NATIVE_SCHAR, 1, &characters)), H5Tclose);
  state_->write(path, {texts.size()}, in_file, in_memory, all.data());
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, std::int32_t value) {
  state_->set_attribute(path, name, H5T_STD_I32LE, H5T_NATIVE_INT32, &value);
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, double value) {
  state_->set_attribute(path, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5File::set_attribute(const std::string& path, const std::string& name, const std::string& text) {
  const Handle type(state_->check(H5Tcopy(H5T_C_S1)), H5Tclose);
  state_->check(H5Tset_size(type, text.size() + 1));
  state_->set_attribute(path, name, type, type, text.c_str());
}

void Hdf5File::set_bits(const std::string& path, const std::string& name, std::uint32_t bits) {
  state_->set_attribute(path, name, H5T_STD_B32LE, H5T_NATIVE_B32, &bits);
}

void Hdf5File::close() {
  const herr_t status = H5Fclose(state_->id);
  state_->id = H5I_INVALID_HID;
  if (state_->sink.error != 0) throw_output_error(state_->file.path(), state_->sink.error);
  state_->check(status);
}

}  // namespace scantet
