// The Ipopt back end. Ipopt is no part of this build: its C interface is looked for when it is
// asked for.

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "backends.hpp"
#include "slalom/base/error.hpp"
#include "slalom/base/timer.hpp"

namespace slalom::nlp {
namespace {

// IpStdCInterface.h, alike from Ipopt 3.11 to 3.14 but for Bool, there an int and here a bool: one
// that is given is read from its lowest byte, and one that is returned fills an int.
using Index = int;
using Number = double;
using Flag = int;
using IpoptProblem = struct IpoptProblemInfo*;
using EvalF = Flag(Index, Number*, bool, Number*, void*);
using EvalG = Flag(Index, Number*, bool, Index, Number*, void*);
using EvalGradF = Flag(Index, Number*, bool, Number*, void*);
using EvalJacobian = Flag(Index, Number*, bool, Index, Index, Index*, Index*, Number*, void*);
using EvalHessian = Flag(Index, Number*, bool, Number, Index, Number*, bool, Index, Index*, Index*,
                         Number*, void*);
using EachIteration = Flag(Index, Index, Number, Number, Number, Number, Number, Number, Number,
                           Number, Index, void*);

/// Its functions.
struct Library {
  IpoptProblem (*create)(Index n, Number* xl, Number* xu, Index m, Number* gl, Number* gu,
                         Index nnz_jac, Index nnz_hess, Index style, EvalF*, EvalG*, EvalGradF*,
                         EvalJacobian*, EvalHessian*);
  void (*free)(IpoptProblem);
  bool (*set_text)(IpoptProblem, char*, char*);
  bool (*set_number)(IpoptProblem, char*, Number);
  bool (*set_integer)(IpoptProblem, char*, Index);
  bool (*set_callback)(IpoptProblem, EachIteration*);
  Index (*solve)(IpoptProblem, Number* x, Number* g, Number* f, Number* y, Number* zl, Number* zu,
                 void* user);
};

template <class Function>
bool find(void* handle, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(dlsym(handle, name));
  return function != nullptr;
}

/// Where it is looked for: in $SLALOM_IPOPT alone, or by the file names of 3.11 and before and
/// of 3.14.
std::vector<std::string> library_names() {
  if (const char* chosen = std::getenv("SLALOM_IPOPT"); chosen != nullptr && *chosen != 0)
    return {chosen};
  return {"libipopt.so.1", "libipopt.so.3"};
}

/// Loaded once, and kept; null where there is none.
const Library* library() {
  static const std::unique_ptr<const Library> loaded = []() -> std::unique_ptr<const Library> {
    for (const std::string& name : library_names()) {
      void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
      Library of{};
      if (handle != nullptr && find(handle, "CreateIpoptProblem", of.create) &&
          find(handle, "FreeIpoptProblem", of.free) &&
          find(handle, "AddIpoptStrOption", of.set_text) &&
          find(handle, "AddIpoptNumOption", of.set_number) &&
          find(handle, "AddIpoptIntOption", of.set_integer) &&
          find(handle, "SetIntermediateCallback", of.set_callback) &&
          find(handle, "IpoptSolve", of.solve))
        return std::make_unique<const Library>(of);
    }
    return nullptr;
  }();
  return loaded.get();
}

/// IpReturnCodes_inc.h, what is told apart.
enum ReturnCode : Index {
  kSolved = 0,
  kInfeasible = 2,
  kDiverging = 4,
  kUserStop = 5,
  kIterations = -1,
  kCpuTime = -4,
  kTooFewFreedoms = -10,
  kInvalidNumber = -13
};

/// A Problem as Ipopt's callbacks see it.
class Adapter {
 public:
  Adapter(Problem& problem, const Options& options)
      : problem_(problem), shape_(problem.structure()), options_(options) {}

  int iterations = 0;

  static Flag eval_f(Index, Number* x, bool fresh, Number* f, void* user) {
    Adapter& of = self(user);
    if (!of.evaluate(x, fresh, {.values = true})) return 0;
    *f = of.at_.objective;
    return 1;
  }
  static Flag eval_grad_f(Index, Number* x, bool fresh, Number* gradient, void* user) {
    Adapter& of = self(user);
    if (!of.evaluate(x, fresh, {.values = true, .derivatives = true})) return 0;
    std::copy(of.at_.gradient.begin(), of.at_.gradient.end(), gradient);
    return 1;
  }
  static Flag eval_g(Index, Number* x, bool fresh, Index, Number* g, void* user) {
    Adapter& of = self(user);
    if (!of.evaluate(x, fresh, {.values = true})) return 0;
    std::copy(of.at_.rows.begin(), of.at_.rows.end(), g);
    return 1;
  }
  static Flag eval_jacobian(Index, Number* x, bool fresh, Index, Index, Index* row, Index* col,
                            Number* values, void* user) {
    Adapter& of = self(user);
    if (values == nullptr) return pattern(of.shape_.jacobian_row, of.shape_.jacobian_col, row, col);
    if (!of.evaluate(x, fresh, {.values = true, .derivatives = true})) return 0;
    std::copy(of.at_.jacobian.begin(), of.at_.jacobian.end(), values);
    return 1;
  }
  static Flag eval_hessian(Index, Number* x, bool fresh, Number sigma, Index m, Number* y, bool,
                           Index, Index* row, Index* col, Number* values, void* user) {
    Adapter& of = self(user);
    if (values == nullptr) return pattern(of.shape_.hessian_row, of.shape_.hessian_col, row, col);
    if (fresh) of.have_ = {};
    const Fault fault =
        of.problem_.evaluate({x, of.shape_.variables}, sigma, {y, static_cast<std::size_t>(m)},
                             {.hessian = true}, of.at_);
    if (fault) return of.note(fault);
    std::copy(of.at_.hessian.begin(), of.at_.hessian.end(), values);
    return 1;
  }
  static Flag each_iteration(Index, Index iteration, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, void* user) {
    Adapter& of = self(user);
    of.iterations = iteration;
    of.fault_ = {};  // a fault at a trial point that was stepped back from is forgiven
    if (of.timer_.cpu() > of.options_.time_limit)
      of.stopped_ = Status::time_limit;
    else if (of.options_.stop != nullptr && of.options_.stop(of.options_.stop_data))
      of.stopped_ = Status::interrupted;
    else
      return 1;
    return 0;
  }

