// INRIMAGE-4 (.inr, .inr.gz), the format of CGAL's examples, through CGAL's ImageIO. Voxels are where CGAL's mesher has
// them: index times spacing, plus the offset that the header may give.
#include <zlib.h>

#define CGAL_USE_ZLIB  // as CGAL names it: compressed files, too
#include <CGAL/ImageIO.h>

#include <algorithm>
#include <memory>

#include "scantet/reading/image_source_impl.h"

namespace scantet {
namespace {

struct FreeImage {
  void operator()(_image* image) const { _freeImage(image); }
};
using ImagePointer = std::unique_ptr<_image, FreeImage>;

ImageHeader header_of(const _image& image) {
  ImageHeader header;
  header.format = "INRIMAGE";
  header.size = {static_cast<std::int64_t>(image.xdim), static_cast<std::int64_t>(image.ydim),
                 static_cast<std::int64_t>(image.zdim)};
  header.columns = {Vec{image.vx, 0, 0}, Vec{0, image.vy, 0}, Vec{0, 0, image.vz}};
  header.origin = {image.tx, image.ty, image.tz};
  header.type = voxel_type(image.wdim, image.wordKind == WK_FLOAT, image.sign == SGN_SIGNED);
  header.type_name = std::to_string(8 * image.wdim) + "-bit " + (image.wordKind == WK_FLOAT ? "float" : "integer");
  constexpr std::size_t kMostComponents = 1 << 20;  // any number is refused that is not one
  header.components = static_cast<int>(std::min(image.vdim, kMostComponents));
  if (header.components > 1) header.pixel_kind = "vector";
  return header;
}

class InrImage final : public ImageSource {
 public:
  explicit InrImage(const std::string& path) : path_(path), image_(_readImageHeader(path.c_str())) {
    if (!image_) throw corrupt_file(path_, "its header cannot be read");
    if (image_->rx != 0 || image_->ry != 0 || image_->rz != 0) {
      throw Error(Fault::input, "input.frame",
                  "'" + path_ + "' is turned (RX, RY, RZ), and programs do not agree on what that means",
                  "convert it to NRRD or NIfTI with the program that wrote it");
    }
    header_ = header_of(*image_);
  }

  const ImageHeader& header() const override { return header_; }

  bool read(void* voxels, Progress&) override {
    image_->data = voxels;  // where ImageIO then puts them
    const int status = _readImageData(image_.get());
    image_->data = nullptr;  // not ImageIO's to free
    unsigned char beyond = 0;
    if (status < 0 || gzread(image_->fd, &beyond, 1) < 0) {  // at the end zlib looks at its checksum
      throw corrupt_file(path_, "it has fewer voxels than its header announces, or they cannot be unpacked");
    }
    return true;
  }

 private:
  std::string path_;
  ImagePointer image_;
  ImageHeader header_;
};

}  // namespace

std::unique_ptr<ImageSource> open_inr_image(const std::string& path) {
  return std::make_unique<InrImage>(path);
}

bool is_inr_image(const std::string& path) {
  constexpr char kMagic[] = "#INRIMAGE-4#{";
  std::string start(sizeof kMagic - 1, '\0');
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return false;
  const int got = gzread(file, start.data(), static_cast<unsigned>(start.size()));
  gzclose(file);
  return got == static_cast<int>(start.size()) && start == kMagic;
}

}  // namespace scantet
