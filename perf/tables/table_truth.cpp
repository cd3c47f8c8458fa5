// The tables of the experiments `truth` and `roofline`, and the papers' claims: figures that
// experiments measure.
#include <algorithm>
#include <array>
#include <map>

#include "base/text.h"
#include "experiments.h"
#include "tables/tables.h"

namespace defray::perf {
namespace {

/// "0.16 ± 5 %" without its spread.
std::string without_spread(const std::string& cell) { return cell.substr(0, cell.find(" ±")); }

}  // namespace

Figures measure_stages(TableBench& b) {
  Section section;
  add_mechanisms(b.bench(), b.setups(), section);
  const Table &quality = section.tables[0], &cost = section.tables[1];
  Figures figures{quality, {section.findings.back()}};
  for (auto& row : figures.table.rows) {
    const auto same = std::find_if(cost.rows.begin(), cost.rows.end(),
                                   [&](const auto& other) { return other[0] == row[0]; });
    if (same == cost.rows.end()) continue;
    const bool is_default = row[0] == "default";
    if (row[0].starts_with("--")) row[0] = "`" + row[0] + "`";
    for (std::size_t i = 1; i < row.size(); ++i) {
      row[i] += is_default ? fmt::format(" ({} s)", cost.rows[0][i])
                           : fmt::format(" (× {})", without_spread((*same)[i]));
    }
  }
  return figures;
}

Figures measure_layered(TableBench& b) {
  Section section = layered(b.bench());
  return {std::move(section.tables[0]), std::move(section.findings)};
}

Figures measure_left(TableBench& b) {
  Section section;
  add_split(b.bench(), b.setups(), section);
  return {section.tables[0], {}};
}

Figures measure_motion(TableBench& b) {
  Section section;
  add_motion(b.bench(), section);
  return {section.tables[0], {}};
}

Figures measure_roofline(TableBench& b) {
  const Section section = experiments().at("roofline").run(b.bench());
  Table table{"", "", {"kernel", "fence bg", "spheres f2", "points, 512×512"}, {}};
  std::map<std::string, std::array<std::string, 3>> cells;
  for (std::size_t scene = 0; scene < section.tables.size(); ++scene) {
    for (const auto& row : section.tables[scene].rows) {
      cells[row[0]][scene] = fmt::format("{} (× {})", row[1], row[4]);
    }
  }
  for (const auto& [kernel, of] : cells) {
    table.rows.push_back({"`" + kernel + "`", of[0], of[1], of[2]});
  }
  return {table, section.findings};
}

Figures measure_papers(TableBench& b) {
  Table table{"", "", {"experiment", "the paper", "here"}, {}};
  for (const std::string name : {"plate1", "plate2", "figure7", "eye"}) {
    const Section section = experiments().at(name).run(b.bench());
    table.rows.push_back({"`" + name + "`", section.claim, join(section.findings, " ")});
  }
  return {table, {}};
}

}  // namespace defray::perf