  const Fault& fault() const { return fault_; }

  Status status_of(Index code) const {
    switch (code) {
      case kSolved:
        return Status::solved;
      case kIterations:
        return Status::iteration_limit;
      case kCpuTime:
        return Status::time_limit;
      case kInfeasible:
        return Status::infeasible;
      case kDiverging:
        return Status::unbounded;
      case kInvalidNumber:
        return Status::invalid_number;
      case kTooFewFreedoms:
        return Status::too_few_freedoms;
      case kUserStop:
        return stopped_;
      default:
        return Status::numerical_failure;
    }
  }

 private:
  static Adapter& self(void* user) { return *static_cast<Adapter*>(user); }

  static Flag pattern(const std::vector<std::uint32_t>& rows,
                      const std::vector<std::uint32_t>& cols, Index* row, Index* col) {
    std::transform(rows.begin(), rows.end(), row, [](auto r) { return static_cast<Index>(r); });
    std::transform(cols.begin(), cols.end(), col, [](auto c) { return static_cast<Index>(c); });
    return 1;
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
  const Options& options_;
  Evaluation at_;
  Parts have_;
  Fault fault_;
  Status stopped_ = Status::interrupted;
  Timer timer_;
};

/// Names and words are not changed, though the interface does not say so.
char* word(const char* text) {
  return const_cast<char*>(text);
}

void configure(const Library& ipopt, IpoptProblem to, const Options& options) {
  ipopt.set_text(to, word("sb"), word("yes"));
  ipopt.set_text(to, word("linear_solver"), word("mumps"));
  ipopt.set_text(to, word("option_file_name"), word(""));  // none, whatever lies in this folder
  for (const auto& [name, value] : ipopt_options(options)) {
    if (const auto* count = std::get_if<int>(&value))
      ipopt.set_integer(to, word(name.c_str()), *count);
    else if (const auto* number = std::get_if<double>(&value))
      ipopt.set_number(to, word(name.c_str()), *number);
    else
      ipopt.set_text(to, word(name.c_str()), word(std::get<const char*>(value)));
  }
}

class IpoptSolver final : public Solver {
 public:
  explicit IpoptSolver(const Library& ipopt) : ipopt_(ipopt) {}

  void solve(Problem& problem, const Start& start, const Options& options,
             Answer& answer) override {
    const Structure& shape = problem.structure();
    check_sizes(start, shape, options.warm_start);
    check(options, "solver options");
    const Timer timer;
    Adapter adapter(problem, options);
    const auto stated = state(problem);
    configure(ipopt_, stated.get(), options);
    Start point = start;  // which may be the answer's own
    answer = {};
    answer.point = std::move(point);
    answer.point.y.resize(shape.rows, 0.0);
    answer.point.zl.resize(shape.variables, 0.0);
    answer.point.zu.resize(shape.variables, 0.0);
    const Index code = ipopt_.solve(stated.get(), answer.point.x.data(), nullptr, &answer.objective,
                                    answer.point.y.data(), answer.point.zl.data(),
                                    answer.point.zu.data(), &adapter);
    answer.iterations = adapter.iterations;
    answer.status = adapter.status_of(code);
    if (adapter.fault() && answer.status != Status::solved) {
      answer.fault = adapter.fault();
      if (answer.status == Status::numerical_failure) answer.status = Status::invalid_number;
    }
    answer.backend = "ipopt";
    answer.message = "Ipopt return code " + std::to_string(code);
    answer.cpu_s = timer.cpu();
    answer.wall_s = timer.wall();
    note_violation(problem, answer);
  }

 private:
  using Stated = std::unique_ptr<IpoptProblemInfo, void (*)(IpoptProblem)>;

  Stated state(const Problem& problem) const {
    const Structure& shape = problem.structure();
    Limits limits = problem.limits();  // copied: the interface's pointers are not to constants
    Stated stated(ipopt_.create(static_cast<Index>(shape.variables), limits.xl.data(),
                                limits.xu.data(), static_cast<Index>(shape.rows), limits.gl.data(),
                                limits.gu.data(), static_cast<Index>(shape.jacobian_col.size()),
                                static_cast<Index>(shape.hessian_col.size()), 0, Adapter::eval_f,
                                Adapter::eval_g, Adapter::eval_grad_f, Adapter::eval_jacobian,
                                Adapter::eval_hessian),
                  ipopt_.free);
    if (stated == nullptr) throw Error("Ipopt: CreateIpoptProblem refused the problem");
    ipopt_.set_callback(stated.get(), Adapter::each_iteration);
    return stated;
  }

  const Library& ipopt_;
};

}  // namespace

bool has_ipopt() {
  return library() != nullptr;
}

std::unique_ptr<Solver> make_ipopt() {
  if (library() == nullptr) {
    std::string names;
    for (const auto& name : library_names()) names += (names.empty() ? "" : " or ") + name;
    throw InvalidValue(
        "solver", "'ipopt'",
        "interior_point: Ipopt's library (" + names +
            ") cannot be loaded; install Ipopt, or name its library in SLALOM_IPOPT");
  }
  return std::make_unique<IpoptSolver>(*library());
}

}  // namespace slalom::nlp
