// VTK writes the files, and here it is checked that all of what it wrote is there: VTK's error codes miss failures when
// the last buffer is flushed, and the writer of .ply checks nothing at all. A .vtk is therefore made in memory and
// written by write_file; the others go to the disk directly and are checked: a .vtu for its end, .stl and .ply for
// their length.
#include <vtkErrorCode.h>
#include <vtkPLYWriter.h>
#include <vtkSTLWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <ostream>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/parallel_zlib_impl.h"
#include "scantet/io/vtk_grids_impl.h"
#include "scantet/io/vtk_messages_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kTitleLength = 255;  // the limit of .vtk, with its line end; enough for .ply

/// Compresses blocks on several threads; to VTK and to readers it is zlib.
class ParallelZLibCompressor final : public vtkZLibDataCompressor {
 public:
  static ParallelZLibCompressor* New() {
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): VTK counts its references
    auto* const compressor = new ParallelZLibCompressor;
    compressor->InitializeObjectBase();
    return compressor;
  }
  std::size_t GetMaximumCompressionSpace(std::size_t size) override { return most_compressed(size); }

 protected:
  std::size_t CompressBuffer(const unsigned char* bytes, std::size_t size, unsigned char* out,
                             std::size_t space) override {
    const std::vector<unsigned char> stream = compress_in_pieces(bytes, size);
    if (stream.size() > space) return 0;  // an error to VTK
    std::copy(stream.begin(), stream.end(), out);
    return stream.size();
  }
};

/// Throws if VTK reported an error.
void require_success(const std::string& path, unsigned long code, const VtkMessages& messages) {
  if (code == vtkErrorCode::NoError && !messages.failed()) return;
  const std::string reason = messages.failed() ? messages.first_error() : vtkErrorCode::GetStringFromErrorCode(code);
  throw Error(Fault::output, "output.cannot_write", "cannot write '" + path + "': " + reason, "choose another place");
}

/// Throws if VTK reported an error or the file is not complete; with the system's reason, which VTK does not tell.
void require_written(const AtomicFile& file, bool complete, unsigned long code, const VtkMessages& messages) {
  if (complete && code == vtkErrorCode::NoError && !messages.failed()) return;
  const int system_error = file.append_error();
  if (system_error != 0) throw_output_error(file.path(), system_error);
  require_success(file.path(), code, messages);
  throw Error(Fault::output, "output.full", "cannot write '" + file.path() + "': the file was cut short",
              "free some space or write to another disk");
}

/// Bytes of a file, 0 if it has gone.
std::size_t size_of(const std::string& path) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(path, failure);
  return failure ? 0 : static_cast<std::size_t>(size);
}

/// Bytes up to the end of a PLY file's header, 0 if it has no end.
std::size_t ply_header_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string head(std::size_t{4096}, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  constexpr std::string_view kEnd = "end_header\n";
  const std::size_t end = head.find(kEnd);
  return end == std::string::npos ? 0 : end + kEnd.size();
}

/// True if the file ends with `text`, white space after it aside.
bool ends_with(const std::string& path, std::string_view text) {
  std::ifstream in(path, std::ios::binary);
  constexpr std::streamoff kTail = 64;
  in.seekg(0, std::ios::end);
  in.seekg(std::max<std::streamoff>(0, in.tellg() - kTail));
  std::string tail{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  while (!tail.empty() && (tail.back() == '\n' || tail.back() == ' ')) tail.pop_back();
  return tail.ends_with(text);
}

/// Binary, compressed.
void write_xml(AtomicFile& file, vtkDataObject* data, vtkXMLWriter* writer) {
  const VtkMessages messages;
  writer->SetInputDataObject(data);
  writer->SetFileName(file.part_path().c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();                       // base64: raw bytes are no XML, and meshio fails on them
  constexpr std::size_t kBlock = std::size_t{1} << 24;  // enough for many threads
  writer->SetBlockSize(kBlock);
  writer->SetCompressor(vtkNew<ParallelZLibCompressor>());
  writer->SetHeaderTypeToUInt64();
  const bool written = writer->Write() != 0 && ends_with(file.part_path(), "</VTKFile>");
  require_written(file, written, writer->GetErrorCode(), messages);
  file.commit();
}

std::vector<std::uint32_t> all_facets(const TetMesh& mesh) {
  std::vector<std::uint32_t> facets(mesh.boundary_facets.size());
  std::iota(facets.begin(), facets.end(), 0U);
  return facets;
}

}  // namespace

void write_grid(AtomicFile& file, vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write_xml(file, grid, writer);
}

void write_polygons(AtomicFile& file, vtkPolyData* surface) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_xml(file, surface, writer);
}

