// The Ipopt back end. Ipopt owns its problem object through its own reference counting.

#ifndef HAVE_CSTDDEF
#define HAVE_CSTDDEF  // Debian's headers ask for it
#endif
#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>

#include "backends.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::nlp {
namespace {

using Ipopt::Index;
using Ipopt::Number;

/// Presents a Problem to Ipopt and keeps what it answers.
class Adapter : public Ipopt::TNLP {
 public:
  Adapter(Problem& problem, const Start& start, const Options& options)
      : problem_(problem), shape_(problem.structure()), start_(start), options_(options) {}

  Answer answer;

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_hess,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(shape_.variables);
    m = static_cast<Index>(shape_.rows);
    nnz_jac = static_cast<Index>(shape_.jacobian_col.size());
    nnz_hess = static_cast<Index>(shape_.hessian_col.size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* xl, Number* xu, Index, Number* gl, Number* gu) override {
    const Limits& limits = problem_.limits();
    std::copy(limits.xl.begin(), limits.xl.end(), xl);
    std::copy(limits.xu.begin(), limits.xu.end(), xu);
    std::copy(limits.gl.begin(), limits.gl.end(), gl);
    std::copy(limits.gu.begin(), limits.gu.end(), gu);
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool init_z, Number* zl, Number* zu, Index,
                          bool init_y, Number* y) override {
    std::copy(start_.x.begin(), start_.x.end(), x);
    if (init_z) {
      std::copy(start_.zl.begin(), start_.zl.end(), zl);
      std::copy(start_.zu.begin(), start_.zu.end(), zu);
    }
    if (init_y) std::copy(start_.y.begin(), start_.y.end(), y);
    return true;
  }

  bool eval_f(Index, const Number* x, bool fresh, Number& f) override {
    if (!evaluate(x, fresh, {.values = true})) return false;
    f = at_.objective;
    return true;
  }
  bool eval_grad_f(Index, const Number* x, bool fresh, Number* gradient) override {
    if (!evaluate(x, fresh, {.values = true, .derivatives = true})) return false;
    std::copy(at_.gradient.begin(), at_.gradient.end(), gradient);
    return true;
  }
  bool eval_g(Index, const Number* x, bool fresh, Index, Number* g) override {
    if (!evaluate(x, fresh, {.values = true})) return false;
    std::copy(at_.rows.begin(), at_.rows.end(), g);
    return true;
  }
  bool eval_jac_g(Index, const Number* x, bool fresh, Index, Index, Index* row, Index* col,
                  Number* values) override {
    if (values == nullptr) {
      for (std::size_t e = 0; e < shape_.jacobian_row.size(); ++e) {
        row[e] = static_cast<Index>(shape_.jacobian_row[e]);
        col[e] = static_cast<Index>(shape_.jacobian_col[e]);
      }
      return true;
    }
    if (!evaluate(x, fresh, {.values = true, .derivatives = true})) return false;
    std::copy(at_.jacobian.begin(), at_.jacobian.end(), values);
    return true;
  }
  bool eval_h(Index, const Number* x, bool fresh, Number sigma, Index m, const Number* y, bool,
              Index, Index* row, Index* col, Number* values) override {
    if (values == nullptr) {
      for (std::size_t e = 0; e < shape_.hessian_row.size(); ++e) {
        row[e] = static_cast<Index>(shape_.hessian_row[e]);
        col[e] = static_cast<Index>(shape_.hessian_col[e]);
      }
      return true;
    }
    if (fresh) have_ = {};
    const Fault fault = problem_.evaluate({x, shape_.variables}, sigma,
                                          {y, static_cast<std::size_t>(m)}, {.hessian = true}, at_);
    if (fault) return note(fault);
    std::copy(at_.hessian.begin(), at_.hessian.end(), values);
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index iteration, Number, Number, Number, Number,
                             Number, Number, Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    answer.iterations = iteration;
    fault_ = {};  // a fault at a trial point that was stepped back from is forgiven
    if (timer_.cpu() > options_.time_limit) {
      stopped_ = Status::time_limit;
    } else if (options_.stop != nullptr && options_.stop(options_.stop_data)) {
      stopped_ = Status::interrupted;
    } else {
      return true;
    }
    return false;
  }

