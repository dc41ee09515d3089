// VTK writes the files, and here it is checked that all of what it wrote is there: VTK's error codes miss failures when
// the last buffer is flushed, and the writer of .ply checks nothing at all. A .vtk is therefore made in memory and
// written by write_file; the others go to the disk directly and are checked: a .vtu for its end, .stl and .ply for
// their length.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <ostream>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/element_nodes_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/parallel_zlib_impl.h"
#include "scantet/io/vtk_messages_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kTitleLength = 255;  // the limit of .vtk, with its line end; enough for .ply

/// Compresses blocks on several threads; to VTK and to readers it is zlib.
class ParallelZLibCompressor final : public vtkZLibDataCompressor {
 public:
  static ParallelZLibCompressor* New() {
    auto* const compressor = new ParallelZLibCompressor;  // VTK counts its references
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

vtkSmartPointer<vtkPoints> make_points(const std::vector<Point>& vertices, const MeshWriteOptions& options) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(vertices.size()));
  double* next = coordinates->GetPointer(0);
  for (const Point& vertex : vertices) {
    const Point p = in_space(vertex, options);
    *next++ = p.x;
    *next++ = p.y;
    *next++ = p.z;
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

template <typename Array, typename Value, std::size_t N>
vtkSmartPointer<vtkCellArray> make_cells(const std::vector<std::array<Value, N>>& cells) {
  using Id = typename Array::ValueType;
  vtkNew<Array> connectivity;
  vtkNew<Array> offsets;
  const auto count = static_cast<vtkIdType>(cells.size());
  constexpr auto kPerCell = static_cast<vtkIdType>(N);
  connectivity->SetNumberOfValues(kPerCell * count);
  offsets->SetNumberOfValues(count + 1);
  Id* next = connectivity->GetPointer(0);
  for (const auto& cell : cells) {
    for (Value v : cell) *next++ = static_cast<Id>(v);
  }
  for (vtkIdType i = 0; i <= count; ++i) offsets->SetValue(i, static_cast<Id>(kPerCell * i));
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(offsets, connectivity);
  return result;
}

/// An array of 1 where `members` says so, else 0.
void add_flags(vtkDataSetAttributes* data, const std::string& name, const std::vector<std::uint32_t>& members,
               std::size_t count) {
  if (members.empty()) return;
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(name.c_str());
  flags->SetNumberOfValues(static_cast<vtkIdType>(count));
  std::fill_n(flags->GetPointer(0), count, static_cast<unsigned char>(0));
  for (const std::uint32_t i : members) flags->SetValue(static_cast<vtkIdType>(i), 1);
  data->AddArray(flags);
}

void add_sets(const TetMesh& mesh, vtkUnstructuredGrid* grid) {
  for (const MeshSet& set : mesh.sets) {
    add_flags(grid->GetPointData(), "set_" + set.name, set.vertices, mesh.vertices.size());
    add_flags(grid->GetCellData(), "set_" + set.name, set.tets, mesh.tets.size());
  }
}

vtkSmartPointer<vtkUnstructuredGrid> make_grid(const TetMesh& mesh, const MeshWriteOptions& options) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(make_points(mesh.vertices, options));
  constexpr std::size_t kMax32 = std::numeric_limits<std::int32_t>::max();
  const auto set_cells = [&](int type, const auto& cells) {
    const bool fits_32_bits = mesh.vertices.size() <= kMax32 && cells.front().size() * cells.size() <= kMax32;
    grid->SetCells(type, fits_32_bits ? make_cells<vtkTypeInt32Array>(cells) : make_cells<vtkTypeInt64Array>(cells));
  };
  if (is_second_order(mesh)) {
    std::vector<std::array<VertexId, 10>> cells;
    cells.reserve(mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) cells.push_back(nodes_of_tet(mesh, t).all);
    set_cells(VTK_QUADRATIC_TETRA, cells);
  } else {
    set_cells(VTK_TETRA, mesh.tets);
  }
  vtkNew<vtkIntArray> regions;
  regions->SetName("region");
  regions->SetNumberOfValues(static_cast<vtkIdType>(mesh.tet_regions.size()));
  std::copy(mesh.tet_regions.begin(), mesh.tet_regions.end(), regions->GetPointer(0));
  grid->GetCellData()->AddArray(regions);
  for (const MeshField& field : mesh.fields) {
    vtkNew<vtkDoubleArray> values;
    values->SetName(field.name.c_str());
    values->SetNumberOfValues(static_cast<vtkIdType>(field.values.size()));
    std::copy(field.values.begin(), field.values.end(), values->GetPointer(0));
    grid->GetCellData()->AddArray(values);
  }
  const std::vector<std::uint8_t> flags = vertices_of_boundary(mesh);
  vtkNew<vtkUnsignedCharArray> on_boundary;
  on_boundary->SetName("on_boundary");
  on_boundary->SetNumberOfValues(static_cast<vtkIdType>(flags.size()));
  std::copy(flags.begin(), flags.end(), on_boundary->GetPointer(0));
  grid->GetPointData()->AddArray(on_boundary);
  add_sets(mesh, grid);
  return grid;
}

/// Adds the provenance as an array of characters, which all programs can read. A string array, which meshio cannot
/// read, is added only where it is needed: 3D Slicer takes files for LPS unless a string array says RAS.
void add_field_data(vtkUnstructuredGrid* grid, const MeshWriteOptions& options) {
  const std::string line = header_line(options);
  vtkNew<vtkUnsignedCharArray> provenance;
  provenance->SetName(kProvenance);
  provenance->SetNumberOfValues(static_cast<vtkIdType>(line.size()));
  std::copy(line.begin(), line.end(), provenance->GetPointer(0));
  grid->GetFieldData()->AddArray(provenance);
  if (!options.ras) return;
  vtkNew<vtkStringArray> space;
  space->SetName(kSpaceKey);
  space->InsertNextValue("RAS");
  grid->GetFieldData()->AddArray(space);
}

/// The boundary with its own vertices only, in their order.
vtkSmartPointer<vtkPolyData> make_surface(const TetMesh& mesh, const MeshWriteOptions& options) {
  constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();
  std::vector<VertexId> new_id(mesh.vertices.size(), kUnused);
  for (const Triangle& facet : mesh.boundary_facets) {
    for (VertexId v : facet) new_id[v] = 0;
  }
  std::vector<Point> vertices;
  for (std::size_t v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == kUnused) continue;
    new_id[v] = static_cast<VertexId>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  std::vector<Triangle> facets = mesh.boundary_facets;
  for (Triangle& facet : facets) {
    for (VertexId& v : facet) v = new_id[v];
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(make_points(vertices, options));
  surface->SetPolys(make_cells<vtkTypeInt64Array>(facets));
  return surface;
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

}  // namespace

void write_vtu(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFile file(path, ".part", options.set);
  const VtkMessages messages;
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  const vtkSmartPointer<vtkUnstructuredGrid> grid = make_grid(mesh, options);
  add_field_data(grid, options);
  writer->SetInputData(grid);
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

void write_stl(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFile file(path, ".part", options.set);
  const VtkMessages messages;
  constexpr std::size_t kHeaderBytes = 80;
  std::string header = header_line(options);
  header.resize(kHeaderBytes, ' ');
  vtkNew<vtkUnsignedCharArray> header_bytes;
  header_bytes->SetNumberOfValues(kHeaderBytes);
  std::copy(header.begin(), header.end(), header_bytes->GetPointer(0));
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputData(make_surface(mesh, options));
  writer->SetFileName(file.part_path().c_str());
  writer->SetFileTypeToBinary();
  writer->SetBinaryHeader(header_bytes);
  constexpr std::size_t kBytesPerFacet = 50;
  const std::size_t expected = kHeaderBytes + sizeof(std::uint32_t) + kBytesPerFacet * mesh.boundary_facets.size();
  const bool written = writer->Write() != 0 && size_of(file.part_path()) == expected;
  require_written(file, written, writer->GetErrorCode(), messages);
  file.commit();
}

void write_ply(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFile file(path, ".part.ply", options.set);  // VTK adds .ply to a name that does not end with it
  const VtkMessages messages;
  const vtkSmartPointer<vtkPolyData> surface = make_surface(mesh, options);
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
