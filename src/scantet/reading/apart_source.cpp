// The child opens the image and sends its header; when the parent has judged it and has memory for it, the child reads
// the voxels into memory of its own and sends them through the line. It gives each part back once it is sent, so both
// together hold the image once. Nothing of what the child sends is believed further than that: it is looked at like a
// file.
#include <sys/mman.h>

#include <algorithm>
#include <filesystem>

#include "scantet/base/child_process.h"
#include "scantet/reading/image_source_impl.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;
constexpr char kGo = 'g';

// Of a folder, of the files in it.
double bytes_of(const std::string& path) {
  std::error_code failure;
  if (!fs::is_directory(path, failure)) {
    const std::uintmax_t bytes = fs::file_size(path, failure);
    return failure ? 0 : static_cast<double>(bytes);
  }
  double sum = 0;
  for (const auto& entry : fs::directory_iterator(path, failure)) {
    if (entry.is_regular_file(failure)) sum += bytes_of(entry.path().string());
  }
  return sum;
}

double bytes_of(const ImageHeader& header) {
  double bytes = double(voxel_bytes(*header.type)) * header.components;
  for (const std::int64_t n : header.size) bytes *= static_cast<double>(n);
  return bytes;
}

void send_header(ChildLine& line, const ImageHeader& header) {
  for (const std::string& text : {header.format, header.pixel_kind, header.type_name, header.of_labels}) {
    line.put_text(text);
  }
  line.put(header.size.size());
  for (const std::int64_t n : header.size) line.put(n);
  line.put(header.columns);
  line.put(header.origin);
  line.put(header.type ? static_cast<int>(*header.type) : -1);
  line.put(header.components);
  line.put(header.segments.size());
  for (const HeaderSegment& named : header.segments) {
    line.put(named.segment.label);
    line.put_text(named.segment.name);
    line.put(named.segment.color.has_value());
    line.put(named.segment.color.value_or(Color()));
    line.put(named.layer);
  }
}

ImageHeader take_header(ChildLine& line) {
  constexpr std::size_t kMostAxes = 16;
  constexpr std::size_t kMostSegments = 65'535;
  ImageHeader header;
  for (std::string* text : {&header.format, &header.pixel_kind, &header.type_name, &header.of_labels}) {
    *text = line.take_text();
  }
  header.size.resize(std::min(line.take<std::size_t>(), kMostAxes));
  for (std::int64_t& n : header.size) n = line.take<std::int64_t>();
  header.columns = line.take<std::array<Vec, 3>>();
  header.origin = line.take<Point>();
  const int type = line.take<int>();
  if (type >= 0 && type <= static_cast<int>(VoxelType::float64)) header.type = static_cast<VoxelType>(type);
  header.components = std::max(1, line.take<int>());
  header.segments.resize(std::min(line.take<std::size_t>(), kMostSegments));
  for (HeaderSegment& named : header.segments) {
    named.segment.label = line.take<std::int64_t>();
    named.segment.name = line.take_text();
    const bool is_colored = line.take<std::uint8_t>() != 0;
    const auto color = line.take<Color>();
    if (is_colored) named.segment.color = color;
    named.layer = line.take<std::int64_t>();
  }
  return header;
}

[[noreturn]] void refuse_large(const std::string& path) {
  throw Error(Fault::input, "input.too_large", "'" + path + "' needs more memory than an image of its size should",
              "crop or resample the image, or export it again");
}

// In the child.
void send_voxels(ImageSource& source, const std::string& path, ChildLine& line, Progress& progress) {
  constexpr std::size_t kPart = 1 << 22;
  const auto bytes = static_cast<std::size_t>(bytes_of(source.header()));
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) refuse_large(path);
  source.read(memory, progress);
  line.step();
  for (std::size_t at = 0; at < bytes; at += kPart) {
    const std::size_t part = std::min(kPart, bytes - at);
    line.send(static_cast<char*>(memory) + at, part);
    munmap(static_cast<char*>(memory) + at, part);
  }
  line.put(source.overlapping());
  for (const HeaderSegment& named : source.header().segments) {
    line.put(named.segment.voxels);
    line.put(named.segment.covered);
  }
}

class ApartSource final : public ImageSource {
 public:
  ApartSource(const std::string& path, const SourceOpener& open, Progress& progress)
      : path_(path),
        child_(
            limits_for(bytes_of(path)), [this, &open](ChildLine& line) { work(open, line); },
            [this] { return progress_->cancelled(); }),
        progress_(&progress) {
    guarded([&] {
      await(progress);
      header_ = child_.take(take_header);
    });
  }

  const ImageHeader& header() const override { return header_; }
  std::uint64_t overlapping() const override { return overlapping_; }

  bool read(void* voxels, Progress& progress) override {
    progress_ = &progress;
    constexpr std::size_t kPart = 1 << 22;
    const auto bytes = static_cast<std::size_t>(bytes_of(header_));
    return guarded([&] {
      child_.take([](ChildLine& line) { line.put(kGo); });
      await(progress);
      child_.take([&](ChildLine& line) {
        for (std::size_t at = 0; at < bytes; at += kPart) {
          line.receive(static_cast<char*>(voxels) + at, std::min(kPart, bytes - at));
        }
        overlapping_ = line.take<std::uint64_t>();
        for (HeaderSegment& named : header_.segments) {
          named.segment.voxels = line.take<std::uint64_t>();
          named.segment.covered = line.take<std::uint64_t>();
        }
      });
    });
  }

 private:
  // In the child.
  void work(const SourceOpener& open, ChildLine& line) const {
    try {
      SentProgress progress(line);
      const std::unique_ptr<ImageSource> source = open(progress);
      line.step();
      send_header(line, source->header());
      line.take<char>();
      limit_this_process(limits_for(bytes_of(path_) + bytes_of(source->header())));
      send_voxels(*source, path_, line, progress);
    } catch (const std::bad_alloc&) {
      refuse_large(path_);
    }
  }

  void await(Progress& progress) {
    child_.await_step([&](const std::string& doing, std::uint64_t done, std::uint64_t total) {
      progress.report({"read", doing, done, total == 0 ? std::nullopt : std::optional(total), 0});
    });
  }

  // False if cancelled.
  template <class Act>
  bool guarded(const Act& act) {
    try {
      act();
      return true;
    } catch (const ChildStopped&) {
      return false;
    } catch (const ChildFailure& failure) {
      throw corrupt_file(path_, std::string("its reader, in a process of its own, ") + failure.what());
    }
  }

  std::string path_;
  ChildProcess child_;
  Progress* progress_;
  ImageHeader header_;
  std::uint64_t overlapping_ = 0;
};

}  // namespace

std::unique_ptr<ImageSource> open_apart(const std::string& path, const SourceOpener& open, Progress& progress) {
  auto source = std::make_unique<ApartSource>(path, open, progress);
  return progress.cancelled() ? nullptr : std::move(source);
}

}  // namespace scantet
