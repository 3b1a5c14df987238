#include <fmt/format.h>

#include <algorithm>

#include "builder.hpp"
#include "slalom/base/error.hpp"

namespace slalom::ocp {
namespace {

/// Fills one column of a batch's data, one number a lane.
void fill_column(const Problem& problem, const Layout& layout, std::size_t family,
                 const DataSource& source, const Batch& batch, double* to) {
  using Kind = DataSource::Kind;
  const auto same = [&](double number) { std::fill_n(to, batch.lanes, number); };
  switch (source.kind) {
    case Kind::tau:
      for (std::size_t lane = 0; lane < batch.lanes; ++lane)
        to[lane] = layout.tau[source.points.empty() ? batch.lane_point[lane] : source.points[lane]];
      break;
    case Kind::weight:
      return same(problem.constraints()[source.index].soft->weight);
    case Kind::t0:
      return same(problem.t0().bounds.lower);
    case Kind::tf:
      return same(problem.tf().bounds.lower);
    case Kind::parameter:
      return same(problem.parameters()[source.index].value);
    case Kind::member: {
      const auto& rows = problem.constraints()[family];
      for (std::size_t lane = 0; lane < batch.lanes; ++lane)
        to[lane] = rows.numbers_at(batch.lane_member[lane], batch.lane_point[lane])[source.index];
    }
  }
}

}  // namespace

void fill_data(const Problem& problem, Transcribed& transcribed) {
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
    for (std::size_t i = 0; i < data.sources.size(); ++i)
      fill_column(problem, transcribed.layout, data.family, data.sources[i], batch,
                  batch.data().data() + i * batch.lanes);
    batch.evaluator->data_changed();
  }
}

}  // namespace slalom::ocp
