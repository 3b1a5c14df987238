// Ipopt as a solver that AMPL could call: reads a .nl file by AMPL's own library, which
// differentiates its expression graphs, and writes the .sol file (Gay, Hooking Your Solver to AMPL,
// 1997). The tests of back end nl run it; Debian has the libraries but no such program.
//
//   ipopt-asl problem.nl -AMPL [name=value ...]

#ifndef HAVE_CSTDDEF
#define HAVE_CSTDDEF  // Debian's headers of Ipopt ask for it
#endif
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

// Last, for its macros take common names.
#include "asl_pfgh.h"

namespace {

char lower_in[] = "ipopt_zL_in", upper_in[] = "ipopt_zU_in";
char lower_out[] = "ipopt_zL_out", upper_out[] = "ipopt_zU_out";
SufDecl suffixes[] = {{lower_in, nullptr, ASL_Sufkind_var | ASL_Sufkind_real, 0},
                      {upper_in, nullptr, ASL_Sufkind_var | ASL_Sufkind_real, 0},
                      {lower_out, nullptr, ASL_Sufkind_var | ASL_Sufkind_real, 0},
                      {upper_out, nullptr, ASL_Sufkind_var | ASL_Sufkind_real, 0}};

class NlProblem : public Ipopt::TNLP {
 public:
  explicit NlProblem(ASL* library) : asl(library) { hessian_entries_ = sphsetup(-1, 1, 1, 1); }

  bool get_nlp_info(int& n, int& m, int& jacobian, int& hessian, IndexStyleEnum& style) override {
    n = n_var;
    m = n_con;
    jacobian = static_cast<int>(nzc);
    hessian = static_cast<int>(hessian_entries_);
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(int n, double* xl, double* xu, int m, double* gl, double* gu) override {
    for (int i = 0; i < n; ++i) xl[i] = LUv[2 * i], xu[i] = LUv[2 * i + 1];
    for (int i = 0; i < m; ++i) gl[i] = LUrhs[2 * i], gu[i] = LUrhs[2 * i + 1];
    return true;
  }
  bool get_starting_point(int n, bool, double* x, bool with_z, double* zl, double* zu, int m,
                          bool with_y, double* y) override {
    std::copy_n(X0, n, x);
    if (with_y)
      for (int i = 0; i < m; ++i) y[i] = -pi0[i];
    if (!with_z) return true;
    const SufDesc* lower = suf_get(lower_in, ASL_Sufkind_var);
    const SufDesc* upper = suf_get(upper_in, ASL_Sufkind_var);
    for (int i = 0; i < n; ++i) {
      zl[i] = lower->u.r != nullptr ? lower->u.r[i] : 1;
      zu[i] = upper->u.r != nullptr ? -upper->u.r[i] : 1;
    }
    return true;
  }
  bool eval_f(int, const double* x, bool, double& f) override {
    fint error = 0;
    f = objval(0, const_cast<double*>(x), &error);
    return error == 0;
  }
  bool eval_grad_f(int, const double* x, bool, double* gradient) override {
    fint error = 0;
    objgrd(0, const_cast<double*>(x), gradient, &error);
    return error == 0;
  }
  bool eval_g(int, const double* x, bool, int, double* g) override {
    fint error = 0;
    conval(const_cast<double*>(x), g, &error);
    return error == 0;
  }
  bool eval_jac_g(int, const double* x, bool, int m, int, int* row, int* col,
                  double* values) override {
    if (values != nullptr) {
      fint error = 0;
      jacval(const_cast<double*>(x), values, &error);
      return error == 0;
    }
    for (int i = 0; i < m; ++i)
      for (const cgrad* entry = Cgrad[i]; entry != nullptr; entry = entry->next) {
        row[entry->goff] = i;
        col[entry->goff] = entry->varno;
      }
    return true;
  }
  bool eval_h(int n, const double* x, bool, double sigma, int, const double* y, bool, int, int* row,
              int* col, double* values) override {
    if (values == nullptr) {
      for (int c = 0, e = 0; c < n; ++c)
        for (; e < sputinfo->hcolstarts[c + 1]; ++e) {
          row[e] = static_cast<int>(sputinfo->hrownos[e]);
          col[e] = c;
        }
      return true;
    }
    fint error = 0;
    double* point = const_cast<double*>(x);
    std::vector<double> rows(static_cast<std::size_t>(n_con));
    (void)objval(0, point, &error);
    conval(point, rows.data(), &error);
    sphes(values, -1, &sigma, const_cast<double*>(y));
    return error == 0;
  }
  void finalize_solution(Ipopt::SolverReturn code, int n, const double* x, const double* zl,
                         const double* zu, int m, const double*, const double* y, double,
                         const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) override {
    point_.assign(x, x + n);
    lower_.assign(zl, zl + n);
    upper_.assign(zu, zu + n);
    for (auto& number : upper_) number = -number;
    duals_.assign(y, y + m);
    for (auto& number : duals_) number = -number;
    solve_result_num = code == Ipopt::SUCCESS               ? 0
                       : code == Ipopt::LOCAL_INFEASIBILITY ? 200
                       : code == Ipopt::MAXITER_EXCEEDED    ? 400
                                                            : 500;
  }
  void write() {
    suf_rput(lower_out, ASL_Sufkind_var, lower_.data());
    suf_rput(upper_out, ASL_Sufkind_var, upper_.data());
    char message[] = "Ipopt through AMPL's library";
    write_sol(message, point_.data(), duals_.data(), nullptr);
  }

 private:
  ASL* asl;  // the name that the library's macros expect
  fint hessian_entries_ = 0;
  std::vector<double> point_, lower_, upper_, duals_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || std::string(argv[2]) != "-AMPL") {
    std::cerr << "usage: ipopt-asl problem.nl -AMPL [name=value ...]\n";
    return 2;
  }
  ASL* asl = ASL_alloc(ASL_read_pfgh);
  suf_declare(suffixes, 4);
  FILE* file = jac0dim(argv[1], static_cast<ftnlen>(std::string(argv[1]).size()));
  want_xpi0 = 3;
  std::vector<double> x0(static_cast<std::size_t>(n_var)), y0(static_cast<std::size_t>(n_con));
  X0 = x0.data();
  pi0 = y0.data();
  pfgh_read(file, 0);
  std::stringstream options("linear_solver mumps\nsb yes\n",
                            std::ios::in | std::ios::out | std::ios::ate);
  for (int i = 3; i < argc; ++i) {
    std::string word = argv[i];
    std::replace(word.begin(), word.end(), '=', ' ');
    options << word << '\n';
  }
  Ipopt::SmartPtr<NlProblem> problem = new NlProblem(asl);
  Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
  application->Initialize(options);
  (void)application->OptimizeTNLP(Ipopt::GetRawPtr(problem));
  problem->write();
  return 0;
}
