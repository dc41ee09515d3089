// What the library openvdb.so exports.
#include "backend.h"
#include "grid_in_child.h"
#include "vdb_writer.h"

extern "C" {
__attribute__((visibility("default"))) extern const vdb::Backend scantet_vdb_backend;
const vdb::Backend scantet_vdb_backend{&vdb::read_heads_apart, &vdb::read_grid_apart, &vdb::write_scan};
}
