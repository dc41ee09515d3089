// Where ITK's exceptions, prints and types end. Internal to the reader.
#pragma once

#include <itkImageIOBase.h>

#include <iostream>
#include <mutex>
#include <new>
#include <sstream>
#include <streambuf>
#include <string>

#include "scantet/reading/image_source_impl.h"

namespace scantet {

/// While it lives, what image libraries print (MetaIO, ITK's warnings, GDCM's trace) is caught instead of shown.
/// One at a time in the process; what a library said last is kept for the error message.
class QuietLibraries {
 public:
  QuietLibraries() : lock_(mutex()), cerr_(std::cerr.rdbuf(caught_.rdbuf())), cout_(std::cout.rdbuf(caught_.rdbuf())) {}
  ~QuietLibraries() {
    std::cerr.rdbuf(cerr_);
    std::cout.rdbuf(cout_);
  }
  QuietLibraries(const QuietLibraries&) = delete;
  QuietLibraries& operator=(const QuietLibraries&) = delete;

  std::string said() const { return caught_.str(); }

 private:
  static std::mutex& mutex() {
    static std::mutex only;
    return only;
  }

  std::lock_guard<std::mutex> lock_;
  std::ostringstream caught_;
  std::streambuf* cerr_;
  std::streambuf* cout_;
};

/// Runs f(quiet), a piece of work with ITK on `path`, quietly; whatever a library throws becomes an Error
/// (input.corrupt). f must not call back into user code: the output streams are not its own.
template <class F>
auto through_itk(const std::string& path, F&& f) {
  const QuietLibraries quiet;
  try {
    return f(quiet);
  } catch (const Error&) {
    throw;
  } catch (const itk::ExceptionObject& failure) {
    throw corrupt_file(path, std::string(failure.GetDescription()) + " " + quiet.said());
  } catch (const std::bad_alloc&) {
    throw Error(Fault::input, "input.too_large", "'" + path + "' needs more memory than is free",
                "free memory, or crop or resample the image");
  } catch (const std::exception& failure) {
    throw corrupt_file(path, failure.what());
  } catch (...) {  // GDCM throws strings
    throw corrupt_file(path, "the image library gave up without a reason " + quiet.said());
  }
}

/// Size, type and kind of pixel of an image whose information was read; the frame as ITK has it (leading 3 axes).
ImageHeader header_of(const itk::ImageIOBase& io, const std::string& format);

/// Reads all voxels; room for io.GetImageSizeInBytes(). Call through through_itk.
/// Throws Error (input.corrupt) if the last bytes were not written.
void read_all(itk::ImageIOBase& io, void* voxels);

}  // namespace scantet
