#pragma once

#include "elastic_form.hpp"
#include "row_elimination.hpp"

namespace slalom::nlp::ipm {

/// Rows with elastic parts beside their slacks: F has 1 / sigma of each of the three.
class ElasticElimination final : public RowElimination {
 public:
  explicit ElasticElimination(const ElasticForm& form) : RowElimination(form), form_(form) {}
  void weigh(const BarrierTerms& terms) override;
  void add_curvature(std::span<double> diagonal) const override;
  void shift(const BarrierTerms& terms, const Iterate& at,
             std::span<const double> residuals) override;
  void recover(const BarrierTerms& terms, const Iterate& at, std::span<const double> residuals,
               std::span<const double> jdx, std::span<const double> equations_dy,
               Step& out) override;
  void add_to_equations(const Step& step, std::span<double> left) const override;

 private:
  struct Pull {
    double p, n;
  };
  Pull pull(const BarrierTerms& terms, const Iterate& at, std::size_t row) const;
  void move_slacks(const BarrierTerms& terms, std::span<const double> jdx,
                   std::span<const double> dy, Step& out) const override;

  const ElasticForm& form_;
};

}  // namespace slalom::nlp::ipm
