#include "slalom/ocp/phases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

#include "constant_rows.hpp"
#include "links.hpp"
#include "slalom/base/error.hpp"

namespace slalom::ocp {

namespace {

std::uint32_t narrow(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

}  // namespace

class PhasedTranscription::Impl {
 public:
  Impl(const PhasedProblem& problem, const std::vector<Grid>& grids) : problem_(problem) {
    if (problem.phases().empty()) throw InvalidValue(problem.name(), "no phases", "at least one");
    if (grids.size() != problem.phases().size())
      throw InvalidValue(problem.name() + ": grids", fmt::format("{}", grids.size()),
                         fmt::format("{}, one for each phase", problem.phases().size()));
    for (std::size_t p = 0; p < grids.size(); ++p)
      parts_.push_back(
          std::make_unique<Transcription>(problem.phases()[p], grids[p].mesh, grids[p].schemes));
    at_.resize(parts_.size());
    join();
    links_.emplace(problem, parts_, offsets_);
    add_links();
    ConstantRows(structure).relax([this](const std::vector<double>& x) { return link_values(x); },
                                  limits);
    structure.id = nlp::Structure::next_id();
  }

  nlp::Fault evaluate(std::span<const double> x, double sigma, std::span<const double> y,
                      nlp::Parts parts, nlp::Evaluation& out) {
    resize(parts, out);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const auto rows = y.empty() ? y : rows_of(p, y);
      if (auto fault = parts_[p]->evaluate(variables_of(p, x), sigma, rows, parts, at_[p]))
        return {problem_.phases()[p].name() + ": " + fault.function, fault.where, fault.variable};
      take_over(p, parts, out);
    }
    const auto links = y.empty() ? y : y.subspan(first_link);
    for (std::size_t l = 0; l < links.size(); ++l) weights_[l] = links[l] * link_scale_[l];
    std::fill(weights_.begin() + static_cast<std::ptrdiff_t>(link_scale_.size()), weights_.end(),
              sigma);
    links_->evaluate(x, weights_, parts);
    add_results(parts, out);
    return check_links(parts);
  }

  /// The rows' values, of the links alone: the phases have seen to theirs.
  std::vector<double> link_values(std::span<const double> x) {
    std::vector<double> rows(structure.rows, std::numeric_limits<double>::quiet_NaN());
    links_->evaluate(x, {}, {.values = true});
    for (std::size_t l = 0; l < link_scale_.size(); ++l)
      rows[first_link + l] = links_->results().values()[l] * link_scale_[l];
    return rows;
  }

  std::vector<double> cost_terms(std::span<const double> x) {
    links_->evaluate(x, {}, {.values = true});
    const auto values = links_->results().values();
    return {values.begin() + static_cast<std::ptrdiff_t>(link_scale_.size()), values.end()};
  }

  std::span<const double> variables_of(std::size_t p, std::span<const double> x) const {
    return x.subspan(offsets_[p].variables, parts_[p]->structure().variables);
  }
  std::span<const double> rows_of(std::size_t p, std::span<const double> y) const {
    return y.subspan(offsets_[p].rows, parts_[p]->structure().rows);
  }

  std::string variable_name(std::size_t index) const {
    const std::size_t p = phase_of(index, &Offsets::variables);
    return problem_.phases()[p].name() + ": " +
           parts_[p]->variable_name(index - offsets_[p].variables);
  }
  std::string row_name(std::size_t index) const {
    if (index >= first_link) return problem_.links().at(index - first_link).name;
    const std::size_t p = phase_of(index, &Offsets::rows);
    return problem_.phases()[p].name() + ": " + parts_[p]->row_name(index - offsets_[p].rows);
  }

  nlp::Formulas formulas() const {
    nlp::Formulas all;
    for (const auto& part : parts_) {
      const auto formulas = part->formulas();
      append(all.variables, formulas->variables);
      append(all.rows, formulas->rows);
      all.objective += formulas->objective;
    }
    const auto own = links_->formulas(all.variables);
    const auto costs = own.begin() + static_cast<std::ptrdiff_t>(link_scale_.size());
    all.rows.insert(all.rows.end(), own.begin(), costs);
    all.objective = std::accumulate(costs, own.end(), all.objective);
    return all;
  }

  const PhasedProblem problem_;
  std::vector<std::unique_ptr<Transcription>> parts_;
  nlp::Structure structure;
  nlp::Limits limits;
  std::size_t first_link = 0;

 private:
  // --- set-up ------------------------------------------------------------------------------
  template <class T>
  static void append(std::vector<T>& to, const std::vector<T>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }
  static void append(std::vector<std::uint32_t>& to, const std::vector<std::uint32_t>& from,
                     std::size_t offset) {
    for (const auto index : from) to.push_back(narrow(index + offset));
  }

