// A take as numbers for other programs: tables of text (CSV), one JSON text, one NumPy archive. docs/export.md says what each
// column and array is. Files appear whole or not at all.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "brickfall/output.h"

namespace brickfall {

// Figures of a run over time: all of one length.
struct TakeColumn {
  std::string name;  // with its unit: "kinetic_way_j"
  std::vector<double> values;
};
// Of the take's summary; empty: it has none (it was cut off, or another program wrote it).
std::vector<TakeColumn> seriesOf(const std::string& summaryJson);

struct ExportOptions {
  std::size_t every = 1;  // frames: each, every second, ...; >= 1; the first is always there
};

struct ExportKind {
  const char* name;     // "csv", "json", "npz"
  const char* purpose;  // in a few words
  // Into files that begin with `stem` ("out/wall/wall"); `files`: those that were written.
  Status (*write)(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                  const Progress& progress, std::vector<std::string>& files);
};
std::span<const ExportKind> exportKinds();

}  // namespace brickfall
