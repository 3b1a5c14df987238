#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "draft.hpp"

namespace slalom::ocp {
namespace {

bool collocates_both_ends(const Scheme& scheme) {
  return scheme.collocates(0) && scheme.collocates(scheme.points.size() - 1);
}

class Dynamics {
 public:
  explicit Dynamics(Draft& draft) : draft_(draft) {}

  /// One function for rates, integrands and path rows, for they share most of the model.
  void add() {
    const Expr duration = draft_.problem.final_time() - draft_.problem.initial_time();
    std::vector<Output> outputs;
    for (const auto& state : draft_.problem.states())
      outputs.push_back({"dynamics of " + state.name, duration * state.rate});
    std::vector<std::size_t> terms;
    for (const auto& cost : draft_.problem.costs()) {
      if (!cost.enabled || !cost.lagrange) continue;
      terms.push_back(draft_.term_index(cost.name));
      outputs.push_back({cost.name, duration * cost.value});
    }
    const std::size_t first_integral = outputs.size();
    for (const auto& integral : draft_.problem.integrals())
      outputs.push_back({"integrand of " + integral.name, duration * integral.integrand});
    const std::size_t first_path = outputs.size();
    const auto paths = path_rows(draft_, Points::all, outputs);
    const auto batches = draft_.add_batches(outputs, Points::all);
    if (batches.size() > 1) draft_.out.midpoints = batches[1];
    outputs.resize(first_path);
    find_points(outputs);
    add_defects();
    shape_controls();
    add_quadrature(terms, first_integral);
    use_paths(draft_, batches, first_path, paths);
  }

 private:
  struct Found {
    std::size_t batch = 0, lane = 0;
  };

  /// Where the rates and integrands at the points of the intervals are found.
  void find_points(const std::vector<Output>& outputs) {
    const Layout& layout = draft_.out.layout;
    found_.assign(layout.points(), {});
    for (const std::size_t batch : {std::size_t{0}, draft_.out.midpoints})
      if (batch != kNone)
        for (std::size_t lane = 0; lane < draft_.out.batches[batch].lanes; ++lane)
          found_[draft_.out.batches[batch].lane_point[lane]] = {batch, lane};
    end_found_.assign(layout.intervals(), {kNone, 0});
    const auto& controls = draft_.problem.controls();
    if (std::none_of(controls.begin(), controls.end(),
                     [](const auto& u) { return u.form == ControlForm::constant; }))
      return;
    std::vector<std::size_t> ends;
    for (std::size_t k = 0; k < layout.intervals(); ++k)
      if (collocates_both_ends(draft_.schemes.of(k))) {
        end_found_[k].lane = ends.size();
        ends.push_back(layout.node_point[k + 1]);
      }
    if (ends.empty()) return;
    Lanes lanes{std::move(ends), kNone, nullptr, {}, {}, kNone, {}};
    for (std::size_t i = 0; i < controls.size(); ++i)
      if (controls[i].form == ControlForm::constant)
        lanes.placed.push_back({controls[i].symbol, [&layout, i](const Batch& b, std::size_t lane) {
                                  const auto k = layout.point_stage[b.lane_point[lane]] - 1;
                                  return layout.control(layout.node_point[k], i);
                                }});
    draft_.out.ends = draft_.add_batch(outputs, lanes);
    for (std::size_t k = 0; k < layout.intervals(); ++k)
      if (collocates_both_ends(draft_.schemes.of(k))) end_found_[k].batch = draft_.out.ends;
  }
  Found found(std::size_t k, std::size_t j) const {
    if (j + 1 == draft_.schemes.of(k).points.size() && end_found_[k].batch != kNone)
      return end_found_[k];
    return found_[draft_.out.layout.node_point[k] + j];
  }

  void add_defects() {
    const Layout& layout = draft_.out.layout;
    const std::size_t intervals = layout.intervals(), most = draft_.schemes.most_points() - 1;
    draft_.out.defect_begin = draft_.rows.size();
    draft_.out.defect_rows.assign(most * layout.nx * intervals, kNone);
    for (std::size_t d = 0; d < most; ++d)
      for (std::size_t i = 0; i < layout.nx; ++i) {
        const auto& state = draft_.problem.states()[i];
        for (std::size_t k = 0; k < intervals; ++k)
          if (d < draft_.schemes.of(k).defects())
            draft_.out.defect_rows[(d * layout.nx + i) * intervals + k] =
                draft_.add_row({fmt::format("defect {} of {} in interval {}", d, state.name, k)}, k,
                               Bounds::equal(0), 1 / state.unit());
        for (std::size_t j = 0; j <= most; ++j)
          for (std::size_t k = 0; k < intervals; ++k)
            if (defect_row(draft_.out, d, i, k) != kNone && j < draft_.schemes.of(k).points.size())
              add_defect_terms(d, i, j, k);
      }
    draft_.out.defect_end = draft_.rows.size();
  }
  void add_defect_terms(std::size_t d, std::size_t i, std::size_t j, std::size_t k) {
    const Scheme& scheme = draft_.schemes.of(k);
    const std::size_t row = defect_row(draft_.out, d, i, k),
                      point = draft_.out.layout.node_point[k] + j;
    if (scheme.state[d][j] != 0)
      draft_.linear.push_back({row, draft_.out.layout.state(point, i), scheme.state[d][j]});
    if (scheme.rate[d][j] == 0) return;
    const auto [batch, lane] = found(k, j);
    draft_.use(batch, i, lane, row, kNone, -draft_.length(k) * scheme.rate[d][j]);
  }