  /// What is global to a phase belongs to its last stage.
  void join() {
    Offsets next;
    for (const auto& part : parts_) {
      const nlp::Structure& s = part->structure();
      offsets_.push_back(next);
      const auto stages = [&](const std::vector<std::uint32_t>& from,
                              std::vector<std::uint32_t>& to) {
        for (const std::size_t stage : from)
          to.push_back(narrow(next.stages + std::min(stage, s.stages - 1)));
      };
      stages(s.variable_stage, structure.variable_stage);
      stages(s.row_stage, structure.row_stage);
      append(structure.jacobian_row, s.jacobian_row, next.rows);
      append(structure.jacobian_col, s.jacobian_col, next.variables);
      append(structure.hessian_row, s.hessian_row, next.variables);
      append(structure.hessian_col, s.hessian_col, next.variables);
      append(structure.variable_scale, s.variable_scale);
      append(structure.row_scale, s.row_scale);
      append(limits.xl, part->limits().xl);
      append(limits.xu, part->limits().xu);
      append(limits.gl, part->limits().gl);
      append(limits.gu, part->limits().gu);
      next.variables += s.variables;
      next.rows += s.rows;
      next.stages += s.stages;
      next.jacobian += s.jacobian_row.size();
      next.hessian += s.hessian_row.size();
    }
    structure.variables = next.variables;
    structure.stages = next.stages;
    first_link = next.rows;
    links_jacobian_ = next.jacobian;
  }

  void add_links() {
    const expr::Function& f = links_->function();
    link_scale_ = links_->row_scales();
    weights_.resize(f.outputs());
    link_scale_.resize(problem_.links().size());
    structure.rows = first_link + problem_.links().size();
    std::vector<std::size_t> stage(problem_.links().size(), structure.stages);
    for (const auto& entry : f.jacobian_pattern()) {
      if (entry.row >= stage.size()) continue;  // of a cost term
      const std::size_t variable = links_->variable(entry.col);
      stage[entry.row] =
          std::min<std::size_t>(stage[entry.row], structure.variable_stage[variable]);
      structure.jacobian_row.push_back(narrow(first_link + entry.row));
      structure.jacobian_col.push_back(narrow(variable));
    }
    for (std::size_t l = 0; l < problem_.links().size(); ++l) {
      structure.row_stage.push_back(narrow(stage[l]));
      structure.row_scale.push_back(link_scale_[l]);
      limits.gl.push_back(problem_.links()[l].bounds.lower * link_scale_[l]);
      limits.gu.push_back(problem_.links()[l].bounds.upper * link_scale_[l]);
    }
    std::unordered_map<std::uint64_t, std::size_t> known;
    const auto key = [](std::size_t row, std::size_t col) {
      return (std::uint64_t{row} << 32) | col;
    };
    for (std::size_t e = 0; e < structure.hessian_row.size(); ++e)
      known.emplace(key(structure.hessian_row[e], structure.hessian_col[e]), e);
    for (const auto& entry : f.hessian_pattern()) {
      const std::size_t a = links_->variable(entry.row), b = links_->variable(entry.col);
      const std::size_t row = std::max(a, b), col = std::min(a, b);
      const auto [place, fresh] = known.emplace(key(row, col), structure.hessian_row.size());
      if (fresh) {
        structure.hessian_row.push_back(narrow(row));
        structure.hessian_col.push_back(narrow(col));
      }
      links_hessian_.push_back(place->second);
    }
  }

