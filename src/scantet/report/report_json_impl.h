// A report as a JSON value, for those who put it into another.
#pragma once

#include <nlohmann/json.hpp>

#include "scantet/report/report.h"

namespace scantet {

/// The keys that json_report lists.
nlohmann::ordered_json json_of(const Report& report);

/// Each as [x, y, z].
nlohmann::ordered_json json_of_places(const std::vector<Point>& places);

/// Those of one of its regions.
nlohmann::ordered_json region_json(const ReportRegion& region);

/// Those of a field.
nlohmann::ordered_json field_json(const ReportField& field);

/// Those of what became of a mesh of second order.
nlohmann::ordered_json second_order_json(const ReportSecondOrder& counts);

}  // namespace scantet