void write_vtu(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFile file(path, ".part", options.set);
  const vtkSmartPointer<vtkUnstructuredGrid> grid = make_grid(mesh, options);
  add_provenance(grid, options);
  add_region_names(mesh, grid);
  write_grid(file, grid);
}

void write_vtk(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  const VtkMessages messages;
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetInputData(make_grid(mesh, options));
  writer->SetHeader(header_line(options).substr(0, kTitleLength).c_str());
  writer->SetFileTypeToBinary();
  writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);  // 5.1 is unknown to older programs
  writer->WriteToOutputStringOn();
  writer->Write();
  require_success(path, writer->GetErrorCode(), messages);
  const auto content = [&](std::ostream& out) {
    out.write(writer->GetOutputString(), writer->GetOutputStringLength());
  };
  write_file(path, content, options.set);
}

void write_triangles(AtomicFile& file, vtkPolyData* surface, const MeshWriteOptions& options) {
  const VtkMessages messages;
  constexpr std::size_t kHeaderBytes = 80;
  std::string header = header_line(options);
  header.resize(kHeaderBytes, ' ');
  vtkNew<vtkUnsignedCharArray> header_bytes;
  header_bytes->SetNumberOfValues(kHeaderBytes);
  std::copy(header.begin(), header.end(), header_bytes->GetPointer(0));
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileName(file.part_path().c_str());
  writer->SetFileTypeToBinary();
  writer->SetBinaryHeader(header_bytes);
  constexpr std::size_t kBytesPerFacet = 50;
  const std::size_t expected =
      kHeaderBytes + sizeof(std::uint32_t) + kBytesPerFacet * static_cast<std::size_t>(surface->GetNumberOfPolys());
  const bool written = writer->Write() != 0 && size_of(file.part_path()) == expected;
  require_written(file, written, writer->GetErrorCode(), messages);
  file.commit();
}

void write_stl(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFile file(path, ".part", options.set);
  write_triangles(file, make_surface(mesh, all_facets(mesh), options), options);
}

void write_ply(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFile file(path, ".part.ply", options.set);  // VTK adds .ply to a name that does not end with it
  const VtkMessages messages;
  const vtkSmartPointer<vtkPolyData> surface = make_surface(mesh, all_facets(mesh), options);
  vtkNew<vtkPLYWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileName(file.part_path().c_str());
  writer->SetFileTypeToBinary();
  writer->SetDataByteOrderToLittleEndian();
  writer->SetColorModeToOff();
  writer->AddComment(header_line(options).substr(0, kTitleLength));
  const bool written = writer->Write() != 0;
  constexpr std::size_t kBytesPerVertex = 12;
  constexpr std::size_t kBytesPerFacet = 13;
  const std::size_t header = ply_header_bytes(file.part_path());
  const std::size_t expected = header + kBytesPerVertex * static_cast<std::size_t>(surface->GetNumberOfPoints()) +
                               kBytesPerFacet * mesh.boundary_facets.size();
  const bool complete = written && header != 0 && size_of(file.part_path()) == expected;
  require_written(file, complete, writer->GetErrorCode(), messages);
  file.commit();
}

}  // namespace scantet