  // --- evaluation --------------------------------------------------------------------------
  void resize(nlp::Parts parts, nlp::Evaluation& out) const {
    if (parts.values) {
      out.objective = 0;
      out.rows.resize(structure.rows);
    }
    if (parts.derivatives) {
      out.gradient.resize(structure.variables);
      out.jacobian.resize(structure.jacobian_row.size());
    }
    if (parts.hessian) out.hessian.assign(structure.hessian_row.size(), 0.0);
  }
  void take_over(std::size_t p, nlp::Parts parts, nlp::Evaluation& out) const {
    const nlp::Evaluation& from = at_[p];
    const auto copy = [](const std::vector<double>& list, std::vector<double>& to,
                         std::size_t offset) {
      std::copy(list.begin(), list.end(), to.begin() + static_cast<std::ptrdiff_t>(offset));
    };
    if (parts.values) {
      out.objective += from.objective;
      copy(from.rows, out.rows, offsets_[p].rows);
    }
    if (parts.derivatives) {
      copy(from.gradient, out.gradient, offsets_[p].variables);
      copy(from.jacobian, out.jacobian, offsets_[p].jacobian);
    }
    if (parts.hessian) copy(from.hessian, out.hessian, offsets_[p].hessian);
  }
  void add_results(nlp::Parts parts, nlp::Evaluation& out) const {
    const expr::Evaluator& at = links_->results();
    const expr::Function& f = links_->function();
    const std::size_t links = link_scale_.size();
    if (parts.values) {
      for (std::size_t l = 0; l < links; ++l)
        out.rows[first_link + l] = at.values()[l] * link_scale_[l];
      for (std::size_t c = links; c < f.outputs(); ++c) out.objective += at.values()[c];
    }
    if (parts.derivatives) {
      std::size_t next = links_jacobian_;
      for (std::size_t e = 0; e < f.jacobian_pattern().size(); ++e) {
        const auto [row, col] = f.jacobian_pattern()[e];
        const double slope = at.jacobian()[e] * links_->scale(col);
        if (row < links)
          out.jacobian[next++] = slope * link_scale_[row];
        else
          out.gradient[links_->variable(col)] += slope;
      }
    }
    if (parts.hessian)
      for (std::size_t e = 0; e < f.hessian_pattern().size(); ++e) {
        const auto& entry = f.hessian_pattern()[e];
        out.hessian[links_hessian_[e]] +=
            at.hessian()[e] * links_->scale(entry.row) * links_->scale(entry.col);
      }
  }
  /// The first number of the links and the cost terms that is not finite.
  nlp::Fault check_links(nlp::Parts parts) const {
    const expr::Evaluator& at = links_->results();
    const expr::Function& f = links_->function();
    const auto scale = [&](std::size_t row) {
      return row < link_scale_.size() ? link_scale_[row] : 1;
    };
    if (parts.values)
      for (std::size_t row = 0; row < f.outputs(); ++row)
        if (!std::isfinite(at.values()[row] * scale(row))) return fault_of(row, "");
    if (parts.derivatives)
      for (std::size_t e = 0; e < f.jacobian_pattern().size(); ++e) {
        const auto [row, col] = f.jacobian_pattern()[e];
        if (!std::isfinite(at.jacobian()[e] * links_->scale(col) * scale(row)))
          return fault_of(row, variable_name(links_->variable(col)));
      }
    if (parts.hessian)
      for (std::size_t e = 0; e < f.hessian_pattern().size(); ++e) {
        const auto [a, b] = f.hessian_pattern()[e];
        if (!std::isfinite(at.hessian()[e] * links_->scale(a) * links_->scale(b)))
          return fault_of(links_->with_bad_curvature(), variable_name(links_->variable(a)) + ", " +
                                                            variable_name(links_->variable(b)));
      }
    return {};
  }
  /// Of an output of the links and cost terms; of f.outputs(), of their sum.
  nlp::Fault fault_of(std::size_t output, const std::string& variable) const {
    const std::size_t links = link_scale_.size();
    const std::string name = output < links ? "link " + problem_.links()[output].name
                             : output < links + problem_.costs().size()
                                 ? "cost " + problem_.costs()[output - links].name
                                 : "a sum of links and cost terms";
    return {name, "the phases' ends", variable};
  }
  std::size_t phase_of(std::size_t index, std::size_t Offsets::*what) const {
    std::size_t p = parts_.size() - 1;
    while (offsets_[p].*what > index) --p;
    return p;
  }

  std::vector<Offsets> offsets_;
  std::optional<Links> links_;
  std::vector<double> link_scale_;
  std::vector<double> weights_;             ///< of the links, then of the cost terms
  std::size_t links_jacobian_ = 0;          ///< first entry of the links' Jacobian
  std::vector<std::size_t> links_hessian_;  ///< place of each entry of the links' Hessian
  std::vector<nlp::Evaluation> at_;         ///< of each phase
};

PhasedTranscription::PhasedTranscription(const PhasedProblem& problem,
                                         const std::vector<Grid>& grids)
    : impl_(std::make_unique<Impl>(problem, grids)) {}
PhasedTranscription::~PhasedTranscription() = default;

std::size_t PhasedTranscription::phases() const {
  return impl_->parts_.size();
}
Transcription& PhasedTranscription::phase(std::size_t number) {
  return *impl_->parts_.at(number);
}
nlp::Start PhasedTranscription::part_of(std::size_t phase, const nlp::Start& point) const {
  const auto part = [&](const std::vector<double>& list, bool of_rows) -> std::vector<double> {
    if (list.empty()) return {};
    const auto range = of_rows ? impl_->rows_of(phase, list) : impl_->variables_of(phase, list);
    return {range.begin(), range.end()};
  };
  return {part(point.x, false), part(point.y, true), part(point.zl, false), part(point.zu, false)};
}
std::size_t PhasedTranscription::first_link() const {
  return impl_->first_link;
}
std::vector<double> PhasedTranscription::cost_terms(std::span<const double> x) {
  return impl_->cost_terms(x);
}
const nlp::Structure& PhasedTranscription::structure() const {
  return impl_->structure;
}
const nlp::Limits& PhasedTranscription::limits() const {
  return impl_->limits;
}
nlp::Fault PhasedTranscription::evaluate(std::span<const double> x, double sigma,
                                         std::span<const double> y, nlp::Parts parts,
                                         nlp::Evaluation& out) {
  return impl_->evaluate(x, sigma, y, parts, out);
}
std::string PhasedTranscription::variable_name(std::size_t index) const {
  return impl_->variable_name(index);
}
std::string PhasedTranscription::row_name(std::size_t index) const {
  return impl_->row_name(index);
}
std::optional<nlp::Formulas> PhasedTranscription::formulas() const {
  return impl_->formulas();
}

}  // namespace slalom::ocp
