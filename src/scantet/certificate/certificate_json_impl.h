// A certificate as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "scantet/certificate/certificate_text.h"

namespace scantet {

/// Keys as docs/certificate.md lists them, grade first; of one level.
nlohmann::ordered_json json_of(const Certificate& certificate);

/// "grade", and the keys of the one level, or "levels": [{level and these}].
nlohmann::ordered_json json_of(const MeshCertificate& certificate);

}  // namespace scantet
