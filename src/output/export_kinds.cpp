// The list of exports, and what they have in common.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "output/export_common.h"

namespace brickfall {

std::span<const ExportKind> exportKinds() {
  static constexpr ExportKind kKinds[] = {
      {"csv", "four tables of text: bodies, poses, events, series", exportCsv},
      {"json", "one text with all of it", exportJson},
      {"npz", "arrays for NumPy: numpy.load", exportNpz},
  };
  return kKinds;
}

const char* eventName(TakeEventType type) {
  switch (type) {
    case TakeEventType::hit:
      return "hit";
    case TakeEventType::launch:
      return "launch";
    case TakeEventType::fellAsleep:
      return "fell_asleep";
    case TakeEventType::quarantined:
      break;
  }
  return "quarantined";
}

std::vector<TakeColumn> seriesOf(const std::string& summaryJson) {
  std::vector<TakeColumn> out;
  const auto json = nlohmann::ordered_json::parse(summaryJson, nullptr, false);
  if (!json.is_object()) return out;
  const auto series = json.find("series");
  if (series == json.end() || !series->is_object()) return out;
  std::size_t rows = 0;
  for (const auto& [name, values] : series->items()) {
    TakeColumn column{name, {}};
    if (values.is_array())
      for (const auto& value : values) column.values.push_back(value.is_number() ? value.template get<double>() : 0);
    rows = out.empty() ? column.values.size() : std::min(rows, column.values.size());
    out.push_back(std::move(column));
  }
  for (TakeColumn& column : out) column.values.resize(rows);
  return out;
}

}  // namespace brickfall