  /// Ties controls to their form; and one at a point that no interval collocates, which would hang
  /// in the air, to that of the point beside it.
  void shape_controls() {
    const Layout& layout = draft_.out.layout;
    const std::size_t last = layout.intervals() - 1;
    for (std::size_t i = 0; i < layout.nu; ++i) {
      const ControlForm form = draft_.problem.controls()[i].form;
      if (form != ControlForm::scheme)
        for (std::size_t k = 0; k <= last; ++k) shape_control(i, form, k);
      // A line's end is a control of its own even where the scheme does not collocate it.
      const bool free_end = form == ControlForm::linear && draft_.schemes.of(last).interior() > 0;
      for (std::size_t point = 0; point < layout.points(); ++point)
        if (!draft_.collocated[point] && !(free_end && point + 1 == layout.points()))
          hold_control(i, point);
    }
  }

  /// Interior points between the interval's ends; and the horizon's end, which no interval begins.
  void shape_control(std::size_t i, ControlForm form, std::size_t k) {
    const Scheme& scheme = draft_.schemes.of(k);
    const std::size_t begin = draft_.out.layout.node_point[k], last = scheme.points.size() - 1;
    for (std::size_t j = 1; j < last; ++j) {
      const double share = form == ControlForm::linear ? scheme.points[j] : 0;
      tie_control(i, begin + j, {{begin, 1 - share}, {begin + last, share}});
    }
    if (form == ControlForm::constant && k + 1 == draft_.out.layout.intervals() &&
        collocates_both_ends(scheme))
      tie_control(i, begin + last, {{begin, 1}});
  }

  void hold_control(std::size_t i, std::size_t point) {
    std::size_t from = point;
    while (from > 0 && !draft_.collocated[from]) --from;
    while (!draft_.collocated[from]) ++from;
    tie_control(i, point, {{from, 1}});
  }

  /// u at `point` = the sum of shares of u at other points.
  void tie_control(std::size_t i, std::size_t point,
                   const std::vector<std::pair<std::size_t, double>>& shares) {
    const Layout& layout = draft_.out.layout;
    const auto& control = draft_.problem.controls()[i];
    std::size_t stage = layout.point_stage[point];
    for (const auto& [from, share] : shares) stage = std::min(stage, layout.point_stage[from]);
    const auto row = draft_.add_row({control.name + " held at " + layout.point_name(point)}, stage,
                                    Bounds::equal(0), 1 / control.unit());
    draft_.linear.push_back({row, layout.control(point, i), 1});
    for (const auto& [from, share] : shares)
      if (share != 0) draft_.linear.push_back({row, layout.control(from, i), -share});
  }

  void add_quadrature(const std::vector<std::size_t>& terms, std::size_t first_integral) {
    const Layout& layout = draft_.out.layout;
    std::vector<std::vector<double>> weight(draft_.out.batches.size());
    for (std::size_t b = 0; b < weight.size(); ++b)
      weight[b].assign(draft_.out.batches[b].lanes, 0.0);
    for (std::size_t k = 0; k < layout.intervals(); ++k)
      for (std::size_t j = 0; j < draft_.schemes.of(k).points.size(); ++j) {
        const auto [batch, lane] = found(k, j);
        weight[batch][lane] += draft_.length(k) * draft_.schemes.of(k).weight[j];
      }
    for (std::size_t k = 0; k <= layout.intervals(); ++k) {
      const double whole = weight[0][layout.state_slot[layout.node_point[k]]];
      draft_.out.share_after.push_back(k == layout.intervals() || whole == 0
                                           ? 0
                                           : draft_.length(k) *
                                                 draft_.schemes.of(k).weight.front() / whole);
    }
    const auto use_weights = [&](std::size_t output, std::size_t row, std::size_t term) {
      for (std::size_t b = 0; b < weight.size(); ++b)
        for (std::size_t lane = 0; lane < weight[b].size(); ++lane)
          if (weight[b][lane] != 0) draft_.use(b, output, lane, row, term, weight[b][lane]);
    };
    for (std::size_t t = 0; t < terms.size(); ++t) use_weights(layout.nx + t, kNone, terms[t]);
    for (std::size_t i = 0; i < draft_.problem.integrals().size(); ++i) {
      const auto& integral = draft_.problem.integrals()[i];
      const auto row = draft_.add_row({"integral " + integral.name}, layout.intervals() + 1,
                                      Bounds::equal(0), 1 / integral.unit());
      draft_.linear.push_back({row, layout.integrals + i, -1});
      use_weights(first_integral + i, row, kNone);
      draft_.out.integral_rows.push_back(row);
    }
    draft_.out.first_integral = first_integral;
    draft_.out.quadrature = std::move(weight);
  }

  Draft& draft_;
  std::vector<Found> found_;      ///< by point
  std::vector<Found> end_found_;  ///< of each interval's end, where it is not found_'s
};

}  // namespace

void add_dynamics(Draft& draft) {
  Dynamics(draft).add();
}

}  // namespace slalom::ocp
