#include <fmt/format.h>

#include <algorithm>

#include "../base/same_bits.hpp"
#include "builder.hpp"
#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

/// The number of all lanes of a column that has one.
double number_of(const Problem& problem, const DataSource& source) {
  using Kind = DataSource::Kind;
  switch (source.kind) {
    case Kind::weight:
      return problem.constraints()[source.index].soft->weight;
    case Kind::t0:
      return problem.t0().bounds.lower;
    case Kind::tf:
      return problem.tf().bounds.lower;
    default:
      return problem.parameters()[source.index].value;
  }
}

/// Fills one column of a batch's data, one number for each lane.
void fill_column(const Problem& problem, const Layout& layout, std::size_t family,
                 const DataSource& source, const Batch& batch, double* to) {
  using Kind = DataSource::Kind;
  if (source.kind == Kind::tau) {
    for (std::size_t lane = 0; lane < batch.lanes; ++lane)
      to[lane] = layout.tau[source.points.empty() ? batch.lane_point[lane] : source.points[lane]];
  } else if (source.kind == Kind::member) {
    const auto& rows = problem.constraints()[family];
    for (std::size_t lane = 0; lane < batch.lanes; ++lane)
      to[lane] = rows.numbers_at(batch.lane_member[lane], batch.lane_point[lane])[source.index];
  } else {
    std::fill_n(to, batch.lanes, number_of(problem, source));
  }
}

/// Whether a column's numbers are what they were.
bool as_before(const Problem& before, const Problem& problem, bool same_members,
               const DataSource& source) {
  using Kind = DataSource::Kind;
  if (source.kind == Kind::tau) return true;
  if (source.kind == Kind::member) return same_members;
  return same_bits(number_of(before, source), number_of(problem, source));
}

bool has_same_members(const Problem& before, const Problem& problem, std::size_t family) {
  if (family == kNone) return true;
  const auto& was = before.constraints()[family].member_values;
  const auto& is = problem.constraints()[family].member_values;
  return std::equal(was.begin(), was.end(), is.begin(), is.end(),
                    [](const auto& a, const auto& b) { return same_bits(a, b); });
}

}  // namespace

void fill_data(const Problem& problem, Transcribed& transcribed, const Problem* before) {
  const std::size_t points = transcribed.layout.tau.size();
  for (const auto& row : problem.constraints())
    for (std::size_t m = 0; m < row.member_values.size(); ++m)
      if (const std::size_t size = row.member_values[m].size(), once = row.symbols.size();
          size != once && size != once * points)
        throw InvalidValue(
            fmt::format("{}: family {}[{}]", problem.name(), row.name, row.members[m]),
            fmt::format("numbers for {} points", size / once),
            fmt::format("one for each symbol, or for each of the mesh's {} points", points));
  for (std::size_t b = 0; b < transcribed.batches.size(); ++b) {
    Batch& batch = transcribed.batches[b];
    const BatchData& data = transcribed.batch_data[b];
    const bool same_members = before != nullptr && has_same_members(*before, problem, data.family);
    bool changed = before == nullptr;
    for (std::size_t i = 0; i < data.sources.size(); ++i) {
      const DataSource& source = data.sources[i];
      if (before != nullptr && as_before(*before, problem, same_members, source)) continue;
      fill_column(problem, transcribed.layout, data.family, source, batch,
                  batch.data().data() + i * batch.lanes);
      changed = true;
    }
    if (changed) batch.evaluator->data_changed();
  }
}

}  // namespace slalom::ocp
