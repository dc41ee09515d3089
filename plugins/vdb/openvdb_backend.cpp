// What the library openvdb.so exports.
#include "backend.h"
#include "vdb_writer.h"

extern "C" {
__attribute__((visibility("default"))) extern const vdb::Backend scantet_vdb_backend;
const vdb::Backend scantet_vdb_backend{&vdb::read_heads, &vdb::read_grid, &vdb::write_scan};
}