  void finalize_solution(Ipopt::SolverReturn code, Index n, const Number* x, const Number* zl,
                         const Number* zu, Index m, const Number*, const Number* y, Number f,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    answer.point.x.assign(x, x + n);
    answer.point.zl.assign(zl, zl + n);
    answer.point.zu.assign(zu, zu + n);
    answer.point.y.assign(y, y + m);
    answer.objective = f;
    answer.status = status_of(code);
  }

  const Fault& fault() const { return fault_; }

 private:
  Status status_of(Ipopt::SolverReturn code) const {
    switch (code) {
      case Ipopt::SUCCESS:
        return Status::solved;
      case Ipopt::MAXITER_EXCEEDED:
        return Status::iteration_limit;
      case Ipopt::CPUTIME_EXCEEDED:
        return Status::time_limit;
      case Ipopt::LOCAL_INFEASIBILITY:
        return Status::infeasible;
      case Ipopt::DIVERGING_ITERATES:
        return Status::unbounded;
      case Ipopt::INVALID_NUMBER_DETECTED:
        return Status::invalid_number;
      case Ipopt::TOO_FEW_DEGREES_OF_FREEDOM:
        return Status::too_few_freedoms;
      case Ipopt::USER_REQUESTED_STOP:
        return stopped_;
      default:
        return Status::numerical_failure;
    }
  }

  /// Evaluates once a point: Ipopt asks for f, g, gradient and Jacobian one by one.
  bool evaluate(const Number* x, bool fresh, Parts parts) {
    if (fresh) have_ = {};
    if ((!parts.values || have_.values) && (!parts.derivatives || have_.derivatives)) return true;
    const Fault fault = problem_.evaluate({x, shape_.variables}, 1, {}, parts, at_);
    if (fault) return note(fault);
    have_ = {.values = have_.values || parts.values,
             .derivatives = have_.derivatives || parts.derivatives};
    return true;
  }
  bool note(const Fault& fault) {
    fault_ = fault;
    return false;
  }

  Problem& problem_;
  const Structure& shape_;
  const Start& start_;
  const Options& options_;
  Evaluation at_;
  Parts have_;
  Fault fault_;
  Status stopped_ = Status::interrupted;
  Timer timer_;
};

void configure(Ipopt::OptionsList& list, const Options& options) {
  list.SetStringValue("sb", "yes");
  list.SetStringValue("linear_solver", "mumps");
  for (const auto& [name, value] : ipopt_options(options)) {
    if (const auto* count = std::get_if<int>(&value))
      list.SetIntegerValue(name, *count);
    else if (const auto* number = std::get_if<double>(&value))
      list.SetNumericValue(name, *number);
    else
      list.SetStringValue(name, std::get<const char*>(value));
  }
}

class IpoptSolver final : public Solver {
 public:
  void solve(Problem& problem, const Start& start, const Options& options,
             Answer& answer) override {
    check_sizes(start, problem.structure(), options.warm_start);
    check(options, "solver options");
    const Timer timer;
    Ipopt::SmartPtr<Adapter> adapter = new Adapter(problem, start, options);
    Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
    configure(*application->Options(), options);
    application->Initialize("");
    const auto code = application->OptimizeTNLP(Ipopt::GetRawPtr(adapter));
    answer = std::move(adapter->answer);
    if (answer.point.x.empty()) {  // Ipopt refused the problem before its first iteration
      answer.point = start;
      answer.status = refused(code);
    }
    answer.point.y.resize(problem.structure().rows, 0.0);
    answer.point.zl.resize(problem.structure().variables, 0.0);
    answer.point.zu.resize(problem.structure().variables, 0.0);
    if (adapter->fault() && answer.status != Status::solved) {
      answer.fault = adapter->fault();
      if (answer.status == Status::numerical_failure) answer.status = Status::invalid_number;
    }
    answer.backend = "ipopt";
    answer.message = "Ipopt return code " + std::to_string(static_cast<int>(code));
    answer.cpu_s = timer.cpu();
    answer.wall_s = timer.wall();
    note_violation(problem, answer);
  }

 private:
  static Status refused(Ipopt::ApplicationReturnStatus code) {
    if (code == Ipopt::Not_Enough_Degrees_Of_Freedom) return Status::too_few_freedoms;
    if (code == Ipopt::Invalid_Number_Detected) return Status::invalid_number;
    return Status::numerical_failure;
  }
};

}  // namespace

std::unique_ptr<Solver> make_ipopt() {
  return std::make_unique<IpoptSolver>();
}

}  // namespace slalom::nlp
